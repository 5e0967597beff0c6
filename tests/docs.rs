//! Documents and code say the same: equation tags, names, links, commands, the table of deck
//! symbols and the example of a program.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use nboom::formulation::Formulation;
use nboom::io::{Absent, Extent, Group, NumberKind, Numbering, SYMBOLS, Symbol};
use nboom::ode::{Method, Tolerance};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Files of the clone with one of these extensions, relative to its root.
fn files(folder: &str, extensions: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(root().join(folder)) else { return found };
    for entry in entries {
        let entry = entry.expect("a folder of the clone can be listed");
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
        let kind = entry.file_type().expect("files have a type");
        if kind.is_dir() && !["target", "out", ".git", "node_modules"].contains(&name.as_str()) {
            found.extend(files(&path, extensions));
        } else if kind.is_file() && extensions.iter().any(|e| name.ends_with(e)) {
            found.push(PathBuf::from(path));
        }
    }
    found.sort();
    found
}

/// Text with line ends and the marks of comments as blanks, so that a tag may be wrapped.
fn in_one_line(text: &str) -> String {
    let unmarked = |line: &str| {
        let line = line.trim_start();
        let marks = ["///", "//!", "//"];
        let stripped = marks.iter().find_map(|mark| line.strip_prefix(mark));
        stripped.unwrap_or(line).trim().to_owned()
    };
    text.lines().map(unmarked).collect::<Vec<_>>().join(" ")
}

/// Everything the text cites: `(6.1)` after `eq.` or `eqs.`, `Section 7`, `Table 16.1`.
fn tags(text: &str) -> BTreeSet<String> {
    let text = in_one_line(text);
    let mut found = BTreeSet::new();
    for start in ["eq. ", "eqs. "] {
        for (at, _) in text.match_indices(start) {
            found.extend(numbers_in_parentheses(&text[at + start.len()..]));
        }
    }
    for start in ["Section ", "Table "] {
        for (at, _) in text.match_indices(start) {
            let is_number = |c: &char| c.is_ascii_digit() || *c == '.';
            let number: String = text[at + start.len()..].chars().take_while(is_number).collect();
            let number = number.trim_end_matches('.');
            if !number.is_empty() {
                found.insert(format!("{start}{number}"));
            }
        }
    }
    found
}

/// `(6.4) to (6.8), (6.10) and (A-16)` as single numbers.
fn numbers_in_parentheses(mut text: &str) -> Vec<String> {
    let mut numbers: Vec<String> = Vec::new();
    let mut is_range = false;
    while let Some((number, rest)) = text.strip_prefix('(').and_then(|t| t.split_once(')')) {
        if !number.starts_with(|c: char| c.is_ascii_digit() || c == 'A') || number.len() > 5 {
            break;
        }
        if let Some(from) = numbers.last().filter(|_| is_range).cloned() {
            let (section, first) = from.split_once('.').expect("ranges are of one section");
            let last = number.split_once('.').expect("ranges are of one section").1;
            let parse = |digits: &str| digits.parse::<u32>().expect("a number");
            let between = parse(first) + 1..parse(last);
            numbers.extend(between.map(|n| format!("{section}.{n}")));
        }
        numbers.push(number.to_owned());
        let separators = [", and ", ", ", " and ", " or ", " to "];
        let Some(next) = separators.iter().find(|s| rest.starts_with(**s)) else { break };
        is_range = *next == " to ";
        text = &rest[next.len()..];
    }
    numbers
}

fn cells(row: &str) -> Vec<String> {
    let placeholder = row.replace("\\|", "\u{1}");
    let cells = placeholder.trim().trim_matches('|').split('|');
    cells.map(|cell| cell.trim().replace('\u{1}', "|")).collect()
}

/// Targets of `[text](target)`, without those on other machines.
fn links(text: &str) -> Vec<String> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|t| !t.contains("://")).map(str::to_owned).collect()
}

#[test]
fn every_cited_equation_is_in_the_document() {
    let listed = tags(&read("docs/equations.md"));
    for file in files("crates", &[".rs"]) {
        let missing: Vec<_> = tags(&read(&file)).difference(&listed).cloned().collect();
        assert!(missing.is_empty(), "{}: docs/equations.md lacks {missing:?}", file.display());
    }
}

#[test]
fn every_equation_of_the_document_is_cited_where_it_says() {
    let document = read("docs/equations.md");
    let mut rows = 0;
    for row in document.lines().filter(|line| line.starts_with("| eq")) {
        let cells = cells(row);
        let target = links(&cells[2]).first().cloned().expect("the row names a file");
        let cited = tags(&read(Path::new("docs").join(target)));
        let missing: Vec<_> = tags(&cells[0]).difference(&cited).cloned().collect();
        assert!(missing.is_empty(), "{}: no comment cites {missing:?}", cells[2]);
        rows += 1;
    }
    assert!(rows > 10, "the table has another form than this test expects");
}

#[test]
fn notes_that_code_cites_exist() {
    let document = read("docs/equations.md");
    for file in files("crates", &[".rs"]) {
        let text = in_one_line(&read(&file));
        for start in ["corrected: note ", "corrected: notes "] {
            for (at, _) in text.match_indices(start) {
                let rest = text[at + start.len()..].split(['.', ':', ';', ')']).next();
                let numbers = rest.unwrap_or_default().split([',', ' ']);
                for number in numbers.filter(|n| n.parse::<u32>().is_ok()) {
                    let note = format!("\n{number}. **");
                    assert!(document.contains(&note), "{}: note {number}", file.display());
                }
            }
        }
    }
}

#[test]
fn code_names_of_the_notation_exist() {
    let is_of_a_name = |c: char| c.is_alphanumeric() || c == '_';
    let sources: Vec<String> = files("crates", &[".rs"]).iter().map(read).collect();
    let names: BTreeSet<&str> =
        sources.iter().flat_map(|text| text.split(|c| !is_of_a_name(c))).collect();
    for row in read("docs/notation.md").lines().filter(|line| line.starts_with("| ")) {
        let cell = &cells(row)[2];
        let quoted = cell.split('`').skip(1).step_by(2);
        for name in quoted.flat_map(|code| code.split(|c| !is_of_a_name(c))) {
            assert!(names.contains(name), "docs/notation.md: no {name} in the source");
        }
    }
}

#[test]
fn links_lead_somewhere() {
    for file in files("", &[".md"]) {
        let text = read(&file);
        let folder = file.parent().expect("a file is in a folder");
        for link in links(&text) {
            let (path, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target = if path.is_empty() { file.clone() } else { folder.join(path) };
            assert!(root().join(&target).exists(), "{}: {link}", file.display());
            let heading = |line: &str| line.trim_start_matches('#').trim().to_lowercase();
            let leads_to = |line: &str| heading(line).replace(' ', "-") == anchor;
            let headings = |text: &str| text.lines().any(|l| l.starts_with('#') && leads_to(l));
            let found = anchor.is_empty() || headings(&read(&target));
            assert!(found, "{}: no heading for {link}", file.display());
        }
    }
}

#[test]
fn first_commands_of_the_readme_are_those_of_the_gate() {
    let readme = read("README.md");
    let block = readme.split("```sh\n").nth(1).and_then(|rest| rest.split("```").next());
    let commands: Vec<&str> = block.expect("README.md has commands").lines().collect();
    let gate = read(".ci/run");
    for command in &commands {
        let runs = gate.lines().any(|line| line.starts_with("step ") && line.ends_with(command));
        assert!(runs, ".ci/run does not run {command}");
    }
    assert_eq!(commands.len(), 2);
}

#[test]
fn what_the_readme_installs_is_the_command() {
    let readme = read("README.md");
    let line = readme.lines().find_map(|line| line.strip_prefix("cargo install --locked --path "));
    let manifest = read(Path::new(line.expect("README.md says how to install")).join("Cargo.toml"));
    assert!(manifest.contains("[[bin]]\nname = \"nboom\"\n"), "{manifest}");
}

#[test]
fn nothing_names_a_place_on_some_machine() {
    let places = ["work", "home", "Users", "root", "tmp"].map(|folder| format!("/{folder}/"));
    let kinds = [".rs", ".md", ".toml", ".nml", ".lock", ".yml", "run", ".json"];
    for file in files("", &kinds) {
        let text = read(&file);
        for place in &places {
            // A relative path such as `tests/work/` is no such place.
            let at = text.match_indices(place.as_str()).find(|(at, _)| {
                !text[..*at].ends_with(|c: char| c.is_alphanumeric() || matches!(c, '.' | '-'))
            });
            assert!(at.is_none(), "{}: {place}", file.display());
        }
    }
}

#[test]
fn the_table_of_deck_symbols_is_that_of_the_reader() {
    assert_table("docs/decks.md", "symbols", &symbol_table());
}

#[test]
fn the_table_of_integrators_is_that_of_the_code() {
    let tolerance = |relative| Tolerance { relative, absolute: relative };
    let mut table = "| name | what, and what for | order | dense output |\n".to_owned();
    table.push_str("| --- | --- | --- | --- |\n");
    for method in Method::ALL {
        let orders = |order: fn(Method, Tolerance) -> u32| {
            let of = |relative| order(method, tolerance(relative));
            let (loose, tight) = (of(1e-3), of(1e-14));
            if loose == tight { loose.to_string() } else { format!("{loose} to {tight}") }
        };
        let (order, dense) = (orders(Method::order), orders(Method::dense_order));
        table.push_str(&format!("| `{method}` | {} | {order} | {dense} |\n", method.about()));
    }
    assert_table("docs/integrators.md", "integrators", &table);
}

#[test]
fn every_formulation_has_a_row_in_the_document() {
    let document = read("docs/formulations.md");
    for formulation in Formulation::ALL {
        let rows = document.matches(&format!("\n| `{formulation}` | ")).count();
        assert!(rows > 0, "{formulation} is not in a table");
    }
}

/// Holds what stands in a document between the marks of a table against the table, or with
/// `NBOOM_BLESS=1` puts it there.
fn assert_table(document: &str, name: &str, expected: &str) {
    let (begin, end) = (format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->"));
    let text = read(document);
    let (before, rest) = text.split_once(&begin).expect("the table has a begin mark");
    let (found, after) = rest.split_once(&end).expect("the table has an end mark");
    if std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1") {
        let text = format!("{before}{begin}{expected}{end}{after}");
        fs::write(root().join(document), text).expect("documents can be written");
    } else {
        assert_eq!(found, expected, "NBOOM_BLESS=1 cargo test --test docs rewrites it");
    }
}

/// A reader copies them, so they are whole decks that nothing is wrong with.
#[test]
fn decks_in_the_document_are_read_without_a_warning() {
    let document = read("docs/decks.md");
    let blocks: Vec<&str> = document.split("```nml\n").skip(1).collect();
    assert_eq!(document.matches("```").count(), 2 * blocks.len(), "a block of another kind");
    assert!(!document.contains("\n\n    "), "an indented block");
    for (number, block) in blocks.iter().enumerate() {
        let deck = block.split("```").next().expect("blocks end");
        let file = nboom::io::parse_deck(&format!("block {number}"), deck, "block")
            .unwrap_or_else(|error| panic!("{error}"));
        assert!(file.warnings.is_empty(), "{:?}", file.warnings);
        assert_eq!(file.scene.warnings(), []);
    }
    let example = read("examples/four-wings.nml");
    assert!(blocks.iter().any(|block| block.starts_with(&example)), "four-wings.nml has changed");
}

fn symbol_table() -> String {
    let mut text = String::new();
    for group in Group::ALL {
        let absence = if group.may_be_absent() { ", may be absent" } else { "" };
        text.push_str(&format!("\n### {}{absence}\n\n", group.name()));
        text.push_str("| symbol | shape | unit | meaning | when not given |\n");
        text.push_str("| --- | --- | --- | --- | --- |\n");
        let rows = SYMBOLS.iter().filter(|symbol| symbol.group == group);
        rows.for_each(|symbol| text.push_str(&symbol_row(symbol)));
    }
    text.push('\n');
    text
}

fn symbol_row(symbol: &Symbol) -> String {
    let number = match symbol.numbering {
        Numbering::None => "",
        Numbering::Segment => "*i*",
        Numbering::SegmentAndStation => "*ij*",
    };
    let extent = |extent: &Extent| match extent {
        Extent::Fixed(count) => count.to_string(),
        Extent::Segments => "N".to_owned(),
        Extent::Appendages => "NA".to_owned(),
    };
    let shape: Vec<String> = symbol.shape.iter().map(extent).collect();
    let shape = if shape.is_empty() { "1".to_owned() } else { shape.join(",") };
    let kind = if symbol.kind == NumberKind::Integer { " integer" } else { "" };
    let aliases: String = symbol.aliases.iter().map(|alias| format!(", `{alias}`")).collect();
    let absent = match symbol.absent {
        Absent::Error => "error".to_owned(),
        Absent::ErrorWhen(condition) => format!("error when {condition}"),
        Absent::Is(value) => value.to_string(),
        Absent::Means(meaning) => meaning.to_owned(),
    };
    let Symbol { name, unit, meaning, .. } = symbol;
    let unit = unit.replace('*', "\\*");
    format!("| `{name}`{number}{aliases} | {shape}{kind} | {unit} | {meaning} | {absent} |\n")
}

/// `.ci/book` sees to it that docs/how-to/embed.md has these lines.
#[test]
fn the_program_of_the_how_to_runs() {
    program::main().expect("the sample deck runs");
}

mod program {
    use nboom::io::read_scene;
    use nboom::sim::{Event, Options, Recorder, Snapshot, simulate};

    struct Latches;

    impl Recorder for Latches {
        fn event(&mut self, event: &Event, after: &Snapshot) -> std::io::Result<()> {
            if let (Some(hinge), Some(impulse)) = (event.hinge, event.impulse) {
                println!("{:.6} hinge {hinge}: {impulse:.3}, {:?}", event.time, after.omega_body);
            }
            Ok(())
        }
    }

    pub fn main() -> Result<(), Box<dyn std::error::Error>> {
        let file = read_scene("examples/n-boom-1970.nml".as_ref())?;
        let summary = simulate(&file.scene, &Options::default(), &mut Latches)?;
        println!("{} steps, {:?}", summary.steps_accepted, summary.conservation);
        Ok(())
    }
}
