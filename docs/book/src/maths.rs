//! Formulas in LaTeX as MathML, which browsers show without scripts and fonts of others.

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

use crate::Result;

/// Markup to stand in Markdown in place of the formula.
pub fn markup(formula: &str, display: bool) -> Result<String> {
    let storage = Storage::new();
    let events: Vec<_> = Parser::new(formula, &storage)
        .collect::<std::result::Result<_, _>>()
        .map_err(|error| format!("{formula}\n{error}"))?;
    let display_mode = if display { DisplayMode::Block } else { DisplayMode::Inline };
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    let mut text = String::new();
    push_mathml(&mut text, events, config)?;
    Ok(unmarked(&text.replace("&nbsp;", "\u{a0}")))
}

/// What Markdown would read as marks of its own, as references to characters.
fn unmarked(text: &str) -> String {
    let mut out = String::new();
    let mut in_tag = false;
    for c in text.chars() {
        match c {
            '<' => in_tag = true,
            '>' => in_tag = false,
            _ => {}
        }
        match c {
            '\n' => {}
            '*' | '_' | '[' | ']' | '|' | '\\' | '~' | '`' | '$' if !in_tag => {
                out.push_str(&format!("&#{};", u32::from(c)));
            }
            _ => out.push(c),
        }
    }
    out
}
