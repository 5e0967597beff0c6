//! Figures of a run for documents: deployment angles and rates, rates of the main body, nutation and direction
//! cosines, as the program of 1970 plotted them, and what it did not: loads, stresses, energy, residuals, rotors,
//! test rigs.
//!
//! [`Plots::of`] draws them from what [`nboom_report::Run`] has read, and [`Plots::files`] gives them as SVG, PNG or
//! PDF. All three are written from the same lines and words; nothing depends on the machine, and no fonts are
//! looked for.
//!
//! ```
//! use nboom_plots::{Format, Plots};
//! # let directory = tempfile::tempdir()?;
//! # std::fs::write(directory.path().join("states.csv"), "t,beta_1_1\n0,0\n1,2\n")?;
//! let run = nboom_report::Run::read(directory.path())?;
//! let files = Plots::of(&run).files(&[Format::Svg]);
//! assert_eq!(files[0].name, "01-deployment-angles.svg");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod drawing;
mod figure;
mod figures;
mod font;
mod pdf;
mod png;
mod sheet;
mod source;
mod style;
mod svg;

use std::collections::BTreeSet;

use nboom_model::visible;
use nboom_report::Run;
use nboom_results::PLOT_MARK as MARK;

use figures::FIGURES;
use sheet::{Mark, Sheet};
use source::Source;

/// The name of the file with all figures, without its ending.
const ALL: &str = "all";

/// A format of figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// Vectors, for the web and for editing; text in the reader's fonts.
    Svg,
    /// Dots, 192 to the inch.
    Png,
    /// Vectors, for print; one file for each figure, and one of all.
    Pdf,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];

    /// Its name, which is the ending of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }
}

/// A file of figures.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotFile {
    /// Its name.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// The figures of a run.
#[derive(Debug)]
pub struct Plots {
    sheets: Vec<(&'static str, Sheet)>,
}

impl Plots {
    /// Draws all figures that the run has the numbers for.
    pub fn of(run: &Run) -> Self {
        let source = Source::new(run);
        let drawn = |entry: &figures::Entry| {
            let sheet = drawing::drawn(&source, &(entry.make)(&source)?)?;
            Some((entry.name, shown(sheet)))
        };
        Self { sheets: FIGURES.iter().filter_map(drawn).collect() }
    }

    /// The letters in them that the built-in font lacks, each once. PNG and PDF have boxes for them.
    pub fn letters_without_shape(&self) -> BTreeSet<char> {
        let marks = self.sheets.iter().flat_map(|(_, sheet)| &sheet.marks);
        let words = marks.filter_map(|mark| match mark {
            Mark::Words(words) => Some(&words.text),
            Mark::Line { .. } | Mark::Dot { .. } => None,
        });
        words.flat_map(|text| text.chars()).filter(|letter| !font::has(*letter)).collect()
    }

    /// The figures as files in these formats.
    pub fn files(&self, formats: &[Format]) -> Vec<PlotFile> {
        let mut files = Vec::new();
        for &format in formats {
            let name = |stem: &str| format!("{stem}.{}", format.name());
            for (stem, sheet) in &self.sheets {
                let bytes = match format {
                    Format::Svg => svg::svg(sheet).into_bytes(),
                    Format::Png => png::png(sheet),
                    Format::Pdf => pdf::pdf(&[sheet]),
                };
                files.push(PlotFile { name: name(stem), bytes });
            }
            if format == Format::Pdf && !self.sheets.is_empty() {
                let sheets: Vec<&Sheet> = self.sheets.iter().map(|(_, sheet)| sheet).collect();
                files.push(PlotFile { name: name(ALL), bytes: pdf::pdf(&sheets) });
            }
        }
        files
    }
}

/// The names that files of figures may have.
pub fn names(formats: &[Format]) -> Vec<String> {
    let stems = |format: Format| {
        let all = (format == Format::Pdf).then_some(ALL);
        FIGURES.iter().map(|entry| entry.name).chain(all)
    };
    let of = |&format: &Format| stems(format).map(move |stem| format!("{stem}.{}", format.name()));
    formats.iter().flat_map(of).collect()
}

/// Replaces what steers text and would not be seen, in all texts.
fn shown(mut sheet: Sheet) -> Sheet {
    sheet.title = visible(&sheet.title);
    for mark in &mut sheet.marks {
        match mark {
            Mark::Words(words) => words.text = visible(&words.text),
            Mark::Line { name: Some(name), .. } | Mark::Dot { name: Some(name), .. } => {
                *name = visible(name);
            }
            Mark::Line { .. } | Mark::Dot { .. } => {}
        }
    }
    sheet
}
