//! Manifests of written packages, and their names.

/// The crate's name for a scene: `satellite-` and what a name can hold of the scene's.
pub(crate) fn name(scene: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let plain: String = scene.chars().map(letter).collect();
    let words: Vec<&str> = plain.split('-').filter(|word| !word.is_empty()).collect();
    [&["satellite"], &words[..]].concat().join("-")
}

/// The name in Rust.
pub(crate) fn rust_name(name: &str) -> String {
    name.replace('-', "_")
}

/// `Cargo.toml` of a crate of routines.
pub(crate) fn of_library(name: &str) -> String {
    format!(
        "{}\
         [dependencies]\n\
         \n\
         [lints.clippy]\n\
         # Equations read best with the field's one-letter names and with indices that name bodies.\n\
         many_single_char_names = \"allow\"\n\
         # A scene's number is no constant of mathematics, also where it is near one.\n\
         approx_constant = \"allow\"\n\
         needless_range_loop = \"allow\"\n",
        package(name)
    )
}

/// `rustfmt.toml` of a crate of routines, for files that were changed count as edited.
pub(crate) const FORMAT: &str =
    "# All files are as they were written.\ndisable_all_formatting = true\n";

/// `Cargo.toml` of a simulator whose crates are in the folder `crates`.
pub(crate) fn of_simulator(name: &str, crates: &str) -> String {
    format!(
        "{}\
         [dependencies]\n\
         nboom-cli = {{ path = \"{crates}/nboom-cli\", default-features = false }}\n\
         {}",
        package(name),
        end(crates)
    )
}

/// `Cargo.toml` of a library that programs load, whose crates are in the folder `crates`.
pub(crate) fn of_shared(name: &str, crates: &str) -> String {
    format!(
        "{}\
         [lib]\n\
         crate-type = [\"cdylib\"]\n\
         \n\
         [dependencies]\n\
         {}",
        package(name),
        end(crates)
    )
}

/// How the manifest of what is built ends. Generated code uses a crate. It is compiled on all cores; every other crate
/// is optimised once, as a whole.
fn end(crates: &str) -> String {
    format!(
        "nboom-scalar = {{ path = \"{crates}/nboom-scalar\" }}\n\
         \n\
         [profile.release.package.\"*\"]\n\
         codegen-units = 1\n\
         \n\
         [workspace]\n"
    )
}

fn package(name: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let rust = env!("CARGO_PKG_RUST_VERSION");
    format!(
        "[package]\n\
         name = \"{name}\"\n\
         version = \"{version}\"\n\
         edition = \"2024\"\n\
         rust-version = \"{rust}\"\n\
         publish = false\n\
         \n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_crates() {
        for (scene, expected) in [
            ("n-boom-1970", "satellite-n-boom-1970"),
            ("1970", "satellite-1970"),
            ("Two  Booms, Ω", "satellite-two-booms"),
            ("", "satellite"),
        ] {
            assert_eq!(name(scene), expected);
        }
        assert_eq!(rust_name("satellite-t1"), "satellite_t1");
    }
}
