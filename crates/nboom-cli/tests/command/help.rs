//! Help, completions and manual pages: what they say works.

use std::fs;
use std::path::Path;
use std::process::Command;

use clap::{CommandFactory, Parser};
use nboom_cli::Cli;

use crate::{Place, code, stderr, stdout};

/// Commands of examples that take minutes.
const LONG: [&str; 1] = ["compile"];

/// The examples of all commands: the command, and a line for a shell.
fn examples() -> Vec<(String, String)> {
    let mut root = Cli::command();
    root.build();
    let mut found = Vec::new();
    for command in [root.clone()].iter().chain(root.get_subcommands()) {
        let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        let lines = help.lines().filter_map(|line| line.strip_prefix("  "));
        let lines: Vec<String> = lines.map(str::to_owned).collect();
        let name = command.get_name();
        assert!(!lines.is_empty() || name == "help", "{name} has no example");
        found.extend(lines.into_iter().map(|line| (name.to_owned(), line)));
    }
    found
}

/// The words of a line up to what only a shell understands.
fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().take_while(|word| !["#", ">", "<", "|", "&&"].contains(word)).collect()
}

#[test]
fn examples_are_of_their_commands_and_right() {
    for (command, line) in examples() {
        let words = words(&line);
        assert!(command == "nboom" || words[1] == command, "{line}");
        if let Err(error) = Cli::try_parse_from(&words) {
            panic!("{line}: {error}");
        }
    }
}

#[test]
fn examples_run() {
    let place = Place::new();
    for kind in ["boom", "n-boom"] {
        let kept = format!("{kind}.toml");
        assert_eq!(code(&place.nboom(&["new", kind, "-o", &kept])), 0);
    }
    place.write("springs.toml", crate::sweeps::STUDY);
    let case = serde_json::json!({ "id": "boom", "kind": "circular", "R": 0.1, "t": 0.001 });
    place.write("sections.json", &serde_json::json!({ "cases": [case] }).to_string());
    let binary = Path::new(env!("CARGO_BIN_EXE_nboom")).parent().expect("a folder");
    let search = std::env::var("PATH").expect("there is one");
    let search = format!("{}:{search}", binary.display());
    for (command, line) in examples() {
        let has_formats = cfg!(all(feature = "parquet", feature = "hdf5"));
        if LONG.contains(&command.as_str()) || command == "tables" && !has_formats {
            continue;
        }
        if line.starts_with("nboom new boom") {
            fs::remove_file(place.path("boom.toml")).expect("it is there");
        }
        let mut shell = Command::new("sh");
        shell.args(["-c", &line]).env("PATH", &search).current_dir(place.path("."));
        let output = shell.output().expect("a shell");
        assert!(output.status.success(), "{line}: {}", stderr(&output));
    }
    for made in
        ["out/wing/report.html", "few-repeated/summary.json", "both.html", "man/man1/nboom.1"]
    {
        assert!(place.path(made).is_file(), "{made}");
    }
}

/// Whether a program is installed.
fn has(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

#[test]
fn shells_accept_their_completions() {
    let place = Place::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = place.nboom(&["completions", shell]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let script = stdout(&output);
        for word in ["work-precision", "units-in-headers", "avx512"] {
            assert_eq!(script.contains(word), word != "avx512", "{shell}: {word}");
        }
        let file = format!("nboom.{shell}");
        place.write(&file, &script);
        if !["bash", "zsh", "fish"].contains(&shell) || !has(shell) {
            continue;
        }
        let output =
            Command::new(shell).arg("-n").arg(place.path(&file)).output().expect("a shell");
        assert!(output.status.success(), "{shell}: {}", stderr(&output));
    }
    if has("bash") {
        // What a user gets who presses the key after `nboom run --int`.
        let script = "source nboom.bash; COMP_WORDS=(nboom run --int); COMP_CWORD=2; \
                      _nboom nboom --int run; echo ${COMPREPLY[@]}";
        let mut shell = Command::new("bash");
        let output = shell.args(["-c", script]).current_dir(place.path(".")).output();
        let output = output.expect("a shell");
        assert_eq!(stdout(&output).trim(), "--integrator", "{}", stderr(&output));
    }
    crate::refused(&place.nboom(&["completions", "dos"]), 2, &["dos", "bash", "zsh"]);
}

#[test]
fn manual_pages_are_pages_of_all_commands() {
    let place = Place::new();
    let output = place.nboom(&["man", "-o", "man1"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let pages: Vec<String> = stdout(&output).lines().map(str::to_owned).collect();
    let command = Cli::command();
    for name in command.get_subcommands().map(clap::Command::get_name) {
        assert!(pages.contains(&format!("man1/nboom-{name}.1")), "{name}: {pages:?}");
    }
    for page in &pages {
        let text = fs::read_to_string(place.path(page)).expect("a page");
        assert!(text.contains(".TH ") && text.contains(".SH NAME"), "{page}");
        if has("mandoc") {
            let mut lint = Command::new("mandoc");
            lint.args(["-Tlint", "-Wwarning"]).arg(place.path(page));
            let output = lint.output().expect("mandoc");
            assert!(output.status.success(), "{page}: {}", stdout(&output));
        }
        if has("man") {
            let mut man = Command::new("man");
            let output =
                man.args(["--warnings", "-l"]).arg(place.path(page)).output().expect("man");
            assert!(
                output.status.success() && stderr(&output).is_empty(),
                "{page}: {}",
                stderr(&output)
            );
        }
    }
    // A link is not followed.
    #[cfg(unix)]
    {
        fs::remove_file(place.path("man1/nboom.1")).expect("it is there");
        std::os::unix::fs::symlink("/dev/null", place.path("man1/nboom.1")).expect("a link");
        crate::refused(&place.nboom(&["man", "-o", "man1"]), 2, &["man1/nboom.1", "a link"]);
    }
}

/// What a run prints on a terminal, and in the pipe that its output is.
fn on_a_terminal(place: &Place, environment: &[(&str, &str)], words: &str) -> String {
    let mut script = Command::new("script");
    let line = format!("{} {words}", env!("CARGO_BIN_EXE_nboom"));
    script.args(["-qec", &line, "/dev/null"]).current_dir(place.path("."));
    // What a terminal is asked for by the environment that the test happens to run in, a
    // server that takes colours included.
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "CI"] {
        script.env_remove(name);
    }
    script.env("TERM", "xterm-256color").envs(environment.iter().copied());
    String::from_utf8_lossy(&script.output().expect("script").stdout).into_owned()
}

#[test]
fn colours_and_progress_are_for_terminals_that_want_them() {
    let place = Place::new();
    // Not on every system.
    if !has("script") {
        return;
    }
    // Some tenths of a second, so that the bar is drawn again.
    let run = "run boom.nml -o out --samples 200000 --no-report";
    let wrong = "run nowhere.nml";
    let red = "\u{1b}[1m\u{1b}[31merror:";
    assert!(on_a_terminal(&place, &[], wrong).contains(red));
    let told = on_a_terminal(&place, &[], run);
    assert!(told.contains(" left") && told.contains('%'), "{told:?}");
    for environment in [[("NO_COLOR", "1")], [("TERM", "dumb")]] {
        let told = on_a_terminal(&place, &environment, wrong);
        assert!(told.contains("error: ") && !told.contains('\u{1b}'), "{told:?}");
    }
    assert!(!on_a_terminal(&place, &[("TERM", "dumb")], run).contains(" left"));
    assert!(!on_a_terminal(&place, &[("NO_COLOR", "1")], run).contains("\u{1b}[3"));
    assert_eq!(on_a_terminal(&place, &[], &format!("{run} --quiet")), "");
    // Of a pipe nothing but the account.
    let piped = place.nboom(&run.split(' ').collect::<Vec<_>>());
    assert_eq!(stderr(&piped), "");
    assert!(!stdout(&piped).contains('\u{1b}'));
    assert!(!stderr(&place.nboom(&["run", "nowhere.nml"])).contains('\u{1b}'));
}
