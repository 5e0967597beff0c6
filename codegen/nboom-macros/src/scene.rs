//! `scene!("case.nml")`.

use std::error::Error;
use std::path::Path;

use nboom_codegen::{Level, Module};
use nboom_formulation::Formulation;
use nboom_io::{Format, write_scene};
use proc_macro2::TokenStream;
use quote::quote;
use syn::parse::{ParseStream, Parser};
use syn::{LitStr, Result, Token};

use crate::SCALAR;

/// An expression of type `nboom::CompiledScene`. The files of the scene are also included as they are,
/// which lets the compiler know that the program depends on them.
///
/// # Errors
/// At the literal: everything that is wrong with the file, or why nothing can be generated.
pub(crate) fn expand(input: TokenStream, folder: &Path) -> Result<TokenStream> {
    let literal = only_literal.parse2(input)?;
    let refused = |message: String| syn::Error::new(literal.span(), message);
    let path = folder.join(literal.value());
    let read = nboom_io::read_scene(&path).map_err(|error| refused(with_causes(&error)))?;
    let text = if Format::of(&path) == Some(Format::Toml) {
        // Included files are not there when the program runs.
        write_scene(&read)
    } else {
        // Comments of a deck may have bytes that are not UTF-8.
        let bytes = std::fs::read(&path)
            .map_err(|error| refused(format!("{}: {error}", path.display())))?;
        String::from_utf8_lossy(&bytes).into_owned()
    };
    let (scene, structure) = (&read.scene, read.structure.as_ref());
    let module = Module::of_simulator(scene, structure, Formulation::Articulated, Level::Fast);
    let routines = module.and_then(|module| module.at(SCALAR).tokens());
    let routines = routines.map_err(|error| refused(error.to_string()))?;
    let files = std::iter::once(&path).chain(&read.included);
    let files: Option<Vec<&str>> = files.map(|path| path.to_str()).collect();
    let Some(files) = files else {
        return Err(refused(format!("{}: the path is not UTF-8", path.display())));
    };
    let name = &scene.name;
    Ok(quote! {{
        #(const _: &[u8] = ::core::include_bytes!(#files);)*
        mod routines { #routines }
        ::nboom::CompiledScene::new(#literal, #name, #text, routines::kernels)
    }})
}

/// As `include_str!` takes it, a comma behind it or none.
fn only_literal(input: ParseStream<'_>) -> Result<LitStr> {
    let literal = input.parse()?;
    input.parse::<Option<Token![,]>>()?;
    Ok(literal)
}

fn with_causes(error: &dyn Error) -> String {
    let causes = std::iter::successors(error.source(), |cause| (*cause).source());
    causes.fold(error.to_string(), |text, cause| format!("{text}: {cause}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The message; it points at the literal.
    fn refusal(folder: &Path, text: &str) -> String {
        let error = expand(text.parse().expect("tokens"), folder).expect_err(text);
        assert_eq!(error.span().source_text().as_deref(), Some(text), "{error}");
        error.to_string()
    }

    #[test]
    fn everything_that_is_wrong_with_a_scene_is_said() {
        let folder = tempfile::tempdir().expect("a folder for the test");
        let deck = include_str!("../../../examples/n-boom-1970.nml");
        let wrong = deck.replace("EMM=25.0", "EMM=-25.0").replace("TF=1.0", "TF=abc");
        std::fs::write(folder.path().join("wrong.nml"), wrong).expect("the folder is ours");
        let message = refusal(folder.path(), "\"wrong.nml\"");
        for part in ["wrong.nml:", ": EMM: found", ": TF: found"] {
            assert!(message.contains(part), "{part}: {message}");
        }
    }

    #[test]
    fn a_file_that_is_not_there_is_named_with_the_reason() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let message = refusal(folder, "\"nowhere.nml\"");
        assert!(message.contains("nowhere.nml: the file cannot be read: "), "{message}");
        assert!(refusal(folder, "\"src/lib.rs\"").contains("a deck NAME.nml"));
    }

    #[test]
    fn a_path_is_a_string() {
        let message = refusal(Path::new(""), "case");
        assert_eq!(message, "expected string literal");
    }

    #[test]
    fn bytes_in_comments_that_are_not_utf8_are_replaced() {
        let folder = tempfile::tempdir().expect("a folder for the test");
        let mut deck = include_bytes!("../../../benches/scenes/T1.nml").to_vec();
        deck.extend(b"! \xd8\n");
        std::fs::write(folder.path().join("latin.nml"), &deck).expect("the folder is ours");
        let expanded = expand("\"latin.nml\"".parse().expect("tokens"), folder.path());
        let expanded = expanded.expect("the byte is in a comment").to_string();
        assert!(expanded.contains("\u{fffd}"));
        assert!(expanded.contains("include_bytes ! (\"/"), "the absolute path is tracked");
        let with_comma = expand("\"latin.nml\",".parse().expect("tokens"), folder.path());
        assert_eq!(with_comma.expect("a comma may follow").to_string(), expanded);
    }
}
