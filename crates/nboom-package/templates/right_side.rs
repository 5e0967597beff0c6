
/// The routine for the right side of the scene's differential equations, all hinges free: from attitude, ω, angles and rates
/// of hinges to their rates of change, and the power of the parts of the hinge torques that depend on rates.
pub fn right_side() -> &'static Kernel {
    static KERNEL: OnceLock<Kernel> = OnceLock::new();
    KERNEL.get_or_init(Kernel::of::</*RIGHT_SIDE*/>)
}

/// The scene's own numbers at its start, as `right_side()` takes them; all kick-off springs push.
pub fn right_side_parameters() -> &'static [f64] {
    &RIGHT_SIDE_PARAMETERS
}

/// When the scene starts.
pub const START_TIME: f64 = /*START_TIME*/;

/// Where the scene starts, as `right_side()` takes it.
#[rustfmt::skip]
pub const START: [f64; /*START_COUNT*/] = /*START*/;

/// Where the numbers of one hinge stand for `right_side()`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variables {
    /// Where the angle stands in the variables \[rad\]; of a hinge that slides its travel.
    pub angle: usize,
    /// Where the rate stands there; of a hinge that slides its speed.
    pub rate: usize,
    /// Where q₁, q₂, A₃, A₂, A₁, A₀, β₀ stand in the parameters. The torque about the hinge is
    /// (q₁τ + q₂)τ + ((A₃s + A₂)s + A₁)s + A₀ with s = β − β₀.
    pub law: usize,
    /// Where a₀, a₁, a₂, a₃ stand there: the force of the kick-off spring of the hinge's body by powers of its length,
    /// zero where nothing pushes.
    pub kick_off: usize,
    /// The spring does not push when it is longer than this; `None` where the body has no spring.
    pub kick_off_limit: Option<f64>,
    /// Where ρ₁, ρ₂, k, θ, c stand there: the coupling of the hinge with the one inboard of it, at angle β₂, pulls with
    /// T = −k(ρ₁β + ρ₂β₂ − θ) − c(ρ₁τ + ρ₂τ₂); the torque about the hinge is ρ₁T, that about the inboard one ρ₂T.
    /// Where the scene couples no such hinges, the routine takes zeros for k and c alone. `None` for a hinge on the main body.
    pub coupling: Option<usize>,
}

/// Those of the hinges of the scene, in the order of [`HINGES`].
#[rustfmt::skip]
pub const VARIABLES: [Variables; /*HINGE_COUNT*/] = [
/*VARIABLE_LIST*/];

/// Where moment and force on the main body about O stand in the parameters of `right_side()`, main-body axes.
pub const WRENCH: std::ops::Range<usize> = /*WRENCH*/;

/// Where the angular momentum of the rotors on the main body, relative to it, stands there, main-body axes; it is constant.
pub const SPIN: std::ops::Range<usize> = /*SPIN*/;

/// A force or torque on the main body from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrust {
    /// Time at which it starts.
    pub on: f64,
    /// Time at which it stops.
    pub off: f64,
    /// Its moment and force about O, main-body axes.
    pub wrench: [f64; 6],
}

/// Those of the scene.
#[rustfmt::skip]
pub static THRUSTS: [Thrust; /*THRUST_COUNT*/] = [
/*THRUST_LIST*/];

/// The wrench that holds a main body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Holding {
    /// From this time on, until that of the next.
    pub from: f64,
    /// Moment and force about O, main-body axes. They are large, since a heavy body stands for one that is held.
    pub wrench: [f64; 6],
}

/// Those of the scene, earlier ones first; none where its main body is free.
#[rustfmt::skip]
pub static HOLDINGS: [Holding; /*HOLDING_COUNT*/] = [
/*HOLDING_LIST*/];

#[rustfmt::skip]
static RIGHT_SIDE_PARAMETERS: [f64; /*SIDE_PARAMETER_COUNT*/] = [
/*SIDE_PARAMETER_LIST*/];
