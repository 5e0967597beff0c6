//! Robots in URDF: text to links and joints to a scene.

mod attributes;
mod crowded;
mod left_out;
mod lines;
mod links;
mod namespace;
mod reader;
mod tree;

use nboom_model::{Base, Finding, Scene, UnitSystem};
use roxmltree::{Document, Error as XmlError};

use crate::diagnostic::{Position, Report};
use crate::source::sha256;
use crate::{Format, InputError, LegacySettings, SceneFile, SceneSettings};
use crowded::{MOST_ATTRIBUTES, crowded};
use lines::Lines;
use links::Robot;
use reader::Reader;

/// Reads the text of a robot in URDF, the format of ROS.
///
/// `file` is the file's name for messages; the scene is called `name` where the robot has no name. The root
/// link is the main body, which this base holds. Joints that turn become hinges, each named like its link; links are
/// welded to those that they are fixed to. Everything starts at rest with all angles zero, and the run ends
/// after ten seconds. Damping and friction are taken over; what is not, limits for instance, is named in the
/// warnings.
///
/// # Errors
/// [`InputError::Content`] with everything that is wrong, in the order of the lines.
pub fn parse_robot(
    file: &str,
    text: &str,
    name: &str,
    base: Base,
) -> Result<SceneFile, InputError> {
    let mut report = Report::new(file);
    let scene = read(text, (name, base), &mut report);
    report.sort();
    report.add_excerpts(text);
    match scene {
        Some(scene) if report.errors.is_empty() => Ok(SceneFile {
            scene,
            warnings: report.warnings,
            legacy: LegacySettings::default(),
            structure: None,
            format: Format::Urdf,
            settings: SceneSettings { units: Some(UnitSystem::Si), ..SceneSettings::default() },
            included: Vec::new(),
            sha256: sha256(text.as_bytes()),
        }),
        _ => Err(InputError::Content(report.errors)),
    }
}

fn read(text: &str, (name, base): (&str, Base), report: &mut Report<'_>) -> Option<Scene> {
    if let Some(at) = crowded(text) {
        let found = format!("an element with more than {MOST_ATTRIBUTES} attributes");
        let expected = "at most that many";
        report.error(Lines::of(text).position(at), "robot", found, expected);
        return None;
    }
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            report_no_xml(&error, text, report);
            return None;
        }
    };
    let lines = Lines::of(text);
    let mut reader = Reader { lines: &lines, report };
    let robot = Robot::read(&document, &mut reader)?;
    let draft = tree::assemble(&robot, (name, base), &mut reader)?;
    let resolved = match draft.resolve() {
        Ok(resolved) => resolved,
        Err(errors) => {
            errors.iter().for_each(|error| refuse(error.defect.finding(), report));
            return None;
        }
    };
    match Scene::new(resolved.description) {
        Ok(scene) => Some(scene.with_names(resolved.names)),
        Err(errors) => {
            errors.iter().for_each(|error| refuse(error.finding_at_place(), report));
            None
        }
    }
}

/// Reports what no link or joint alone is responsible for.
fn refuse(Finding { found, expected }: Finding, report: &mut Report<'_>) {
    report.error(Position::START, "robot", found, expected);
}

/// Reports what the parser says, at its place; some of its errors have none.
fn report_no_xml(error: &XmlError, text: &str, report: &mut Report<'_>) {
    let at = match error {
        XmlError::UnclosedRootNode | XmlError::UnexpectedEndOfStream => {
            Lines::of(text).position(text.trim_end().len())
        }
        XmlError::DtdDetected => {
            let at = Lines::of(text).position(text.find("<!DOCTYPE").unwrap_or_default());
            return report.error(at, "robot", "a document type (DTD)", "a robot without one");
        }
        _ => Position { line: error.pos().row as usize, column: error.pos().col as usize },
    };
    let message = error.to_string().replace(&format!(" at {}", error.pos()), "");
    let message = message.replace(char::is_control, "\u{fffd}");
    report.error(at, "robot", format!("text that is no XML ({message})"), "XML");
}
