//! Names of scenes and bodies.

use crate::diagnostic::quoted;

/// Longest name of a scene or a body \[bytes\].
const LONGEST: usize = 200;

/// What a name of a scene or a study is, which becomes that of a folder.
const FOLDER_NAME: &str = "the name of a folder: 1 to 200 bytes, no / \\ : and no dot first";

/// What a name of a body is.
const BODY_NAME: &str = "1 to 200 bytes of text in one line";

/// The name of a folder that is most like this one: itself if it is one.
pub fn folder_name(name: &str) -> String {
    if name.trim().is_empty() {
        return "scene".to_owned();
    }
    let unfit = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
    let mut fit = name.replace(unfit, "_");
    if fit.starts_with('.') {
        fit.replace_range(..1, "_");
    }
    let end = (0..=LONGEST.min(fit.len())).rev().find(|end| fit.is_char_boundary(*end));
    fit.truncate(end.unwrap_or_default());
    fit
}

/// Checks the name of a scene or a study.
///
/// # Errors
/// What was found and what is expected, if a folder cannot be called so.
pub fn check_folder_name(name: &str) -> Result<(), (String, &'static str)> {
    if folder_name(name) == name { Ok(()) } else { Err((quoted(name), FOLDER_NAME)) }
}

/// Checks the name of a body.
///
/// # Errors
/// What was found and what is expected, if it does not fit into a line of text.
pub(crate) fn check_body_name(name: &str) -> Result<(), (String, &'static str)> {
    let is_blank = name.trim().is_empty();
    if is_blank || name.len() > LONGEST || name.contains(char::is_control) {
        return Err((quoted(name), BODY_NAME));
    }
    Ok(())
}
