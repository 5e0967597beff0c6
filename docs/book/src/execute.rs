//! Does what pages say: writes their files, runs their commands, compares what these print and draw.
//!
//! A block says behind its fence what it is:
//!
//! - `console`: commands stand behind `$ `, what goes on with the line before behind `> `. Lines without
//!   either are what the command prints; `...` stands for any lines;
//! - `toml file=NAME` is written to that file, `toml add=NAME` is added to it; so in any language;
//! - `toml of=PATH` stands so in that file of the clone, whose tests or examples run it;
//! - `text prints=COMMAND` is what the command prints, `text` alone is for the eye;
//! - `sh` is for the reader alone; how many of these there are is told.
//!
//! Pictures that commands draw are those that the page shows; `NBOOM_BLESS=1` makes them so.

use std::env;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use crate::page::{Block, blocks, pictures};
use crate::{Result, compare};

/// Units of a drawing by which its numbers may differ.
const OF_A_DRAWING: f64 = 0.1;

/// Executes these pages, each in a folder of its own with a copy of the examples.
pub fn all(clone: &Path, pages: &[&str]) -> Result<()> {
    let clone = clone.canonicalize()?;
    for page in pages {
        let started = Instant::now();
        let place = env::temp_dir().join(format!("nboom-book-{}", std::process::id()));
        fs::create_dir_all(&place)?;
        let done = Reader { clone: clone.clone(), place: place.clone() }.read(page);
        fs::remove_dir_all(&place)?;
        let (commands, left) = done.map_err(|error| format!("{page}: {error}"))?;
        let left = if left == 0 { String::new() } else { format!(", {left} blocks left out") };
        println!("{page}: {commands} commands{left}, {:.1} s", started.elapsed().as_secs_f64());
    }
    Ok(())
}

struct Reader {
    clone: PathBuf,
    place: PathBuf,
}

impl Reader {
    /// How many commands were run, and how many blocks were not.
    fn read(&self, page: &str) -> Result<(usize, usize)> {
        let text = fs::read_to_string(self.clone.join(page))?;
        self.copy_examples()?;
        let (mut commands, mut left) = (0, 0);
        for block in blocks(&text) {
            let at = |error| format!("line {}: {error}", block.line);
            let (language, more) = block.info.split_once(' ').unwrap_or((&block.info, ""));
            match (language, more.split_once('=').unwrap_or((more, ""))) {
                ("console", ("", "")) => commands += self.console(&block).map_err(at)?,
                ("text", ("", "")) => {}
                ("text", ("prints", command)) => {
                    self.run(command, &block.text.lines().collect::<Vec<_>>()).map_err(at)?;
                    commands += 1;
                }
                ("sh", ("", "")) => left += 1,
                (_, ("file", name)) => fs::write(self.place.join(name), &block.text)?,
                (_, ("add", name)) => {
                    let mut file = OpenOptions::new().append(true).open(self.place.join(name))?;
                    write!(file, "\n{}", block.text)?;
                }
                (_, ("of", path)) => self.part(&block, path).map_err(at)?,
                _ => return Err(at(format!("a block that is `{}`", block.info).into()).into()),
            }
        }
        self.drawings(page, &text)?;
        Ok((commands, left))
    }

    fn copy_examples(&self) -> Result<()> {
        for folder in ["examples", "examples/studies"] {
            let to = self.place.join(folder);
            fs::create_dir_all(&to)?;
            for entry in fs::read_dir(self.clone.join(folder))? {
                let from = entry?.path();
                if from.is_file() {
                    fs::copy(&from, to.join(from.file_name().expect("files have names")))?;
                }
            }
        }
        Ok(())
    }

    fn console(&self, block: &Block) -> Result<usize> {
        let mut commands: Vec<(String, Vec<&str>)> = Vec::new();
        for line in block.text.lines() {
            if let Some(command) = line.strip_prefix("$ ") {
                commands.push((command.to_owned(), Vec::new()));
                continue;
            }
            let (command, printed) = commands.last_mut().ok_or("no command")?;
            match line.strip_prefix("> ").or((line == ">").then_some("")) {
                Some(more) => command.extend(["\n", more]),
                None => printed.push(line),
            }
        }
        for (command, printed) in &commands {
            self.run(command, printed)?;
        }
        Ok(commands.len())
    }

    fn run(&self, command: &str, printed: &[&str]) -> Result<()> {
        let done = Command::new("bash")
            .args(["-euo", "pipefail", "-c", &format!("exec 2>&1\n{command}")])
            .current_dir(&self.place)
            .stdin(Stdio::null())
            .output()?;
        let out = String::from_utf8_lossy(&done.stdout);
        if !done.status.success() {
            return Err(format!("$ {command}\n{out}{}", done.status).into());
        }
        let found: Vec<&str> = out.trim_end().lines().map(str::trim_end).collect();
        if printed.is_empty() || compare::lines(printed, &found) {
            return Ok(());
        }
        Err(format!("$ {command}\nprints\n{out}\nand the page has\n{}", printed.join("\n")).into())
    }

    /// Whether the block stands in a file of the clone, however deep it is indented there.
    fn part(&self, block: &Block, path: &str) -> Result<()> {
        let whole = fs::read_to_string(self.clone.join(path))?;
        let lines = |text: &str| text.trim().lines().map(|l| l.trim().to_owned()).collect();
        let (whole, part): (Vec<String>, Vec<String>) = (lines(&whole), lines(&block.text));
        let found = whole.windows(part.len()).any(|window| window == part);
        if found { Ok(()) } else { Err(format!("{path} has no such lines").into()) }
    }

    /// Compares the pictures of the page with those of the same name that its commands have drawn.
    fn drawings(&self, page: &str, text: &str) -> Result<()> {
        let bless = env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1");
        for picture in pictures(text) {
            let shown = self.clone.join(page).with_file_name(&picture);
            let drawn = self.place.join(shown.file_name().ok_or("a picture without a name")?);
            if !picture.ends_with(".svg") || !drawn.is_file() {
                continue;
            }
            let new = fs::read_to_string(&drawn)?;
            let old = fs::read_to_string(&shown).unwrap_or_default();
            if !compare::text(&old, &new, OF_A_DRAWING) {
                if !bless {
                    let how = "with NBOOM_BLESS=1 the new one takes its place";
                    return Err(format!("{picture} is not what is drawn; {how}").into());
                }
                fs::write(&shown, new)?;
            }
        }
        Ok(())
    }
}
