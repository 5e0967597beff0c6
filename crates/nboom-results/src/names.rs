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

/// Files that say something about the others; after a power failure they may be empty.
pub(crate) const COMPANIONS: [&str; 2] = [RUN_FILE, PACKAGE_FILE];

/// All names that a run may write; files of other names in its directory are not its own.
pub const FILES: [&str; 17] = [
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
    SUMMARY_FILE,
];
