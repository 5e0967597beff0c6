//! Result files of a run.
