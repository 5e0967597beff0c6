//! Sources that written packages are made of, as they were when this crate was built.

/// A path and the text of the file there.
pub(crate) type Source = (&'static str, &'static str);

/// The command and what it uses, a folder for each crate; licences and `Cargo.lock` beside.
const ALL: &[Source] = include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// A number for the sources and for what is written around them.
pub(crate) const VERSION: &str = env!("NBOOM_PACKAGE");

/// Where the module that generated code uses stands in a crate.
const MODULE: &str = "src/nboom_scalar";

/// Files of the crates of the command.
pub(crate) fn of_command() -> impl Iterator<Item = &'static Source> {
    ALL.iter().filter(|(path, _)| path.contains('/'))
}

/// Files of the crate that generated code uses.
pub(crate) fn of_routines() -> impl Iterator<Item = &'static Source> {
    ALL.iter().filter(|(path, _)| path.starts_with("nboom-scalar/"))
}

/// The crate that generated code uses as a module of the crate `name`, licences included. As a
/// crate of its own it could be in a program only once.
pub(crate) fn of_scalar(name: &str) -> impl Iterator<Item = (String, String)> {
    let sources = ALL.iter().filter_map(move |(path, text)| {
        let file = path.strip_prefix("nboom-scalar/src/")?;
        let file = if file == "lib.rs" { "mod.rs" } else { file };
        Some((format!("{MODULE}/{file}"), as_module(text, name)))
    });
    let licences = ALL.iter().filter(|(path, _)| path.starts_with("LICENSE"));
    sources.chain(licences.map(|(path, text)| (format!("{MODULE}/{path}"), (*text).to_owned())))
}

/// The text of a file, without its tests, where its crate is a module of the crate `name`.
fn as_module(text: &str, name: &str) -> String {
    let code = text.split("\n#[cfg(test)]\nmod tests").next().unwrap_or_default();
    code.replace("crate::", "crate::nboom_scalar::")
        .replace("use nboom_scalar::", &format!("use {name}::nboom_scalar::"))
}

/// The versions of other people's crates.
pub(crate) fn lock() -> &'static str {
    ALL.iter().find(|(path, _)| *path == "Cargo.lock").map_or("", |(_, text)| text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_a_crate_become_those_of_a_module() {
        let text =
            "/// use nboom_scalar::Dual;\nuse crate::{Real};\n\n#[cfg(test)]\nmod tests {\n}\n";
        let expected = "/// use ours::nboom_scalar::Dual;\nuse crate::nboom_scalar::{Real};\n";
        assert_eq!(as_module(text, "ours"), expected);
    }
}
