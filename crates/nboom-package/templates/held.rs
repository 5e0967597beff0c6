
/// How the main body accelerates while the scene starts, as it is held: ω̇ and a_O less gravity, main-body
/// axes.
pub const MAIN_BODY: [f64; 6] = /*MAIN_BODY*/;

/// The moment and force in a state, under which the main body, which is held, has these accelerations:
/// ω̇ and a_O less gravity, main-body axes.
pub fn holding_wrench(main_body: [f64; 6]) -> [f64; 6] {
    main_body.map(|acceleration| acceleration * HEAVY)
}

/// Mass and moments of inertia that stand for a main body that is held.
const HEAVY: f64 = /*HEAVY*/;
