//! Makes the book of the pages in `docs/`, and does what the pages say.
//!
//! ```sh
//! nboom-book build CLONE FOLDER      # writes the book, and checks every link in it
//! nboom-book run CLONE PAGE...       # executes the blocks of pages, paths from the clone
//! ```

use std::env;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

mod build;
mod compare;
mod execute;
mod links;
mod maths;
mod page;
mod source;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> ExitCode {
    let words: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["build", clone, folder] => build::build(Path::new(clone), Path::new(folder)),
        ["run", clone, pages @ ..] => execute::all(Path::new(clone), pages),
        _ => Err("nboom-book build CLONE FOLDER, or nboom-book run CLONE PAGE...".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
