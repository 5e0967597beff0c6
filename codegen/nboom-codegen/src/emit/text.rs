//! Generated code as text.

use proc_macro2::TokenStream;

use crate::emit::comment::as_comments;

/// Columns of a line of code, a little less than the printer's.
pub(crate) const LINE: usize = 88;

/// Columns in which short elements of an array and short lists stand side by side.
const WIDE: usize = 100;

/// Columns of a short element, as rustfmt has it.
const SHORT: usize = 10;

/// The code as it stands in a file, formatted as rustfmt does in lines of [`WIDE`] columns.
pub(crate) fn formatted(tokens: TokenStream) -> String {
    let file: syn::File = syn::parse2(tokens).expect("generated code is Rust");
    let text = as_comments(&prettyplease::unparse(&file));
    let lines: Vec<&str> = text.lines().collect();
    let mut formatted = String::with_capacity(text.len());
    let mut at = 0;
    while at < lines.len() {
        let (taken, found) = filled(&lines[at..])
            .or_else(|| joined(&lines[at..]))
            .or_else(|| broken(lines[at]))
            .unwrap_or_else(|| (1, lines[at].to_owned()));
        formatted += &found;
        formatted.push('\n');
        at += taken;
    }
    formatted
}

/// The beginning of an array of short elements with lines as full as they can be, where the printer
/// gives most elements a line of their own. With it, how many lines that were.
fn filled(lines: &[&str]) -> Option<(usize, String)> {
    let first = lines[0].strip_suffix('[').map(|_| lines[0])?;
    let is_short =
        |element: &str| element.len() <= SHORT && !element.contains([' ', '(', '[', ']', '}']);
    let are_short = |line: &&&str| {
        let elements = line.trim_start().strip_suffix(',');
        elements.is_some_and(|elements| elements.split(", ").all(is_short))
    };
    let inside = lines[1..].iter().take_while(are_short).count();
    lines.get(1 + inside).filter(|line| inside > 0 && line.trim_start().starts_with(']'))?;
    let indent = indent(lines[1]);
    let mut filled = vec![first.to_owned(), indent.to_owned()];
    for element in lines[1..=inside].iter().flat_map(|line| line.split_whitespace()) {
        let line = filled.last_mut().expect("there are two");
        let is_begun = line.len() > indent.len();
        // rustfmt leaves room for a bracket.
        if is_begun && line.len() + 1 + element.len() >= WIDE {
            filled.push(format!("{indent}{element}"));
        } else {
            *line += if is_begun { " " } else { "" };
            *line += element;
        }
    }
    Some((1 + inside, filled.join("\n")))
}

/// A list in parentheses in one line, if it fits; with it, how many lines that were.
fn joined(lines: &[&str]) -> Option<(usize, String)> {
    let first = lines[0].strip_suffix('(').map(|_| lines[0])?;
    let inside = lines[1..].iter().take_while(|line| line.ends_with(',')).count();
    let last = lines.get(1 + inside).filter(|line| line.trim_start().starts_with(')'))?;
    let inner: Vec<&str> = lines[1..=inside].iter().map(|line| line.trim_start()).collect();
    let inner = inner.join(" ");
    let joined = format!("{first}{}{}", inner.trim_end_matches(','), last.trim_start());
    (indent(first) == indent(last) && joined.chars().count() <= WIDE)
        .then_some((inside + 2, joined))
}

/// A constant whose text does not fit in a line, in two.
fn broken(line: &str) -> Option<(usize, String)> {
    let (constant, text) = line.split_once(" = ").filter(|(_, text)| text.starts_with('"'))?;
    let is_long = line.chars().count() > WIDE;
    is_long.then(|| (1, format!("{constant} =\n{}    {text}", indent(line))))
}

fn indent(line: &str) -> &str {
    &line[..line.len() - line.trim_start().len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::quote;

    #[test]
    fn short_elements_and_short_lists_stand_side_by_side() {
        let names = (0..60).map(|i| quote::format_ident!("t{i}"));
        let text = formatted(quote!(const A: [i32; 60] = [#(#names),*];));
        assert_eq!(text.lines().count(), 6, "{text}");
        assert!(text.lines().all(|line| line.len() <= WIDE));
        let long = ["a_name_of_twenty_letters"; 9].map(|name| quote::format_ident!("{name}"));
        let text = formatted(quote!(const A: [i32; 9] = [#(#long),*];));
        assert_eq!(text.lines().count(), 11, "{text}");
        let text = formatted(quote! {
            fn a_name_of_some_letters(first: [f64; 3], second: [f64; 3], third: [f64; 3], k: f64) {}
        });
        assert_eq!(text.lines().count(), 1, "{text}");
    }

    #[test]
    fn a_long_text_has_a_line_of_its_own() {
        let long = "T".repeat(80);
        let text = formatted(quote!(const TOPOLOGY: &'static str = #long;));
        assert_eq!(text, format!("const TOPOLOGY: &'static str =\n    \"{long}\";\n"));
    }
}
