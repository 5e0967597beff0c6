
/// The scene's own numbers with its main body free, as `equations()` and `inverse_dynamics()` take them.
pub fn free_parameters() -> &'static [f64] {
    &FREE_PARAMETERS
}

#[rustfmt::skip]
const FREE_PARAMETERS: [f64; /*PARAMETER_COUNT*/] = [
/*FREE_LIST*/];
