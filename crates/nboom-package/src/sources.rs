//! Sources that written packages are made of, as they were when this crate was built.

/// A path and the text of the file there.
type Source = (&'static str, &'static str);

/// The command and what it uses, a folder for each crate; licences and `Cargo.lock` beside.
const ALL: &[Source] = include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// A number for the sources and for what is written around them.
pub(crate) const VERSION: &str = env!("NBOOM_PACKAGE");

/// Files of the crates of the command.
pub(crate) fn of_command() -> impl Iterator<Item = &'static Source> {
    ALL.iter().filter(|(path, _)| path.contains('/'))
}

/// Files of the crate that generated code uses, licences included.
pub(crate) fn of_scalar() -> impl Iterator<Item = (String, &'static str)> {
    let folder = "nboom-scalar/";
    let sources = ALL.iter().filter(move |(path, _)| path.starts_with(folder));
    let licences = ALL.iter().filter(|(path, _)| path.starts_with("LICENSE"));
    let licences = licences.map(move |(path, text)| (format!("{folder}{path}"), *text));
    sources.map(|(path, text)| ((*path).to_owned(), *text)).chain(licences)
}

/// The versions of other people's crates.
pub(crate) fn lock() -> &'static str {
    ALL.iter().find(|(path, _)| *path == "Cargo.lock").map_or("", |(_, text)| text)
}
