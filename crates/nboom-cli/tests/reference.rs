//! `docs/cli.md` says what the command line really takes.

use std::fs;
use std::path::Path;

#[test]
fn the_reference_is_that_of_this_command_line() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/cli.md");
    let expected = nboom_cli::reference();
    if std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1") {
        fs::write(&path, &expected).expect("docs/cli.md can be written");
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "docs/cli.md is out of date; NBOOM_BLESS=1 rewrites it");
}
