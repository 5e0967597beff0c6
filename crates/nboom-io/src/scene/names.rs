//! Names of scenes and bodies.

/// Longest name of a scene or a body \[bytes\].
const LONGEST: usize = 200;

/// What a name of a folder is.
pub const FOLDER_NAME: &str = "1 to 200 bytes, no / \\ : and no dot first";

/// What a name of a body is.
pub(crate) const BODY_NAME: &str = "1 to 200 bytes of text in one line";

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

/// Whether a body may have this name.
pub(crate) fn is_body_name(name: &str) -> bool {
    !name.trim().is_empty() && name.len() <= LONGEST && !name.contains(char::is_control)
}
