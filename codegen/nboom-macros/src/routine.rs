//! `routine! { pub Satellite: S2_P, level = exact }`.

use nboom_codegen::{CodegenError, Level, Request, generate};
use nboom_formulation::{Formulation, Symmetry};
use nboom_model::Topology;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Lit, Result, Token, Visibility};

use crate::SCALAR;

/// The type and, in a module of its own, what implements it.
///
/// # Errors
/// What the macro's text gets wrong, at the word that does; why nothing can be generated, at the
/// topology or at the option that asks for it.
pub(crate) fn expand(input: TokenStream) -> Result<TokenStream> {
    let Input { attributes, visibility, name, topology, result, request } = syn::parse2(input)?;
    let blamed = |error: &CodegenError| match error {
        CodegenError::Name(_) => name.span(),
        CodegenError::NoEquations { .. }
        | CodegenError::NoInverse { .. }
        | CodegenError::HeldMainBody { .. } => result.unwrap_or(topology),
        _ => topology,
    };
    let generated =
        generate(&request).map_err(|error| syn::Error::new(blamed(&error), error))?.tokens;
    let module = format_ident!("nboom_routine_{}", request.name);
    let (conditions, attributes): (Vec<Attribute>, Vec<Attribute>) =
        attributes.into_iter().partition(|attribute| attribute.path().is_ident("cfg"));
    Ok(quote! {
        #(#conditions)*
        #[allow(non_snake_case)]
        mod #module {
            #(#attributes)*
            #[doc = ""]
            #generated
        }
        #(#conditions)*
        #visibility use #module::#name;
    })
}

/// What stands in the macro.
struct Input {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    /// Where the topology stands.
    topology: Span,
    /// Where something other than accelerations is asked for.
    result: Option<Span>,
    request: Request,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let attributes = input.call(Attribute::parse_outer)?;
        let (visibility, name): (Visibility, Ident) = (input.parse()?, input.parse()?);
        input.parse::<Token![:]>()?;
        let (topology, span) = topology(input)?;
        if input.peek(syn::token::Paren) {
            let message = "a topology with brackets is a string: `\"T(rr)\"`";
            return Err(input.error(message));
        }
        let mut request = Request {
            scalar_path: SCALAR.to_owned(),
            ..Request::new(&name.to_string(), topology, Level::Fast)
        };
        let mut given: Vec<Ident> = Vec::new();
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let option: Ident = input.parse()?;
            if given.contains(&option) {
                return Err(syn::Error::new(option.span(), format!("`{option}` is given twice")));
            }
            let is_result = |option: &&Ident| RESULTS.iter().any(|result| *option == result);
            if let (true, Some(other)) = (is_result(&&option), given.iter().find(is_result)) {
                let message = format!("`{option}` beside `{other}`, one of them expected");
                return Err(syn::Error::new(option.span(), message));
            }
            request = with(request, &option, input)?;
            given.push(option);
        }
        let result = given.iter().find(|option| **option == request.output.name());
        let result = result.map(Ident::span);
        Ok(Self { attributes, visibility, name, topology: span, result, request })
    }
}

/// `4xS5_P` is one token, a number with a suffix; `S2_P` is an identifier.
fn topology(input: ParseStream<'_>) -> Result<(Topology, Span)> {
    let (text, span) = if input.peek(Lit) {
        let literal: Lit = input.parse()?;
        let text = match &literal {
            Lit::Str(text) => text.value(),
            other => quote!(#other).to_string(),
        };
        (text, literal.span())
    } else {
        let name: Ident = input.parse().map_err(|e| {
            syn::Error::new(e.span(), "a topology expected, for example `S2_P` or `4xS5`")
        })?;
        (name.to_string(), name.span())
    };
    text.parse().map(|topology| (topology, span)).map_err(|error| syn::Error::new(span, error))
}

/// What may follow the topology.
const OPTIONS: [&str; 8] = [
    "formulation",
    "level",
    "assumptions",
    "external",
    "held",
    "equations",
    "inverse_dynamics",
    "right_side",
];

/// Those that name what is generated in place of accelerations.
const RESULTS: [&str; 3] = ["equations", "inverse_dynamics", "right_side"];

fn with(request: Request, option: &Ident, input: ParseStream<'_>) -> Result<Request> {
    Ok(match option.to_string().as_str() {
        "formulation" => request.by(value(input, &Formulation::ALL, Formulation::name)?),
        "level" => {
            let level = value(input, &[Level::Exact, Level::Fast], Level::name)?;
            Request { level, ..request }
        }
        "assumptions" => request.with_symmetry(value(input, &Symmetry::ALL, Symmetry::name)?),
        "external" => request.with_external_wrench(),
        "held" => request.with_held_main_body(),
        "equations" => request.for_equations(),
        "inverse_dynamics" => request.for_inverse_dynamics(),
        "right_side" => request.for_right_side(),
        _ => return Err(unknown(option, &OPTIONS)),
    })
}

/// `= NAME`, the name of one of `all`.
fn value<T: Copy>(input: ParseStream<'_>, all: &[T], name_of: fn(T) -> &'static str) -> Result<T> {
    input.parse::<Token![=]>()?;
    let name: Ident = input.parse()?;
    let named = all.iter().copied().find(|&value| name == name_of(value));
    let names: Vec<&str> = all.iter().copied().map(name_of).collect();
    named.ok_or_else(|| unknown(&name, &names))
}

fn unknown(found: &Ident, all: &[&str]) -> syn::Error {
    let message = format!("`{found}` found, one of {} expected", all.join(", "));
    syn::Error::new(found.span(), message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_codegen::OPERATION_LIMIT;

    /// The message, and the text it points at.
    fn refusal(text: &str) -> (String, String) {
        let error = expand(text.parse().expect("tokens")).expect_err(text);
        (error.to_string(), error.span().source_text().expect("the text is at hand"))
    }

    /// The message points at `word` and has all of `parts`.
    fn is_refused(text: &str, word: &str, parts: &[&str]) {
        let (message, at) = refusal(text);
        assert_eq!(at, word, "{text}: {message}");
        for part in parts {
            assert!(message.contains(part), "{text}: {message}");
        }
    }

    #[test]
    fn what_names_no_topology_is_refused_there() {
        is_refused("pub S: S2_Q", "S2_Q", &["`S2_Q` found", "topology like 4xS5_P expected"]);
        is_refused("S: 4yS5", "4yS5", &["`4yS5` found"]);
        is_refused("S: \"2xS1 \"", "\"2xS1 \"", &["`2xS1 ` found"]);
        is_refused("S: 2.5", "2.5", &["`2.5` found"]);
        is_refused("S: -2", "-2", &["`- 2` found"]);
        is_refused("S: *", "*", &["a topology expected, for example `S2_P`"]);
    }

    #[test]
    fn a_topology_with_brackets_is_told_to_be_a_string() {
        is_refused("S: Tr(rr)(s)", "(", &["a topology with brackets is a string"]);
    }

    #[test]
    fn wrong_grammar_is_refused_there() {
        is_refused("S = S2", "=", &["expected `:`"]);
        is_refused("S: S2 level", "level", &["expected `,`"]);
        is_refused("4: S2", "4", &["expected identifier"]);
        is_refused("S: S2, level: fast", ":", &["expected `=`"]);
    }

    #[test]
    fn unknown_options_and_values_are_refused_there() {
        is_refused(
            "S: S2, speed = fast",
            "speed",
            &["`speed` found", "formulation, level, assumptions"],
        );
        is_refused(
            "S: S2, formulation = newton",
            "newton",
            &["`newton` found", "report, relative, symmetric, articulated, momentum expected"],
        );
        is_refused("S: S2, level = quick", "quick", &["`quick` found, one of exact, fast"]);
        is_refused(
            "S: S2, assumptions = none",
            "none",
            &["one of principal, mirrored, general expected"],
        );
        is_refused("S: S2, external, external", "external", &["`external` is given twice"]);
    }

    #[test]
    fn what_cannot_be_generated_is_refused_at_the_topology() {
        is_refused("Long: S1001", "S1001", &["topology S1001", "1001 hinges", "at most 1000"]);
        is_refused(
            "Dense: S60, formulation = report",
            "S60",
            &["topology S60, formulation report", &format!("at most {OPERATION_LIMIT}")],
        );
    }

    #[test]
    fn results_that_a_formulation_does_not_have_are_refused_at_the_option() {
        is_refused("S: S2, equations", "equations", &["formulation articulated", "no equations"]);
        is_refused(
            "S: S2, inverse_dynamics, formulation = report",
            "inverse_dynamics",
            &["formulation report", "only articulated has it"],
        );
    }

    #[test]
    fn two_results_are_refused_at_the_second() {
        is_refused(
            "S: S2, formulation = symmetric, equations, right_side",
            "right_side",
            &["`right_side` beside `equations`"],
        );
    }

    #[test]
    fn a_name_that_no_module_can_have_is_refused_there() {
        is_refused("r#fn: S2", "r#fn", &["routine `r#fn`: a Rust identifier expected"]);
    }

    #[test]
    fn visibility_and_attributes_go_to_the_type() {
        let text = "/// Ours.\n #[cfg(test)] #[derive(Debug)] pub(crate) Ours: M";
        let expanded = expand(text.parse().expect("tokens")).expect("a topology").to_string();
        assert!(expanded.contains("pub (crate) use nboom_routine_Ours :: Ours"), "{expanded}");
        // A condition is that of the type and of its name here.
        assert_eq!(expanded.matches("cfg (test)").count(), 2, "{expanded}");
        let (_, of_module) = expanded.split_once('{').expect("a module");
        assert!(of_module.trim_start().starts_with("# [doc = \" Ours.\"]"), "{expanded}");
        assert_eq!(expanded.matches("derive").count(), 1, "{expanded}");
    }
}
