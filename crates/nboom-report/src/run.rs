//! What a run left in its directory.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use nboom_io::SceneFile;
use nboom_model::{Scene, UnitSystem};
use nboom_results::{
    ENVELOPE_FILE, FILES, HINGE_ENVELOPE_FILE, INSTANTS_FILE, LEDGER_FILE, SCENE_FILE, STATES_FILE,
    SUMMARY_FILE, TRUST_FILE,
};
use serde_json::Value;

use crate::events::{self, EventKeys};
use crate::geometry;
use crate::kick_offs;
use crate::loads::{self, Envelope, Loads, Worst};
use crate::nutation::{self, SpinAxis};
use crate::requested;
use crate::rotors;
use crate::rounding::Sizes;
use crate::table::{Table, read_columns};
use crate::{Gap, ReportError};

/// The longest summary or certificate that is read \[bytes\].
const LONGEST_JSON: u64 = 1 << 26;

/// The longest text of a scene in a page \[bytes\].
const LONGEST_SCENE: usize = 1 << 18;

/// Most rows of an envelope in a page.
const MOST_WORST: usize = 5_000;

/// Most entries of the lists in a summary or certificate; what is beyond them is in these files.
const MOST_ENTRIES: usize = 500;

/// A run, as far as its directory has it.
#[derive(Debug)]
pub struct Run {
    pub(crate) label: String,
    pub(crate) units: UnitSystem,
    pub(crate) summary: Option<Value>,
    pub(crate) certificate: Option<Value>,
    pub(crate) file: Option<SceneFile>,
    pub(crate) text: Option<String>,
    pub(crate) events: Vec<EventKeys>,
    pub(crate) motion: Option<Table>,
    pub(crate) spin_axis: SpinAxis,
    pub(crate) kick_offs: Option<Table>,
    pub(crate) rotor_speeds: Option<Table>,
    pub(crate) requested: Option<Table>,
    pub(crate) ledger: Option<Table>,
    pub(crate) hinge_loads: Option<Loads>,
    pub(crate) stresses: Option<Loads>,
    pub(crate) hinge_envelope: Vec<Worst>,
    pub(crate) stress_envelope: Vec<Worst>,
    gaps: Vec<Gap>,
}

impl Run {
    /// Reads the files of a run in `directory`.
    ///
    /// # Errors
    /// When it is no directory, or has no file of a run. Files that are missing or broken become gaps.
    pub fn read(directory: &Path) -> Result<Self, ReportError> {
        let path = directory.to_owned();
        if !directory.is_dir() {
            return Err(ReportError::NoDirectory { path });
        }
        if ![SUMMARY_FILE, STATES_FILE].iter().any(|name| directory.join(name).is_file()) {
            let has_partial = partial(directory).is_some_and(|partial| partial.is_dir());
            return Err(ReportError::NothingOfARun { path, has_partial });
        }
        let mut gaps = Vec::new();
        let summary = json(directory, SUMMARY_FILE, &mut gaps);
        if summary.is_none() && gaps.is_empty() {
            gaps.push(Gap::Missing { file: SUMMARY_FILE, shows: "verdict" });
        }
        gaps.extend(summary.as_ref().and_then(other_version));
        let certificate = json(directory, TRUST_FILE, &mut gaps);
        let file = kept(geometry::read(directory), &mut gaps);
        let units =
            summary.as_ref().and_then(|keys| UnitSystem::from_name(keys["units"].as_str()?));
        let of_scene = file.as_ref().and_then(|file| file.settings.units.clone());
        let mut run = Self {
            label: label(directory, summary.as_ref()),
            units: units.or(of_scene).unwrap_or_default(),
            text: text(directory),
            file,
            summary,
            certificate,
            events: Vec::new(),
            motion: None,
            spin_axis: SpinAxis::default(),
            kick_offs: None,
            rotor_speeds: None,
            requested: None,
            ledger: None,
            hinge_loads: None,
            stresses: None,
            hinge_envelope: Vec::new(),
            stress_envelope: Vec::new(),
            gaps,
        };
        run.read_tables(directory);
        run.check_files(directory);
        run.check_scene();
        run.kick_offs = kick_offs::of(&run);
        run.rotor_speeds = rotors::commanded(&run);
        Ok(run)
    }

    /// What is missing or cannot be read.
    pub fn gaps(&self) -> &[Gap] {
        &self.gaps
    }

    /// What the run is called.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Labels of its units.
    pub fn units(&self) -> &UnitSystem {
        &self.units
    }

    /// Whether its summary says that it came to its end.
    pub fn is_complete(&self) -> bool {
        self.summary.as_ref().is_some_and(|keys| keys["complete"] == true)
    }

    /// The scene, if it can be read and is that of the motion.
    pub fn scene(&self) -> Option<&Scene> {
        self.file.as_ref().map(|file| &file.scene)
    }

    /// Events, in the order of time.
    pub fn events(&self) -> &[EventKeys] {
        &self.events
    }

    /// The motion in the columns of `states.csv`, at output times and on both sides of each event; sums of
    /// angles and rates and states of hinges are left out. Its nutation is about the [spin axis](Self::spin_axis).
    pub fn motion(&self) -> Option<&Table> {
        self.motion.as_ref()
    }

    /// Forces of kick-off springs in the rows of the motion, in columns like `force_1_2`; a spring that has let go has
    /// none.
    pub fn kick_offs(&self) -> Option<&Table> {
        self.kick_offs.as_ref()
    }

    /// The ledger of energy, in the columns of `ledger.csv`.
    pub fn ledger(&self) -> Option<&Table> {
        self.ledger.as_ref()
    }

    /// Magnitudes of the loads of hinges over time, in columns like `force_1_2` and `moment_1_2`.
    pub fn hinge_loads(&self) -> Option<&Table> {
        self.hinge_loads.as_ref().map(|loads| &loads.motion)
    }

    /// The largest von Mises stress of each station over time, in columns like `1_2_3`: appendage, segment and
    /// station.
    pub fn stresses(&self) -> Option<&Table> {
        self.stresses.as_ref().map(|loads| &loads.motion)
    }

    /// The largest loads of hinges in the whole motion, with the pulses of latches and stops if it has any.
    pub fn hinge_envelope(&self) -> &[Worst] {
        &self.hinge_envelope
    }

    /// The largest stresses of stations in the whole motion, pulses of latches and stops included.
    pub fn stress_envelope(&self) -> &[Worst] {
        &self.stress_envelope
    }

    /// Calls the run by the name of its directory, beside others.
    #[must_use]
    pub fn named_by(self, directory: &Path) -> Self {
        let name = directory.display().to_string();
        Self { label: name, ..self }
    }

    /// All tables.
    pub(crate) fn tables(&self) -> impl Iterator<Item = &Table> + Clone {
        let loads = self.hinge_loads.iter().chain(&self.stresses);
        let of_loads = loads.flat_map(|loads| [&loads.motion, &loads.peaks]);
        let beside = [&self.kick_offs, &self.rotor_speeds, &self.requested, &self.ledger];
        self.motion.iter().chain(beside.into_iter().flatten()).chain(of_loads)
    }

    pub(crate) fn tables_mut(&mut self) -> impl Iterator<Item = &mut Table> {
        let loads = self.hinge_loads.iter_mut().chain(&mut self.stresses);
        let of_loads = loads.flat_map(|loads| [&mut loads.motion, &mut loads.peaks]);
        let beside =
            [&mut self.kick_offs, &mut self.rotor_speeds, &mut self.requested, &mut self.ledger];
        self.motion.iter_mut().chain(beside.into_iter().flatten()).chain(of_loads)
    }

    fn read_tables(&mut self, directory: &Path) {
        let gaps = &mut self.gaps;
        let is_shown = (is_shown, self.file.as_ref().map(|file| Sizes::of(&file.scene)));
        let mut motion = columns(directory, STATES_FILE, Some("motion"), is_shown, gaps);
        let instants = columns(directory, INSTANTS_FILE, None, is_shown, gaps);
        if let (Some(motion), Some(instants)) = (&mut motion, instants)
            && motion.names == instants.names
        {
            motion.merge(&instants);
        }
        // A picture of nothing is none.
        self.motion = motion.filter(|motion| motion.rows() > 0);
        self.spin_axis = self.motion.as_mut().map(nutation::about_spin_axis).unwrap_or_default();
        let ledger =
            columns(directory, LEDGER_FILE, Some("ledger of energy"), (|_| true, None), gaps);
        self.ledger = ledger.filter(|ledger| ledger.rows() > 0);
        self.requested = requested::read(directory, gaps);
        self.events = events::read(directory, gaps);
        for (loads, read) in [
            (&mut self.hinge_loads, loads::hinge_loads as fn(&Path) -> _),
            (&mut self.stresses, loads::stresses),
        ] {
            let found: Option<Loads> = kept(read(directory), gaps).flatten();
            *loads = found.filter(|loads| loads.motion.rows() > 0);
            gaps.extend(loads.as_mut().and_then(|loads| loads.gap.take()));
        }
        let (hinges, stations) =
            (loads::hinge_envelope(directory), loads::stress_envelope(directory));
        self.hinge_envelope = worst(HINGE_ENVELOPE_FILE, hinges, gaps);
        self.stress_envelope = worst(ENVELOPE_FILE, stations, gaps);
    }

    /// Names what a complete run has written and is gone, unless its own gap does.
    fn check_files(&mut self, directory: &Path) {
        let Some(summary) = self.summary.as_ref().filter(|_| self.is_complete()) else { return };
        let listed = summary["files"].as_array().map_or(&[][..], Vec::as_slice);
        let told = |name: &str| {
            self.gaps.iter().any(|gap| matches!(gap, Gap::Missing { file, .. } if *file == name))
        };
        let gone = FILES.into_iter().filter(|name| {
            listed.iter().any(|file| file == name) && !directory.join(name).exists() && !told(name)
        });
        let gone: Vec<Gap> = gone.map(|file| Gap::Gone { file }).collect();
        self.gaps.extend(gone);
    }

    /// Leaves the scene out if it is not that of the motion.
    fn check_scene(&mut self) {
        let (Some(file), Some(motion)) = (&self.file, &mut self.motion) else { return };
        let joints = |name: &&String| name.starts_with("beta_");
        let (scene, table) = (file.scene.bodies.len(), motion.names.iter().filter(joints).count());
        if scene != table {
            self.gaps.push(Gap::OtherScene { scene, table });
            (self.file, motion.sizes) = (None, None);
        }
    }
}

/// Whether the page shows a column of the motion: sums of angles follow from them, states from events.
fn is_shown(name: &str) -> bool {
    !["alpha_", "sigma_", "state_"].iter().any(|left_out| name.starts_with(left_out))
}

/// What was read; what was not becomes a gap.
fn kept<T>(read: Result<T, Gap>, gaps: &mut Vec<Gap>) -> Option<T> {
    read.map_err(|gap| gaps.push(gap)).ok()
}

/// Columns of a table; `shows` is what is made of a table that must be there.
fn columns(
    directory: &Path,
    file: &'static str,
    shows: Option<&'static str>,
    (is_wanted, sizes): (impl Fn(&str) -> bool, Option<Sizes>),
    gaps: &mut Vec<Gap>,
) -> Option<Table> {
    let Some((table, gap)) = kept(read_columns(directory, file, is_wanted, sizes), gaps)? else {
        gaps.extend(shows.map(|shows| Gap::Missing { file, shows }));
        return None;
    };
    gaps.extend(gap);
    Some(table)
}

/// The rows of an envelope; of very many those with the largest loads.
fn worst(
    file: &'static str,
    read: Result<Option<Envelope>, Gap>,
    gaps: &mut Vec<Gap>,
) -> Vec<Worst> {
    let Some((mut rows, gap)) = kept(read, gaps).flatten() else { return Vec::new() };
    gaps.extend(gap);
    if rows.len() > MOST_WORST {
        loads::sort_by_load(&mut rows);
        rows.truncate(MOST_WORST);
        gaps.push(Gap::TooManyLoads { file, most: MOST_WORST });
    }
    rows
}

/// A file in JSON, with its lists cut to what a page shows; nothing if it is not there.
fn json(directory: &Path, file: &'static str, gaps: &mut Vec<Gap>) -> Option<Value> {
    let path = directory.join(file);
    if !path.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST_JSON).read_to_end(&mut bytes));
    kept(read.map_err(|source| Gap::Unreadable { file, source }), gaps)?;
    let parsed = serde_json::from_slice::<Value>(&bytes);
    let object = parsed.map_err(|error| error.to_string()).and_then(|keys| {
        if keys.is_object() { Ok(keys) } else { Err("it has no keys".to_owned()) }
    });
    let mut keys = kept(object.map_err(|found| Gap::Json { file, found }), gaps)?;
    for key in ["selections", "integrations", "events", "peaks"] {
        if let Some(list) = keys.get_mut(key).and_then(Value::as_array_mut) {
            list.truncate(MOST_ENTRIES);
        }
    }
    Some(keys)
}

fn other_version(summary: &Value) -> Option<Gap> {
    let expected = env!("CARGO_PKG_VERSION");
    let found = summary.get("version").and_then(Value::as_str).unwrap_or("unknown");
    (found != expected).then(|| Gap::Version { found: found.to_owned(), expected })
}

/// The name of the scene, else that of the directory.
fn label(directory: &Path, summary: Option<&Value>) -> String {
    let scene =
        summary.and_then(|keys| keys["scene"].as_str()).filter(|name| !name.trim().is_empty());
    scene.map_or_else(|| directory.display().to_string(), str::to_owned)
}

/// The text of the scene.
fn text(directory: &Path) -> Option<String> {
    let bytes = fs::read(directory.join(SCENE_FILE)).ok()?;
    let is_cut = bytes.len() > LONGEST_SCENE;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(LONGEST_SCENE)]).into_owned();
    Some(if is_cut { text + "\n# The rest is in scene.toml.\n" } else { text })
}

/// Where unfinished results of a run into `directory` are.
fn partial(directory: &Path) -> Option<PathBuf> {
    let name = directory.file_name()?.to_str()?;
    Some(directory.with_file_name(format!("{name}.partial")))
}
