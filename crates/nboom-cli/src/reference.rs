use clap::{Arg, Command, CommandFactory};

use crate::{Cli, examples};

/// The text of `docs/cli.md`, made from the definition of the command line.
pub fn reference() -> String {
    let mut root = Cli::command();
    root.build();
    let mut text = String::from("# Command line\n\n");
    text.push_str("Made from the command line's own definition; `cargo test -p nboom-cli` with\n");
    text.push_str("`NBOOM_BLESS=1` rewrites it.\n\n");
    paragraph(&mut text, root.get_long_about().or(root.get_about()));
    paragraph(&mut text, root.get_after_help());
    for command in root.get_subcommands_mut().filter(|command| command.get_name() != "help") {
        text.push_str(&section(command));
    }
    text.trim_end().to_owned() + "\n"
}

fn section(command: &mut Command) -> String {
    let usage = command.render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ");
    let mut text = format!("## `{usage}`\n\n");
    paragraph(&mut text, command.get_long_about().or(command.get_about()));
    text.push_str("| argument | meaning | default |\n| --- | --- | --- |\n");
    for arg in command.get_arguments().filter(|arg| arg.get_id() != "help") {
        text.push_str(&row(arg));
    }
    text.push('\n');
    if let Some(examples) = command.get_after_help() {
        text.push_str(&format!("```sh\n{}```\n\n", examples::commands(&examples.to_string())));
    }
    text
}

fn row(arg: &Arg) -> String {
    let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
    // Outside code marks Markdown takes <NAME> for an HTML tag.
    let help = help.trim_end_matches('.').replace('<', "\\<");
    format!("| `{}` | {help}{} | {} |\n", name(arg), choices(arg), default(arg))
}

fn name(arg: &Arg) -> String {
    match arg.get_short() {
        Some(short) => format!("-{short}, {arg}"),
        None => arg.to_string(),
    }
}

fn default(arg: &Arg) -> String {
    // Flags have a default too, which is never written.
    if !arg.get_action().takes_values() {
        return String::new();
    }
    let values = arg.get_default_values().iter();
    values.map(|value| format!("`{}`", value.to_string_lossy())).collect::<Vec<_>>().join(" ")
}

fn choices(arg: &Arg) -> String {
    let possible = arg.get_possible_values();
    let names: Vec<String> = possible.iter().map(|v| format!("`{}`", v.get_name())).collect();
    if names.is_empty() || !arg.get_action().takes_values() {
        String::new()
    } else {
        format!(": {}", names.join(", "))
    }
}

fn paragraph(text: &mut String, words: Option<&clap::builder::StyledStr>) {
    if let Some(words) = words {
        text.push_str(&format!("{words}\n\n"));
    }
}
