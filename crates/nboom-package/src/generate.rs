//! A crate with the routines of a scene.

use std::path::Path;

use nboom_codegen::{Request, file, generate as routine, hash, key};
use nboom_expr::Operations;
use nboom_formulation::Recognised;
use nboom_model::Scene;
use nboom_verify::{Certificate, Subject};

use crate::certificate::Certified;
use crate::choices::Requests;
use crate::listing::{self, Files, Listing};
use crate::{Choices, PackageError, checks, library, manifest, sources};

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
        /// How far its accelerations are from the truth.
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
    choices: &Choices,
    directory: &Path,
) -> Result<Written, PackageError> {
    let requests = Requests::new(scene, choices)?;
    let key = key_of(scene, &requests.all());
    match Listing::require_current(directory, key) {
        Ok(()) => return Ok(Written::UpToDate),
        Err(PackageError::Outdated { .. }) => {}
        Err(error) => return Err(error),
    }
    let crate_text = Crate::new(scene, choices, &requests, key)?;
    listing::write(directory, key, &crate_text.files)?;
    Ok(Written::Anew {
        topology: requests.whole.topology.to_string(),
        routines: requests.all().into_iter().map(|request| request.name).collect(),
        evaluation: crate_text.evaluation,
        certificate: crate_text.certificate,
    })
}

/// Compares a directory with what [`generate`] would write into it; nothing is generated to find
/// out.
///
/// # Errors
/// [`PackageError::Outdated`] with the first file that is not as it would be written.
pub fn is_current(scene: &Scene, choices: &Choices, directory: &Path) -> Result<(), PackageError> {
    let requests = Requests::new(scene, choices)?;
    Listing::require_current(directory, key_of(scene, &requests.all()))
}

/// A number for everything that a crate is made from.
fn key_of(scene: &Scene, requests: &[Request]) -> u64 {
    let version = sources::VERSION;
    hash(format!("{version} {:016x} {scene:?}", key(requests)).as_bytes())
}

struct Crate {
    files: Files,
    evaluation: Operations,
    certificate: Certificate,
}

impl Crate {
    fn new(
        scene: &Scene,
        choices: &Choices,
        requests: &Requests,
        key: u64,
    ) -> Result<Self, PackageError> {
        let recognised = recognised(scene)?;
        let all = requests.all();
        // The text first: it is what limits of size refuse.
        let routines = file(&all)?;
        let operations = |request: &Request| {
            let generated = routine(request)?;
            Ok([generated.evaluation, generated.preparation])
        };
        let operations: Vec<_> = all.iter().map(operations).collect::<Result<_, PackageError>>()?;
        let certified = Certified::new(scene, choices, requests, &recognised)?;
        let name = manifest::name(&scene.name);
        let mut files = Files::from([
            ("Cargo.toml".to_owned(), manifest::of_library(&name)),
            ("CERTIFICATE.json".to_owned(), certified.json(scene, key, &all, &operations)),
            ("src/lib.rs".to_owned(), library::text(scene, &name, requests, &recognised)),
            ("src/routines.rs".to_owned(), routines),
            ("tests/certificate.rs".to_owned(), checks::code(&name, requests, &certified)),
            ("tests/accelerations.csv".to_owned(), checks::accelerations(&certified)),
        ]);
        if requests.equations.is_some() {
            files.insert("tests/equations.csv".to_owned(), checks::equations(&certified));
        }
        files.extend(sources::of_scalar().map(|(path, text)| (path, text.to_owned())));
        let certificate = certified.accelerations;
        Ok(Self { files, evaluation: operations[0][0], certificate })
    }
}

/// The scene's appendages with all hinges free.
fn recognised(scene: &Scene) -> Result<Recognised, PackageError> {
    let subject = Subject::new(scene.clone(), 0, 0)?;
    // Requests are refused before when there are none.
    Ok(subject.recognised().cloned().expect("there is a request for the scene"))
}
