//! A crate with the routines of a scene.

use std::path::Path;

use nboom_codegen::{Generated, Request, generate as emit, hash};
use nboom_expr::Operations;
use nboom_formulation::Recognised;
use nboom_model::Scene;
use nboom_verify::{Certificate, TestCase};

use crate::certificate::{self, Routine};
use crate::certified::{Certified, Found};
use crate::choices::Requests;
use crate::listing::{self, Files, Listing};
use crate::{Choices, PackageError, checks, library, manifest, sources, stresses};

/// What became of a crate.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// It is what would be written, so that nothing was.
    UpToDate,
    /// It was written.
    Anew {
        /// The scene's topology.
        topology: String,
        /// Names of the routines, that of the whole scene first.
        routines: Vec<String>,
        /// Operations of one evaluation of the first.
        evaluation: Operations,
        /// How far its formulation is from the truth.
        certificate: Certificate,
    },
}

/// Writes a crate with the routines of a scene into a directory, which is made if need be.
///
/// # Errors
/// [`PackageError`] when there is no code for the scene, when it deviates from the recursion, and
/// when a file cannot be written or would overwrite somebody else's.
pub fn generate(
    scene: &Scene,
    choices: &Choices<'_>,
    directory: &Path,
) -> Result<Written, PackageError> {
    let requests = Requests::new(scene, choices)?;
    let key = key_of(scene, &requests);
    match Listing::require_current(directory, key) {
        Ok(()) => return Ok(Written::UpToDate),
        Err(PackageError::Outdated { .. }) => {}
        Err(error) => return Err(error),
    }
    let made = Crate::new(scene, &requests, key)?;
    listing::write(directory, key, &made.files)?;
    Ok(made.written())
}

/// Compares a directory with what [`generate`] would write into it; nothing is generated to find
/// out.
///
/// # Errors
/// [`PackageError::Outdated`] with the first file that is not as it would be written.
pub fn is_current(
    scene: &Scene,
    choices: &Choices<'_>,
    directory: &Path,
) -> Result<(), PackageError> {
    let requests = Requests::new(scene, choices)?;
    Listing::require_current(directory, key_of(scene, &requests))
}

/// A number for everything that a crate is made from.
fn key_of(scene: &Scene, requests: &Requests) -> u64 {
    let version = sources::VERSION;
    hash(format!("{version} {:016x} {scene:?}", requests.module().key()).as_bytes())
}

/// The files of a crate, and its routines.
struct Crate {
    files: Files,
    routines: Vec<Routine>,
    /// Name of the routine for loads and stresses.
    stresses: Option<String>,
}

impl Crate {
    fn new(scene: &Scene, requests: &Requests, key: u64) -> Result<Self, PackageError> {
        // The text first: it is what limits of size refuse.
        let code = requests.module().text()?;
        let routines = routines(scene, requests)?;
        let name = manifest::name(&scene.name);
        let mut files = Files::from([
            ("Cargo.toml".to_owned(), manifest::of_library(&name)),
            ("rustfmt.toml".to_owned(), manifest::FORMAT.to_owned()),
            ("CERTIFICATE.json".to_owned(), certificate::text(scene, key, &routines)),
            ("src/routines.rs".to_owned(), code),
            ("tests/certificate.rs".to_owned(), checks::code(&name, &routines)),
        ]);
        let appendages = [&recognised(scene)?, &recognised(&requests.free)?];
        files.extend(library::files(scene, &name, requests, appendages)?);
        files.extend(
            routines.iter().map(|routine| (checks::table_path(routine), checks::table(routine))),
        );
        files.extend(requests.stresses.iter().flat_map(|request| stresses::checks(&name, request)));
        files.extend(sources::of_scalar(&manifest::rust_name(&name)));
        let stresses = requests.stresses.as_ref().map(|request| request.name.clone());
        Ok(Self { files, routines, stresses })
    }

    fn written(self) -> Written {
        let whole = &self.routines[0];
        let Found::Accelerations(certificate) = whole.certified.found else {
            unreachable!("the first routine is that for the scene's accelerations");
        };
        Written::Anew {
            topology: whole.request.topology.to_string(),
            evaluation: whole.operations[0],
            certificate,
            routines: {
                let names = self.routines.into_iter().map(|routine| routine.request.name);
                names.chain(self.stresses).collect()
            },
        }
    }
}

/// The routines, each certified with the hinges free or held that it is for.
fn routines(scene: &Scene, requests: &Requests) -> Result<Vec<Routine>, PackageError> {
    let whole = std::iter::once(routine(scene, &requests.whole, None));
    let of_free = requests.of_free().map(|request| routine(&requests.free, request, None));
    let right_side = requests.right_side.iter().map(|request| routine(scene, request, None));
    let held = requests.held.iter().map(|request| {
        let free = request.free_hinges(scene)?;
        routine(scene, request, free.as_deref())
    });
    whole.chain(of_free).chain(right_side).chain(held).collect()
}

fn routine(
    scene: &Scene,
    request: &Request,
    free: Option<&[bool]>,
) -> Result<Routine, PackageError> {
    let Generated { evaluation, preparation, .. } = emit(request)?;
    let certified = Certified::new(scene, request, free)?;
    Ok(Routine { request: request.clone(), certified, operations: [evaluation, preparation] })
}

/// The scene's appendages with all hinges free.
fn recognised(scene: &Scene) -> Result<Recognised, PackageError> {
    let test_case = TestCase::new(scene.clone(), 0, 0)?;
    // Requests are refused before when there are none.
    Ok(test_case.recognised().cloned().expect("there is a request for the scene"))
}
