//! Pages as they are written, and as the book has them.

use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

use crate::source::Sources;
use crate::{Result, maths};

/// A block of code.
pub struct Block {
    /// What stands behind the opening fence.
    pub info: String,
    pub text: String,
    /// Counted from 1.
    pub line: usize,
}

fn events(text: &str) -> impl Iterator<Item = (Event<'_>, Range<usize>)> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH | Options::ENABLE_STRIKETHROUGH;
    Parser::new_ext(text, options).into_offset_iter()
}

/// The fenced blocks of a page, in their order.
pub fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for (event, range) in events(text) {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                let line = text[..range.start].lines().count() + 1;
                open = Some(Block { info: info.to_string(), text: String::new(), line });
            }
            Event::Text(words) => {
                if let Some(block) = &mut open {
                    block.text.push_str(&words);
                }
            }
            Event::End(TagEnd::CodeBlock) => blocks.extend(open.take()),
            _ => {}
        }
    }
    blocks
}

/// Where the pictures of a page are, relative to it.
pub fn pictures(text: &str) -> Vec<String> {
    let picture = |event| match event {
        Event::Start(Tag::Image { dest_url, .. }) => Some(dest_url.to_string()),
        _ => None,
    };
    events(text).filter_map(|(event, _)| picture(event)).collect()
}

/// The page at this path from the clone as mdBook is to read it: formulas in MathML, links that leave
/// `docs/` led to copies in the book, blocks with the name of their file.
pub fn for_the_book(path: &Path, text: &str, sources: &mut Sources) -> Result<String> {
    let mut changes: Vec<(Range<usize>, String)> = Vec::new();
    for (event, range) in events(text) {
        match event {
            Event::InlineMath(formula) => changes.push((range, maths::markup(&formula, false)?)),
            Event::DisplayMath(formula) => changes.push((range, maths::markup(&formula, true)?)),
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                let to = match outside(path, &dest_url) {
                    Some(place) => Some(sources.address(path, &place)?),
                    // The book calls the first page of a folder so.
                    None if is_first(path, &dest_url) => {
                        Some(dest_url.replace("README.md", "index.md"))
                    }
                    None => None,
                };
                if let Some(to) = to {
                    let start = text[range.clone()].rfind(&format!("]({dest_url}"));
                    let start = range.start + start.ok_or("a link of another form")? + 2;
                    changes.push((start..start + dest_url.len(), to));
                }
            }
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                changes.extend(caption(text, range.start, &info));
            }
            _ => {}
        }
    }
    let mut out = String::new();
    let mut done = 0;
    for (range, new) in changes {
        out.push_str(&text[done..range.start]);
        out.push_str(&new);
        done = range.end;
    }
    Ok(out + &text[done..])
}

/// The opening fence of a block that says more than its language, with its file above it.
fn caption(text: &str, start: usize, info: &str) -> Option<(Range<usize>, String)> {
    let (language, more) = info.split_once(' ')?;
    let end = start + text[start..].find('\n')?;
    let fence = format!("```{language}");
    let file = more.split_once('=').map(|(_, file)| file);
    let named = |file| format!("<p class=\"file\">{file}</p>\n\n{fence}");
    Some((start..end, file.map_or(fence.clone(), named)))
}

/// The place from the clone to which a link leads, if it leaves the pages.
fn outside(page: &Path, link: &str) -> Option<PathBuf> {
    if link.contains("://") || link.starts_with('#') {
        return None;
    }
    let link = link.split('#').next().unwrap_or_default();
    let place = plain(&page.parent()?.join(link));
    let is_page = place.starts_with("docs") && !place.starts_with("docs/book");
    (!is_page || place.extension().is_none()).then_some(place)
}

fn is_first(page: &Path, link: &str) -> bool {
    let path = Path::new(link.split('#').next().unwrap_or_default());
    let is_summary = page.ends_with("SUMMARY.md");
    !is_summary && !link.contains("://") && path.ends_with("README.md")
}

/// Without `..`.
pub fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                out.pop();
            }
            Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_links_and_blocks_become_what_the_book_shows() {
        let clone = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut sources = Sources::new(&clone);
        let text = "About $x_1^*$, [code](../Cargo.toml) and [pages](how-to/README.md#a).\n\n\
                    ```toml of=a.toml\nx = \"$y\"\n```\n";
        let page =
            for_the_book(Path::new("docs/page.md"), text, &mut sources).expect("it is right");
        assert!(page.contains("<msubsup>") && !page.contains("$x"), "{page}");
        assert!(page.contains("[code](source/Cargo.toml.html)"), "{page}");
        assert!(page.contains("[pages](how-to/index.md#a)"), "{page}");
        assert!(page.contains("a.toml</p>\n\n```toml\nx = \"$y\"\n```"), "{page}");
    }

    #[test]
    fn a_formula_that_is_wrong_is_told() {
        let mut sources = Sources::new(Path::new("."));
        for_the_book(Path::new("docs/page.md"), "$\\frac{1}$", &mut sources)
            .expect_err("no formula");
    }

    #[test]
    fn blocks_are_found_in_their_order() {
        let found = blocks("a\n\n```console\n$ ls\n```\n\n```toml file=b\nc = 1\n```\n");
        let found: Vec<_> = found.iter().map(|b| (b.info.as_str(), b.text.as_str())).collect();
        assert_eq!(found, [("console", "$ ls\n"), ("toml file=b", "c = 1\n")]);
    }
}
