//! The journal of a sweep: an append-only file of frames, each of which has the rows of some cases.
//!
//! Frames come in any order. A process that is killed, or a disk that is full, leaves an unfinished frame at
//! the end at most, which the next writer cuts off. Only the ranges of cases are held in memory.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use nboom_tables::{Cell, Column, CsvRows};

use crate::StudyError;
use crate::frame::{Head, LONGEST_HEAD, case_of};

/// How much of a file is read at once \[bytes\].
const BUFFER: usize = 1 << 16;

/// Which cases a journal has, and where.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    /// The cases that it may have.
    cases: RangeInclusive<u64>,
    /// In order of cases.
    frames: Vec<Frame>,
    /// Where the last whole frame ends.
    end: u64,
    /// How long the file is.
    length: u64,
}

/// A range of cases.
#[derive(Clone, Copy, Debug)]
struct Frame {
    first: u64,
    last: u64,
    /// Where it begins in the file.
    at: u64,
}

/// Which rows of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// Its row in the table of cases.
    Case,
    /// Its rows in the table of trajectories.
    States,
}

impl Journal {
    /// Reads which of these cases a journal has, and verifies all of it; without a file it has none.
    ///
    /// # Errors
    /// When a frame before the last one is damaged, and when a case is another sweep's or there twice.
    pub fn read(path: &Path, cases: RangeInclusive<u64>) -> Result<Self, StudyError> {
        let path = path.to_owned();
        let mut journal = Self { path, cases, frames: Vec::new(), end: 0, length: 0 };
        let file = match File::open(&journal.path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(journal),
            opened => opened.map_err(StudyError::reading(&journal.path))?,
        };
        journal.length = file.metadata().map_err(StudyError::reading(&journal.path))?.len();
        journal.scan(&mut BufReader::with_capacity(BUFFER, file))?;
        Ok(journal)
    }

    /// # Errors
    /// When the file ends with something other than a whole frame.
    pub fn require_whole(&self) -> Result<(), StudyError> {
        if self.end == self.length { Ok(()) } else { Err(self.damaged(self.end, "no whole batch")) }
    }

    /// How long the file is \[bytes\].
    pub fn bytes(&self) -> u64 {
        self.length
    }

    /// How many cases there are.
    pub fn done(&self) -> u64 {
        self.frames.iter().map(|frame| frame.last - frame.first + 1).sum()
    }

    /// The cases that are not there, in order.
    pub fn missing(&self) -> Vec<RangeInclusive<u64>> {
        let mut next = *self.cases.start();
        let mut missing = Vec::new();
        for frame in &self.frames {
            if next < frame.first {
                missing.push(next..=frame.first - 1);
            }
            next = frame.last + 1;
        }
        if next <= *self.cases.end() {
            missing.push(next..=*self.cases.end());
        }
        missing
    }

    /// Hands on rows in order of cases, as cells of these columns, of which the first is the case.
    ///
    /// # Errors
    /// When the file cannot be read or has other rows, and those of `take`.
    pub fn each(
        &self,
        part: Part,
        columns: &[Column],
        mut take: impl FnMut(&[Cell<'_>]) -> Result<(), StudyError>,
    ) -> Result<(), StudyError> {
        if self.frames.is_empty() {
            return Ok(());
        }
        let file = File::open(&self.path).map_err(StudyError::reading(&self.path))?;
        let mut file = BufReader::with_capacity(BUFFER, file);
        for frame in &self.frames {
            let rows = self.rows(&mut file, *frame, part)?;
            self.each_of(*frame, part, rows, columns, &mut take)?;
        }
        Ok(())
    }

    /// The journal, open for more frames after those that are whole; what is left of another is cut off.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn writer(&mut self) -> Result<JournalWriter<'_>, StudyError> {
        let opened = OpenOptions::new().write(true).create(true).truncate(false).open(&self.path);
        let cut = opened.and_then(|mut file| {
            file.set_len(self.end)?;
            file.seek(SeekFrom::Start(self.end))?;
            file.sync_all()?;
            Ok(file)
        });
        let file = cut.map_err(StudyError::writing(&self.path))?;
        self.length = self.end;
        Ok(JournalWriter { journal: self, file })
    }

    /// Finds the whole frames of a file.
    fn scan(&mut self, file: &mut BufReader<File>) -> Result<(), StudyError> {
        while self.end < self.length {
            let found = next_frame(file, self.length - self.end);
            let found = found.map_err(StudyError::reading(&self.path))?;
            let Some((Head { first, last, .. }, bytes)) = found else { break };
            if !self.cases.contains(&first) || !self.cases.contains(&last) {
                let (from, to) = (self.cases.start(), self.cases.end());
                let found = format!("cases {first} to {last}, some of {from} to {to} expected,");
                return Err(self.damaged(self.end, &found));
            }
            self.frames.push(Frame { first, last, at: self.end });
            self.end += bytes;
        }
        if self.end < self.length {
            let another =
                has_head_after(file, self.end).map_err(StudyError::reading(&self.path))?;
            if another {
                return Err(self.damaged(self.end, "a damaged batch before others"));
            }
        }
        self.sort()
    }

    /// Puts frames in order of cases.
    ///
    /// # Errors
    /// When a case is in two of them.
    fn sort(&mut self) -> Result<(), StudyError> {
        self.frames.sort_unstable_by_key(|frame| frame.first);
        let mut pairs = self.frames.windows(2);
        match pairs.find(|pair| pair[1].first <= pair[0].last) {
            None => Ok(()),
            Some(pair) => {
                let found = format!("case {} for the second time", pair[1].first);
                Err(self.damaged(pair[0].at.max(pair[1].at), &found))
            }
        }
    }

    /// The rows of a frame.
    fn rows<'a>(
        &self,
        file: &'a mut BufReader<File>,
        frame: Frame,
        part: Part,
    ) -> Result<io::Take<&'a mut BufReader<File>>, StudyError> {
        let mut read = || {
            file.seek(SeekFrom::Start(frame.at))?;
            let head = head(file)?.ok_or(ErrorKind::InvalidData)?;
            if part == Part::States {
                file.seek_relative(head.rows.cast_signed())?;
            }
            Ok(if part == Part::Case { head.rows } else { head.states })
        };
        let bytes: io::Result<u64> = read();
        Ok(file.take(bytes.map_err(StudyError::reading(&self.path))?))
    }

    fn each_of(
        &self,
        frame: Frame,
        part: Part,
        rows: impl Read,
        columns: &[Column],
        take: &mut impl FnMut(&[Cell<'_>]) -> Result<(), StudyError>,
    ) -> Result<(), StudyError> {
        let wrong = |found: String| self.damaged(frame.at, &format!("a batch with {found}"));
        let mut rows = CsvRows::new(rows, columns);
        let mut next = frame.first;
        while let Some(cells) = rows.next_row().map_err(&wrong)? {
            let case = case_of(&cells);
            let is_in_order = match part {
                Part::Case => case == next && case <= frame.last,
                Part::States => (next..=frame.last).contains(&case),
            };
            if !is_in_order {
                return Err(wrong(format!("a row of case `{}` where {next} is due", cells[0])));
            }
            take(&cells)?;
            next = if part == Part::Case { case + 1 } else { case };
        }
        if part == Part::Case && next != frame.last + 1 {
            return Err(wrong(format!("no row of case {next}")));
        }
        Ok(())
    }

    fn damaged(&self, byte: u64, found: &str) -> StudyError {
        StudyError::Journal { path: self.path.clone(), byte, found: found.to_owned() }
    }
}

/// A journal that grows.
#[derive(Debug)]
pub(crate) struct JournalWriter<'a> {
    journal: &'a mut Journal,
    file: File,
}

impl JournalWriter<'_> {
    /// Adds the frame of these cases, in pieces, which are not there yet, and waits for the disk.
    ///
    /// # Errors
    /// When it cannot be written; nothing may be added then.
    pub fn append(
        &mut self,
        frame: &[impl AsRef<[u8]>],
        cases: RangeInclusive<u64>,
    ) -> Result<(), StudyError> {
        let pieces = || frame.iter().map(AsRef::as_ref);
        let written = pieces().try_for_each(|piece| self.file.write_all(piece));
        let written = written.and_then(|()| self.file.sync_data());
        let journal = &mut *self.journal;
        written.map_err(StudyError::writing(&journal.path))?;
        let (first, last) = cases.into_inner();
        journal.frames.push(Frame { first, last, at: journal.end });
        journal.end += pieces().map(<[u8]>::len).sum::<usize>() as u64;
        journal.length = journal.end;
        Ok(())
    }
}

impl Drop for JournalWriter<'_> {
    fn drop(&mut self) {
        // Cases are handed out once, so that none is there twice.
        self.journal.frames.sort_unstable_by_key(|frame| frame.first);
    }
}

/// Reads the first line of a frame.
fn head(file: &mut BufReader<File>) -> io::Result<Option<Head>> {
    let mut line = Vec::new();
    file.by_ref().take(LONGEST_HEAD).read_until(b'\n', &mut line)?;
    Ok(Head::parse(&line))
}

/// Reads a frame that ends within so many bytes, and how long it is; none if it is not whole.
fn next_frame(file: &mut BufReader<File>, within: u64) -> io::Result<Option<(Head, u64)>> {
    let Some(head) = head(file)? else { return Ok(None) };
    let rows = head.rows.checked_add(head.states);
    let bytes = rows.and_then(|rows| rows.checked_add(head.text().len() as u64));
    let (Some(rows), Some(bytes)) = (rows, bytes.filter(|bytes| *bytes <= within)) else {
        return Ok(None);
    };
    let mut checksum = crc32fast::Hasher::new();
    checksum.update(head.said().as_bytes());
    let mut rest = file.take(rows);
    loop {
        let piece = rest.fill_buf()?;
        if piece.is_empty() {
            break;
        }
        checksum.update(piece);
        let read = piece.len();
        rest.consume(read);
    }
    Ok((checksum.finalize() == head.checksum).then_some((head, bytes)))
}

/// Whether a line after the first one from there on begins a frame.
fn has_head_after(file: &mut BufReader<File>, at: u64) -> io::Result<bool> {
    file.seek(SeekFrom::Start(at))?;
    let mut piece = Vec::new();
    let mut begins_line = false;
    loop {
        piece.clear();
        if file.by_ref().take(LONGEST_HEAD).read_until(b'\n', &mut piece)? == 0 {
            return Ok(false);
        }
        if begins_line && Head::parse(&piece).is_some() {
            return Ok(true);
        }
        begins_line = piece.ends_with(b"\n");
    }
}

#[cfg(test)]
mod tests;
