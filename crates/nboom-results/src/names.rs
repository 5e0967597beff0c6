//! Names of the files of a run.

/// One table of all files, of which constants, [`PARQUET_FILES`] and [`FILES`] are made. Tables have no ending in it.
macro_rules! files {
    (
        first { $($(#[$about_first:meta])* $first:ident = $first_name:literal;)* }
        tables { $($(#[$about:meta])* $table:ident = $stem:literal;)* }
        others { $($(#[$about_other:meta])* $other:ident = $other_name:literal;)* }
        last { $($(#[$about_last:meta])* $last:ident = $last_name:literal;)* }
    ) => {
        $($(#[$about_first])* pub const $first: &str = $first_name;)*
        $($(#[$about])* pub const $table: &str = concat!($stem, ".csv");)*
        $($(#[$about_other])* pub const $other: &str = $other_name;)*
        $($(#[$about_last])* pub const $last: &str = $last_name;)*

        /// Each table with the name of what is made from it for Parquet.
        pub const PARQUET_FILES: [(&str, &str); [$($stem),*].len()] =
            [$(($table, concat!($stem, ".parquet"))),*];

        /// All names that a run may write; files of other names in its directory are not its own.
        pub const FILES:
            [&str; [$($first,)* $($table,)* $($other,)* $($stem,)* $($last,)*].len()] = [
            $($first,)*
            $($table,)*
            $($other,)*
            $(concat!($stem, ".parquet"),)*
            $($last,)*
        ];
    };
}

files! {
    first {
        /// Name of the scene as it was read, within a run's directory.
        SCENE_FILE = "scene.toml";
        /// Name of the record by which a run is repeated.
        RUN_FILE = "run.json";
    }
    tables {
        /// Name of the table of states within a run's directory.
        STATES_FILE = "states";
        /// Name of the table of the motion on both sides of each instant with events within a run's directory.
        INSTANTS_FILE = "instants";
        /// Name of the table of what became of energy and momentum within a run's directory.
        LEDGER_FILE = "ledger";
        /// Name of the table of the motion that a scene asks for within a run's directory.
        OUTPUT_FILE = "output";
        /// Name of the table of events within a run's directory.
        EVENTS_FILE = "events";
        /// Name of the table of stresses within a run's directory.
        STRESS_FILE = "stress";
        /// Name of the table of hinge loads within a run's directory.
        HINGE_LOADS_FILE = "hinge_loads";
        /// Name of the table of impulses that hinges transmit at lock-ups and impacts within a run's directory.
        LATCH_IMPULSES_FILE = "latch_impulses";
        /// Name of the table of each hinge's largest loads within a run's directory.
        HINGE_ENVELOPE_FILE = "hinge_load_envelope";
        /// Name of the table of each station's worst stress within a run's directory.
        ENVELOPE_FILE = "stress_envelope";
    }
    others {
        /// Name of the printout within a run's directory.
        LISTING_FILE = "listing.txt";
        /// Name of the file that says what the columns of all tables are, with their units.
        PACKAGE_FILE = "datapackage.json";
        /// Name of the certificate, which says how many digits of the run can be trusted.
        TRUST_FILE = "certificate.json";
        /// Name of the page that shows a run; it is made from the other files, at any time.
        REPORT_FILE = "report.html";
    }
    last {
        /// Name of all tables in one file of HDF5, which is made from them.
        HDF5_FILE = "run.h5";
        /// Name of the summary within a run's directory.
        SUMMARY_FILE = "summary.json";
    }
}

/// What tells [`REPORT_FILE`] from other pages, among its first bytes.
pub const REPORT_MARK: &str = "<meta name=\"generator\" content=\"nboom\">";

/// Files that say something about the others; after a power failure they may be empty.
pub(crate) const COMPANIONS: [&str; 2] = [RUN_FILE, PACKAGE_FILE];
