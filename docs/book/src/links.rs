//! Whether every link within the book leads somewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::Result;
use crate::page::plain;

/// What a page of HTML has: where it leads, and the names of its places.
struct Anchors {
    links: Vec<String>,
    names: BTreeSet<String>,
}

/// All links of all pages below the folder.
pub fn check(book: &Path) -> Result<()> {
    let mut pages = BTreeMap::new();
    collect(book, &mut pages)?;
    let mut broken = Vec::new();
    let mut count = 0;
    for (page, anchors) in &pages {
        for link in anchors.links.iter().filter(|link| is_internal(link)) {
            count += 1;
            let (path, name) = link.split_once('#').unwrap_or((link, ""));
            let path = path.split('?').next().unwrap_or_default();
            let folder = page.parent().expect("a page is in a folder");
            let to = if path.is_empty() { page.clone() } else { plain(&folder.join(path)) };
            let named = pages.get(&to).is_some_and(|there| there.names.contains(name));
            if !to.is_file() || !(name.is_empty() || named) {
                let page = page.strip_prefix(book)?;
                broken.push(format!("{}: {link} leads nowhere", page.display()));
            }
        }
    }
    println!("{} pages, {count} links within the book", pages.len());
    if broken.is_empty() { Ok(()) } else { Err(broken.join("\n").into()) }
}

fn is_internal(link: &str) -> bool {
    let kinds = ["http:", "https:", "data:", "mailto:", "javascript:"];
    !kinds.iter().any(|kind| link.starts_with(kind)) && link != "#"
}

fn collect(folder: &Path, pages: &mut BTreeMap<PathBuf, Anchors>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, pages)?;
        } else if path.extension().is_some_and(|e| e == "html") {
            let text = fs::read_to_string(&path)?;
            pages.insert(path, anchors(&text));
        }
    }
    Ok(())
}

fn anchors(text: &str) -> Anchors {
    let mut found = Anchors { links: Vec::new(), names: BTreeSet::new() };
    for tag in text.split('<').skip(1).filter_map(|rest| rest.split('>').next()) {
        let value = |name: &str| {
            let (_, rest) = tag.split_once(&format!(" {name}=\""))?;
            Some(rest.split('"').next()?.replace("&amp;", "&"))
        };
        found.links.extend(value("href").or_else(|| value("src")));
        found.names.extend(value("id"));
    }
    found
}

#[test]
fn links_that_lead_nowhere_are_told() {
    let book = std::env::temp_dir().join(format!("nboom-book-links-{}", std::process::id()));
    fs::create_dir_all(&book).expect("a folder");
    let page = |text: &str| fs::write(book.join("page.html"), text).expect("a page");
    page("<h1 id=\"a\">A</h1><a href=\"#a\">a</a><a href=\"page.html#a\">a</a>");
    check(&book).expect("both lead to the heading");
    page("<a href=\"#b\">b</a><img src=\"none.svg\"><a href=\"https://example.org\">c</a>");
    let told = check(&book).expect_err("two lead nowhere").to_string();
    assert!(
        told.contains("#b") && told.contains("none.svg") && !told.contains("example"),
        "{told}"
    );
    fs::remove_dir_all(&book).expect("it is there");
}
