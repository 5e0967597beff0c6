use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::ResultsError;

/// A buffered file of lines.
pub(crate) type Output = BufWriter<WholeLines>;

/// Makes the file at `path`, empty.
pub(crate) fn create(path: &Path) -> io::Result<Output> {
    Ok(BufWriter::new(WholeLines::create(path)?))
}

/// What of a long table waits in memory \[bytes\].
const LONG: usize = 1 << 16;

/// A file of lines that wait in memory until they are written on purpose.
#[derive(Debug)]
pub(crate) struct LongTable {
    path: PathBuf,
    file: WholeLines,
    /// Those that wait, whole ones.
    pub(crate) lines: Vec<u8>,
}

impl LongTable {
    /// Makes the file at `path`, empty; the header waits.
    pub(crate) fn create(path: PathBuf, header: &str) -> Result<Self, ResultsError> {
        let file = WholeLines::create(&path).map_err(ResultsError::writing(&path))?;
        // The lines of one time come on top of what is not yet long.
        let mut lines = Vec::with_capacity(LONG + LONG / 4);
        lines.extend([header.as_bytes(), b"\n"].concat());
        Ok(Self { path, file, lines })
    }

    /// Whether it is time to write.
    pub(crate) fn is_long(&self) -> bool {
        self.lines.len() >= LONG
    }

    /// Hands the lines on to the system.
    pub(crate) fn write(&mut self) -> Result<(), ResultsError> {
        self.file.write_all(&self.lines).map_err(ResultsError::writing(&self.path))?;
        self.lines.clear();
        Ok(())
    }
}

/// A file that ends with a whole line even when the disk is full, because half a number reads
/// as another number.
#[derive(Debug)]
pub(crate) struct WholeLines {
    file: File,
    /// Length of the file up to the end of its last whole line.
    whole: u64,
    /// Length of the file.
    written: u64,
    /// Why the file was cut back, after which nothing can be added.
    torn: Option<io::Error>,
}

impl Write for WholeLines {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if let Some(error) = &self.torn {
            return Err(same(error));
        }
        let written = self.file.write(bytes).map_err(|error| self.cut(error))?;
        if let Some(newline) = bytes[..written].iter().rposition(|byte| *byte == b'\n') {
            self.whole = self.written + newline as u64 + 1;
        }
        self.written += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl WholeLines {
    fn create(path: &Path) -> io::Result<Self> {
        Ok(Self { file: File::create(path)?, whole: 0, written: 0, torn: None })
    }

    /// Cuts the file back after this error, and gives the error back.
    fn cut(&mut self, error: io::Error) -> io::Error {
        if error.kind() != io::ErrorKind::Interrupted {
            self.torn = Some(same(&error));
            // The first error is the one to report; devices cannot be cut anyway.
            let _ = self.file.set_len(self.whole);
        }
        error
    }
}

/// Another error that says the same.
fn same(error: &io::Error) -> io::Error {
    error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_line_is_cut_off_and_nothing_follows_it() {
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("table");
        let mut out = create(&path).expect("writable");
        out.write_all(b"1,2\n3,4\n5,").expect("writable");
        out.flush().expect("writable");
        out.get_mut().cut(io::ErrorKind::StorageFull.into());
        out.write_all(b"6\n").expect("the buffer is empty");
        let refused = out.flush().expect_err("nothing can follow");
        assert_eq!(refused.kind(), io::ErrorKind::StorageFull);
        drop(out);
        assert_eq!(std::fs::read_to_string(&path).expect("text"), "1,2\n3,4\n");
    }

    #[test]
    fn lines_arrive_unchanged() {
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("table");
        let text: String = (0..5000).map(|i| format!("{i},{}\n", i * i)).collect();
        let mut out = create(&path).expect("writable");
        out.write_all(text.as_bytes()).expect("writable");
        out.flush().expect("writable");
        assert_eq!(std::fs::read_to_string(&path).expect("text"), text);
    }
}
