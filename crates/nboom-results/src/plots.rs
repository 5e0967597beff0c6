//! Figures made from the files of a run, in a folder of its directory.
//!
//! They are known by a mark at their beginning, like the page. They belong to the run: the next one into the
//! directory takes them away. Other files in the folder stay.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use crate::ResultsError;
use crate::kind::Kind;
use crate::whole::write_whole;

/// Name of the folder of figures within a run's directory.
pub const PLOTS_FOLDER: &str = "plots";

/// What tells a figure from other files, among its first bytes.
pub const PLOT_MARK: &str = "made by nboom";

/// How much of a file is read to recognise it \[bytes\].
const START: u64 = 512;

/// Refuses a place where figures of these names cannot be written: what is there must be of a run.
///
/// # Errors
/// [`ResultsError::Foreign`] when the folder is something else, or a file there is nobody's figure, and
/// [`ResultsError::NotADirectory`] when it would be in something else.
pub fn check_plots(directory: &Path, names: &[String]) -> Result<(), ResultsError> {
    let folder = directory.join(PLOTS_FOLDER);
    let failed = |error: io::Error| match (error.kind(), Kind::of(directory)) {
        (ErrorKind::NotADirectory, Ok(found)) => {
            ResultsError::NotADirectory { path: directory.to_owned(), found }
        }
        _ => ResultsError::writing(&folder)(error),
    };
    match Kind::of(&folder).map_err(failed)? {
        Kind::Nothing => return Ok(()),
        Kind::Directory => {}
        found => return Err(ResultsError::Foreign { path: folder, found }),
    }
    for path in names.iter().map(|name| folder.join(name)) {
        match Kind::of(&path).map_err(ResultsError::writing(&path))? {
            Kind::Nothing => {}
            Kind::File if is_plot(&path) => {}
            found => return Err(ResultsError::Foreign { path, found }),
        }
    }
    Ok(())
}

/// Writes figures, by name, into the folder within `directory`; returns their paths.
///
/// # Errors
/// When a place is refused ([`check_plots`]), before anything is written, or a file cannot be written.
pub fn write_plots<'p>(
    directory: &Path,
    plots: impl Iterator<Item = (&'p str, &'p [u8])> + Clone,
) -> Result<Vec<PathBuf>, ResultsError> {
    let names: Vec<String> = plots.clone().map(|(name, _)| name.to_owned()).collect();
    check_plots(directory, &names)?;
    let folder = directory.join(PLOTS_FOLDER);
    let write = |(name, bytes): (&str, &[u8])| {
        let path = folder.join(name);
        write_whole(&path, bytes).map(|()| path)
    };
    plots.map(write).collect()
}

/// Removes all figures within `directory`, and their folder if nothing else is in it.
pub(crate) fn remove_plots(directory: &Path) -> Result<(), ResultsError> {
    let folder = directory.join(PLOTS_FOLDER);
    let failed = ResultsError::writing(&folder);
    match Kind::of(&folder) {
        Ok(Kind::Directory) => {}
        Ok(_) => return Ok(()),
        Err(error) if error.kind() == ErrorKind::NotADirectory => return Ok(()),
        Err(error) => return Err(failed(error)),
    }
    let removed = plots_in(&folder).and_then(|plots| plots.iter().try_for_each(fs::remove_file));
    removed.map_err(failed)?;
    // What else there is stays, and the folder with it.
    let _ = fs::remove_dir(&folder);
    Ok(())
}

fn plots_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    let paths = entries.into_iter().map(|entry| entry.path());
    Ok(paths.filter(|path| matches!(Kind::of(path), Ok(Kind::File)) && is_plot(path)).collect())
}

fn is_plot(path: &Path) -> bool {
    let mut start = Vec::new();
    let read = File::open(path).and_then(|file| file.take(START).read_to_end(&mut start));
    read.is_ok() && start.windows(PLOT_MARK.len()).any(|bytes| bytes == PLOT_MARK.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIGURE: &[u8] = b"<svg><!-- made by nboom --></svg>";

    #[test]
    fn figures_are_replaced_and_removed_and_other_files_stay() {
        let place = tempfile::tempdir().expect("a directory");
        let (directory, folder) = (place.path(), place.path().join(PLOTS_FOLDER));
        let plots = [("a.svg", FIGURE), ("b.svg", FIGURE)];
        for _ in 0..2 {
            let paths = write_plots(directory, plots.into_iter()).expect("writable");
            assert_eq!(paths, [folder.join("a.svg"), folder.join("b.svg")]);
        }
        remove_plots(directory).expect("removable");
        assert!(!folder.exists());
        write_plots(directory, plots.into_iter()).expect("writable");
        fs::write(folder.join("notes.txt"), "mine").expect("writable");
        fs::write(folder.join("b.svg"), "edited by hand").expect("writable");
        remove_plots(directory).expect("removable");
        let left = fs::read_dir(&folder).expect("readable").count();
        assert_eq!((left, folder.join("a.svg").exists()), (2, false));
        let refused = write_plots(directory, plots.into_iter()).expect_err("it is mine");
        assert!(refused.is_refusal() && !folder.join("a.svg").exists(), "{refused}");
    }

    #[test]
    fn a_file_in_the_place_of_the_directory_is_told_as_one() {
        let place = tempfile::tempdir().expect("a directory");
        let file = place.path().join("scene.toml");
        fs::write(&file, "mine").expect("writable");
        let refused = check_plots(&file, &[]).expect_err("it is a file");
        let ResultsError::NotADirectory { path, found: Kind::File } = &refused else {
            panic!("{refused}")
        };
        assert_eq!(path, &file);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed() {
        let place = tempfile::tempdir().expect("a directory");
        let (directory, folder) = (place.path(), place.path().join(PLOTS_FOLDER));
        let elsewhere = tempfile::tempdir().expect("a directory");
        fs::write(elsewhere.path().join("a.svg"), FIGURE).expect("writable");
        std::os::unix::fs::symlink(elsewhere.path(), &folder).expect("a unix system");
        remove_plots(directory).expect("there are none");
        let refused = write_plots(directory, [("a.svg", FIGURE)].into_iter());
        assert!(refused.expect_err("it is a link").is_refusal());
        assert!(elsewhere.path().join("a.svg").exists());
    }
}
