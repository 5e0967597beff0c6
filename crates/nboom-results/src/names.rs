//! Names of the files of a run.

/// Name of the table of states within a run's directory.
pub const STATES_FILE: &str = "states.csv";
/// Name of the table of the motion that a scene asks for within a run's directory.
pub const OUTPUT_FILE: &str = "output.csv";
/// Name of the table of events within a run's directory.
pub const EVENTS_FILE: &str = "events.csv";
/// Name of the scene as it was read, within a run's directory.
pub const SCENE_FILE: &str = "scene.toml";
/// Name of the table of the motion on both sides of each instant with events within a run's directory.
pub const INSTANTS_FILE: &str = "instants.csv";
/// Name of the table of what became of energy and momentum within a run's directory.
pub const LEDGER_FILE: &str = "ledger.csv";
/// Name of the summary within a run's directory.
pub const SUMMARY_FILE: &str = "summary.json";
/// Name of the table of stresses within a run's directory.
pub const STRESS_FILE: &str = "stress.csv";
/// Name of the table of hinge loads within a run's directory.
pub const HINGE_LOADS_FILE: &str = "hinge_loads.csv";
/// Name of the table of impulses that hinges transmit at lock-ups within a run's directory.
pub const LATCH_IMPULSES_FILE: &str = "latch_impulses.csv";
/// Name of the table of each hinge's largest loads within a run's directory.
pub const HINGE_ENVELOPE_FILE: &str = "hinge_load_envelope.csv";
/// Name of the table of each station's worst stress within a run's directory.
pub const ENVELOPE_FILE: &str = "stress_envelope.csv";
/// Name of the printout within a run's directory.
pub const LISTING_FILE: &str = "listing.txt";
/// Name of the file that says what the columns of all tables are, with their units.
pub const PACKAGE_FILE: &str = "datapackage.json";
/// Name of the record by which a run is repeated.
pub const RUN_FILE: &str = "run.json";
/// Name of the certificate, which says how many digits of the run can be trusted.
pub const TRUST_FILE: &str = "certificate.json";

/// Name of the page that shows a run; it is made from the other files, at any time.
pub const REPORT_FILE: &str = "report.html";
/// What tells it from other pages, among its first bytes.
pub const REPORT_MARK: &str = "<meta name=\"generator\" content=\"nboom\">";

/// Name of all tables in one file of HDF5, which is made from them.
pub const HDF5_FILE: &str = "run.h5";

/// Each table with the name of what is made from it for Parquet.
pub const PARQUET_FILES: [(&str, &str); 10] = [
    (STATES_FILE, "states.parquet"),
    (INSTANTS_FILE, "instants.parquet"),
    (LEDGER_FILE, "ledger.parquet"),
    (OUTPUT_FILE, "output.parquet"),
    (EVENTS_FILE, "events.parquet"),
    (STRESS_FILE, "stress.parquet"),
    (HINGE_LOADS_FILE, "hinge_loads.parquet"),
    (LATCH_IMPULSES_FILE, "latch_impulses.parquet"),
    (HINGE_ENVELOPE_FILE, "hinge_load_envelope.parquet"),
    (ENVELOPE_FILE, "stress_envelope.parquet"),
];

/// Files that say something about the others; after a power failure they may be empty.
pub(crate) const COMPANIONS: [&str; 2] = [RUN_FILE, PACKAGE_FILE];

/// All names that a run may write; files of other names in its directory are not its own.
pub const FILES: [&str; 28] = [
    SCENE_FILE,
    RUN_FILE,
    STATES_FILE,
    INSTANTS_FILE,
    LEDGER_FILE,
    OUTPUT_FILE,
    EVENTS_FILE,
    STRESS_FILE,
    HINGE_LOADS_FILE,
    LATCH_IMPULSES_FILE,
    HINGE_ENVELOPE_FILE,
    ENVELOPE_FILE,
    LISTING_FILE,
    PACKAGE_FILE,
    TRUST_FILE,
    REPORT_FILE,
    PARQUET_FILES[0].1,
    PARQUET_FILES[1].1,
    PARQUET_FILES[2].1,
    PARQUET_FILES[3].1,
    PARQUET_FILES[4].1,
    PARQUET_FILES[5].1,
    PARQUET_FILES[6].1,
    PARQUET_FILES[7].1,
    PARQUET_FILES[8].1,
    PARQUET_FILES[9].1,
    HDF5_FILE,
    SUMMARY_FILE,
];
