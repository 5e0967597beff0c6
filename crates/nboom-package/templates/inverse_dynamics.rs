
/// The routine for inverse dynamics: what has to act on the main body and about the hinges for given
/// accelerations, which are handed in where moment, force and torques stand in a state.
pub fn inverse_dynamics() -> &'static Kernel {
    static KERNEL: OnceLock<Kernel> = OnceLock::new();
    KERNEL.get_or_init(Kernel::of::<INVERSE>)
}
