
/// The routine for the formulation's matrix, row by row, and its right side after it. What they are
/// solved for is UNKNOWNS, hinges appendage by appendage in the order of the topology: [`Hinge::equation`].
pub fn equations() -> &'static Kernel {
    static KERNEL: OnceLock<Kernel> = OnceLock::new();
    KERNEL.get_or_init(Kernel::of::<EQUATIONS>)
}
