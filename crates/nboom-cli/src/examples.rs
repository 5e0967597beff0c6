//! Examples of each command, for its help. A test executes all that take no time.

use std::fmt::Write;

/// Of all commands together, and what their exit codes mean.
pub(crate) fn nboom() -> String {
    let (new, compared) = if cfg!(feature = "generator") {
        ("\n  nboom new wing       # writes wing.toml, to be edited", "verify, generate --check")
    } else {
        ("", "verify")
    };
    format!(
        "Examples:{new}
  nboom check wing.toml
  nboom run wing.toml  # out/wing/report.html shows it

Exit codes: 0 done; 1 a comparison failed ({compared}); 2 the input or the command line is wrong; \
3 the computation or the writing failed, or a run or a sweep was interrupted, and what was computed \
before is on disk, marked incomplete."
    )
}

pub(crate) const RUN: &str = "\
Examples:
  nboom run wing.toml
  nboom run wing.toml --degrees --columns beta,omega --times 0.5,1,2.5 -o few
  nboom run few/run.json --rtol 1e-12  # the same again, more exactly, into few-repeated
  nboom run springs.toml --case 7  # a case of a study, see nboom sweep";

pub(crate) const SWEEP: &str = "\
Examples:
  nboom sweep springs.toml
  nboom sweep springs.toml -o first --shard 1/2 && nboom sweep springs.toml -o second --shard 2/2";

pub(crate) const MERGE: &str = "\
Examples:
  nboom merge first second -o both";

pub(crate) const REPORT: &str = "\
Examples:
  nboom report out/wing
  nboom report out/wing few -o both.html";

pub(crate) const TABLES: &str = "\
Examples:
  nboom tables out/wing --format parquet,hdf5  # into out/wing-tables";

pub(crate) const CHECK: &str = "\
Examples:
  nboom check wing.toml --picture wing.svg
  nboom check - --format toml < wing.toml";

pub(crate) const VERIFY: &str = "\
Examples:
  nboom verify wing.toml --states 20";

pub(crate) const BENCH: &str = "\
Examples:
  nboom bench boom.toml --seconds 0.01";

#[cfg(feature = "generator")]
pub(crate) const NEW: &str = "\
Examples:
  nboom new boom
  nboom new gimbal -o antenna.toml";

pub(crate) const CONVERT: &str = "\
Examples:
  nboom convert n-boom.toml -o n-boom.nml";

pub(crate) const SCHEMA: &str = "\
Examples:
  nboom schema > scene.schema.json
  nboom schema study > study.schema.json";

pub(crate) const LIST: &str = "\
Examples:
  nboom list";

pub(crate) const SECTION: &str = "\
Examples:
  nboom section sections.json -o stresses.json";

#[cfg(feature = "generator")]
pub(crate) const GENERATE: &str = "\
Examples:
  nboom generate boom.toml -o boom-routines
  nboom generate boom.toml -o boom-routines --check  # whether it is up to date";

#[cfg(feature = "generator")]
pub(crate) const COMPILE: &str = "\
Examples:
  nboom compile wing.toml -o simulate-wing  # then: ./simulate-wing wing.toml";

#[cfg(feature = "generator")]
pub(crate) const COMPLETIONS: &str = "\
Examples:
  nboom completions bash > nboom.bash  # then: source nboom.bash
  nboom completions zsh > _nboom       # into a folder of $fpath
  nboom completions fish > nboom.fish  # into ~/.config/fish/completions";

#[cfg(feature = "generator")]
pub(crate) const MAN: &str = "\
Examples:
  nboom man -o man/man1  # then: man -M man nboom-run";

/// The commands among the lines of a help, one a line.
pub(crate) fn commands(help: &str) -> String {
    let lines = help.lines().filter_map(|line| line.strip_prefix("  "));
    lines.fold(String::new(), |mut text, line| {
        let _ = writeln!(text, "{line}");
        text
    })
}
