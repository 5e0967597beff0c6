//! `routine!` and `scene!`: code generated where it is used. Programs have them through the
//! feature `macros` of the crate `nboom`.

mod routine;
mod scene;

use std::path::PathBuf;

use proc_macro::TokenStream;

/// Where expanded code finds the crate `nboom_scalar`.
const SCALAR: &str = "::nboom::scalar";

/// A type that implements `nboom::scalar::Routine` for a topology.
///
/// Attributes and doc comments are those of the type. After its visibility and name comes the topology, `4xS5_P`
/// for example, as it is or as a string. What may follow, in any order:
///
/// | option | meaning | without it |
/// | --- | --- | --- |
/// | `formulation = NAME` | `report`, `relative`, `symmetric`, `articulated` or `momentum` | `articulated` |
/// | `level = NAME` | `exact`: values of the closed form; `fast`: fused products and sums | `fast` |
/// | `assumptions = NAME` | `principal`: inertias along the segment axes, mass centres and next hinges on the η axis, O at the main body's mass centre; `mirrored`: links of chains that the plane ηζ divides into halves that mirror each other; `general`: none | `general` |
/// | `external` | an external wrench on the main body | none |
/// | `held` | a main body that is held, as on a test rig; the external wrench is that which holds it | a free one |
/// | `equations` | the matrix and the right side that the formulation solves | accelerations |
/// | `inverse_dynamics` | wrench on the main body and hinge torques for given accelerations | accelerations |
/// | `right_side` | the right side of a mode's differential equations, without lines that push links | accelerations |
///
/// A routine with assumptions computes something else for other satellites. Only
/// `Kernel::accepts` refuses their numbers; `Kernel::prepare` does not look.
///
/// ```
/// use nboom::scalar::{Kernel, Routine};
///
/// nboom::routine! { pub Satellite: S2_P }
/// nboom::routine! { FourBooms: 4xS1, formulation = symmetric, level = exact, external }
///
/// assert_eq!(Kernel::of::<Satellite>().topology, "S2_P");
/// assert_eq!((FourBooms::FORMULATION, FourBooms::EXTERNAL), ("symmetric", true));
/// ```
///
/// What describes no routine does not compile:
///
/// ```compile_fail
/// nboom::routine! { Satellite: S2_Q }
/// ```
#[proc_macro]
pub fn routine(input: TokenStream) -> TokenStream {
    finish(routine::expand(input.into()))
}

/// A scene compiled into the program, of type `nboom::CompiledScene`: its text, and routines
/// generated for it.
///
/// The path is relative to the folder of the program's `Cargo.toml`. There is a routine with all
/// numbers of the scene built in, one that takes them at run time, and routines for states with
/// held hinges: one for each topology of a scene of up to 10 hinges; with more, those in which all
/// appendages are held in step; at most 32. One more assumes nothing: other states, and
/// the scene with other numbers, run embedded in it. Each comes for accelerations and for the right
/// side of the differential equations. When the file changes, the program is compiled
/// again.
///
/// ```
/// use nboom::sim::{Options, Path};
///
/// const BOOMS: nboom::CompiledScene = nboom::scene!("../../benches/scenes/T1.nml");
///
/// let options =
///     Options { path: Path::Generated, kernels: BOOMS.kernels(), ..Options::default() };
/// assert_eq!(BOOMS.scene()?.name, "T1");
/// assert_eq!(options.kernels[0].assumptions.len(), options.kernels[0].parameters);
/// # Ok::<(), nboom::io::InputError>(())
/// ```
///
/// A file that is no scene does not compile; the message has everything that is wrong with it:
///
/// ```compile_fail
/// let scene = nboom::scene!("../../README.md");
/// ```
#[proc_macro]
pub fn scene(input: TokenStream) -> TokenStream {
    // Cargo runs the compiler in the folder of the workspace, which need not be the package's.
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    finish(scene::expand(input.into(), &folder))
}

fn finish(expanded: syn::Result<proc_macro2::TokenStream>) -> TokenStream {
    expanded.unwrap_or_else(|error| error.to_compile_error()).into()
}
