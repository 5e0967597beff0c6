use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::{FILES, ResultsError};

/// How much of a table waits in memory \[bytes\].
const SHORT: usize = 1 << 13;

/// A table that is passed to the system only in whole lines.
#[derive(Debug)]
pub(crate) struct Output {
    file: WholeLines,
    waiting: Vec<u8>,
}

/// Makes the file `name` of a run, empty, in the directory that it writes into.
pub(crate) fn create(directory: &Path, name: &str) -> io::Result<Output> {
    let file = WholeLines::create(directory, name)?;
    Ok(Output { file, waiting: Vec::with_capacity(2 * SHORT) })
}

impl Output {
    fn hand_on(&mut self) -> io::Result<()> {
        let last = self.waiting.iter().rposition(|byte| *byte == b'\n');
        let whole = last.map_or(0, |newline| newline + 1);
        self.file.append(&self.waiting[..whole])?;
        self.waiting.drain(..whole);
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.check()?;
        self.waiting.extend_from_slice(bytes);
        // Numbers come one by one; only the end of a line completes what waits.
        if self.waiting.len() >= SHORT && bytes.contains(&b'\n') {
            self.hand_on()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.hand_on()
    }
}

/// How much of a long table waits in memory \[bytes\].
const LONG: usize = 1 << 16;

/// A file of lines that wait in memory until a call writes them.
#[derive(Debug)]
pub(crate) struct LongTable {
    path: PathBuf,
    file: WholeLines,
    /// Those that wait, whole ones.
    pub(crate) lines: Vec<u8>,
}

impl LongTable {
    /// Makes the file `name` of a run, empty, in the directory that it writes into; the header
    /// waits.
    pub(crate) fn create(directory: &Path, name: &str, header: &str) -> Result<Self, ResultsError> {
        let path = directory.join(name);
        let file = WholeLines::create(directory, name).map_err(ResultsError::writing(&path))?;
        // Room for the lines of one time beyond the limit.
        let mut lines = Vec::with_capacity(LONG + LONG / 4);
        lines.extend([header.as_bytes(), b"\n"].concat());
        Ok(Self { path, file, lines })
    }

    /// Whether it is time to write.
    pub(crate) fn is_long(&self) -> bool {
        self.lines.len() >= LONG
    }

    /// Passes the lines on to the system.
    pub(crate) fn write(&mut self) -> Result<(), ResultsError> {
        self.file.append(&self.lines).map_err(ResultsError::writing(&self.path))?;
        self.lines.clear();
        Ok(())
    }
}

/// Size of the pieces in which the system takes data \[bytes\]: a process that is killed while it
/// writes has written up to a multiple of this in the file.
const PAGE: usize = 1 << 12;

/// A file that ends with a whole line even when the disk is full, because half a number reads
/// as another number.
///
/// A kill leaves half a line only if the line lies across the end of a page and the kill comes
/// between its two parts. So data is passed on in pieces of which only the first line lies across the end of
/// a page.
#[derive(Debug)]
pub(crate) struct WholeLines {
    file: File,
    /// Length of the file, which ends with a whole line.
    length: u64,
    /// The error for which the file was cut back; nothing can be added after it.
    torn: Option<io::Error>,
}

impl WholeLines {
    fn create(directory: &Path, name: &str) -> io::Result<Self> {
        assert!(FILES.contains(&name), "{name} is in the table of names");
        // Something that already has that name is not ours, and may be a link or a pipe.
        let file = OpenOptions::new().write(true).create_new(true).open(directory.join(name))?;
        Ok(Self { file, length: 0, torn: None })
    }

    /// Adds whole lines.
    fn append(&mut self, mut lines: &[u8]) -> io::Result<()> {
        self.check()?;
        while !lines.is_empty() {
            let room = PAGE - (self.length % PAGE as u64) as usize;
            let (piece, rest) = lines.split_at(first_piece(lines, room));
            self.file.write_all(piece).map_err(|error| self.cut(error))?;
            self.length += piece.len() as u64;
            lines = rest;
        }
        Ok(())
    }

    /// Refuses once the file was cut back.
    fn check(&self) -> io::Result<()> {
        self.torn.as_ref().map_or(Ok(()), |error| Err(same(error)))
    }

    /// Cuts the file back after this error, and gives the error back.
    fn cut(&mut self, error: io::Error) -> io::Error {
        self.torn = Some(same(&error));
        // The first error is the one to report; devices cannot be cut anyway.
        let _ = self.file.set_len(self.length);
        error
    }
}

/// Length of the first line and of those after it that end in the same page, of which `room` is left.
fn first_piece(lines: &[u8], room: usize) -> usize {
    let is_end = |byte: &u8| *byte == b'\n';
    let first = lines.iter().position(is_end).map_or(lines.len(), |newline| newline + 1);
    let page_end = room + first.saturating_sub(room).next_multiple_of(PAGE);
    let within = lines.len().min(page_end);
    lines[..within].iter().rposition(is_end).map_or(first, |newline| newline + 1)
}

/// Another error that says the same.
fn same(error: &io::Error) -> io::Error {
    error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::STATES_FILE;

    #[test]
    fn half_a_line_is_cut_off_and_nothing_follows_it() {
        let place = tempfile::tempdir().expect("a directory");
        let mut out = create(place.path(), STATES_FILE).expect("writable");
        out.file.append(b"1,2\n3,4\n").expect("writable");
        // As much of the next line as fits on the disk.
        out.file.file.write_all(b"5,").expect("writable");
        out.file.cut(io::ErrorKind::StorageFull.into());
        let refused = out.write_all(b"5,6\n").expect_err("nothing can follow");
        assert_eq!(refused.kind(), io::ErrorKind::StorageFull);
        drop(out);
        let text = std::fs::read_to_string(place.path().join(STATES_FILE)).expect("text");
        assert_eq!(text, "1,2\n3,4\n");
    }

    #[test]
    fn no_line_but_the_first_of_a_piece_lies_across_the_end_of_a_page() {
        let lines = |count: usize| b"012345\n".repeat(count);
        // With more room than there are lines, to the end of a line, within the second one.
        for (room, pieces) in [(64, 8), (56, 8), (55, 7), (14, 2), (13, 1), (7, 1)] {
            assert_eq!(first_piece(&lines(8), room), 7 * pieces, "{room}");
        }
        // The first line fills the rest of one page and six bytes of the next, with 4090 left there.
        assert_eq!(first_piece(&lines(1000), 1), 7 * (1 + 4090 / 7));
        // A line alone is longer than a page.
        let long = [b"x".repeat(2 * PAGE), b"\n12\n".to_vec()].concat();
        assert_eq!(first_piece(&long, 100), long.len());
        assert_eq!(first_piece(&long, 4), 2 * PAGE + 4);
        assert_eq!(first_piece(&long, 3), 2 * PAGE + 1);
        assert_eq!(first_piece(b"no end", 3), 6);
    }

    #[test]
    fn lines_arrive_unchanged_and_whole() {
        let place = tempfile::tempdir().expect("a directory");
        let mut out = create(place.path(), STATES_FILE).expect("writable");
        let on_disk = || std::fs::read_to_string(place.path().join(STATES_FILE)).expect("text");
        let mut text = String::new();
        for i in 0..5000 {
            for piece in [format!("{i},"), format!("{}", i * i), "\n".to_owned()] {
                out.write_all(piece.as_bytes()).expect("writable");
                text += &piece;
                let seen = on_disk();
                // What a kill in this moment would leave.
                assert!(seen.is_empty() || seen.ends_with('\n'), "after {i}");
            }
        }
        out.flush().expect("writable");
        assert_eq!(on_disk(), text);
    }
}
