use std::path::{Path, PathBuf};

use clap::Args;
use nboom_plots::{Format, Plots, names};
use nboom_report::Run;
use nboom_results::{check_plots, write_plots};

use crate::{CliError, choice, say};

/// Figures of a run.
#[derive(Args, Debug)]
pub struct PlotArgs {
    /// Also draw figures for documents, into plots/ in the directory: svg, png or pdf, or several of them separated
    /// by commas. Angles, rates, rates of the main body, nutation, direction cosines, loads, stresses, energy, rotors,
    /// test rigs.
    #[arg(id = "plots", long, value_name = "FORMATS", value_delimiter = ',', value_parser = choice::plots)]
    pub formats: Vec<Format>,
}

impl PlotArgs {
    pub(crate) fn are_wanted(&self) -> bool {
        !self.formats.is_empty()
    }

    /// Each format once.
    fn formats(&self) -> Vec<Format> {
        Format::ALL.into_iter().filter(|format| self.formats.contains(format)).collect()
    }

    /// Refuses a directory in which files stand in the way of figures.
    pub(crate) fn check(&self, directory: &Path) -> Result<(), CliError> {
        Ok(check_plots(directory, &names(&self.formats()))?)
    }

    /// Draws the figures of a run into its directory, and returns their paths.
    pub(crate) fn draw(&self, run: &Run, directory: &Path) -> Result<Vec<PathBuf>, CliError> {
        if !self.are_wanted() {
            return Ok(Vec::new());
        }
        let (plots, formats) = (Plots::of(run), self.formats());
        let missing: String = plots.letters_without_shape().into_iter().collect();
        if !missing.is_empty() && formats.iter().any(|format| *format != Format::Svg) {
            let told =
                "figures in PNG and PDF have boxes for letters that their font lacks; SVG has them";
            say("warning", &format!("{told}: {missing}"));
        }
        let files = plots.files(&formats);
        let files = files.iter().map(|file| (file.name.as_str(), file.bytes.as_slice()));
        Ok(write_plots(directory, files)?)
    }
}
