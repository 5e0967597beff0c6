//! Comments in generated code. Tokens have none, so that each is a statement `comment!("…");`
//! until the code becomes text; code that stays tokens goes without.

use proc_macro2::{Group, TokenStream, TokenTree};
use quote::quote;

const NAME: &str = "comment";

/// A line of comment, for inside of a function.
pub(crate) fn comment(words: &str) -> TokenStream {
    quote!(comment!(#words);)
}

/// The code without its comments.
pub(crate) fn without_comments(tokens: TokenStream) -> TokenStream {
    let mut kept = TokenStream::new();
    let mut tokens = tokens.into_iter();
    while let Some(token) = tokens.next() {
        match token {
            // The exclamation mark, the words in parentheses, the semicolon.
            TokenTree::Ident(name) if name == NAME => drop(tokens.by_ref().take(3).count()),
            TokenTree::Group(group) => {
                let inner = without_comments(group.stream());
                let mut shorter = Group::new(group.delimiter(), inner);
                shorter.set_span(group.span());
                kept.extend([TokenTree::Group(shorter)]);
            }
            other => kept.extend([other]),
        }
    }
    kept
}

/// The text with statements that are comments made into comments.
pub(crate) fn as_comments(text: &str) -> String {
    let line = |line: &str| {
        let words = words(line.trim_start())?;
        let indent = &line[..line.len() - line.trim_start().len()];
        Some(format!("{indent}// {words}\n"))
    };
    text.lines().map(|of_code| line(of_code).unwrap_or_else(|| format!("{of_code}\n"))).collect()
}

fn words(statement: &str) -> Option<String> {
    let literal = statement.strip_prefix("comment!(")?.strip_suffix(");")?;
    syn::parse_str::<syn::LitStr>(literal).ok().map(|literal| literal.value())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_in_text_alone() {
        let (first, second) = (comment("ω̇ \"first\"."), comment("Then."));
        let tokens = quote!(#first { #second let a = b; });
        assert_eq!(
            without_comments(tokens).to_string(),
            quote!({
                let a = b;
            })
            .to_string()
        );
        let text = format!("    {}\nlet a = b;\n", r#"comment!("ω\u{307} \"first\".");"#);
        assert_eq!(as_comments(&text), "    // ω̇ \"first\".\nlet a = b;\n");
    }
}
