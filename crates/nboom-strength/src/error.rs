use nboom_model::HingeLabel;
use nboom_sections::SectionError;

/// Why stresses cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrengthError {
    /// A section is not one.
    #[error("segment {segment}, station {}: {source}", station + 1)]
    Section {
        /// The segment.
        segment: HingeLabel,
        /// The station, from 0.
        station: usize,
        /// What is wrong with it.
        source: SectionError,
    },
    /// A setting is out of range.
    #[error("{name} {found} found, a positive finite number expected")]
    Setting {
        /// Which one.
        name: &'static str,
        /// Its value.
        found: f64,
    },
    /// The loads contradict the motion: about a free hinge's axis there is another moment than that
    /// of its spring and dashpot.
    #[error(
        "at time {time} the load about the axis of hinge {hinge} differs from its torque by \
         {residual:e} of what it is made of, at most {most:e} expected"
    )]
    Unbalanced {
        /// When.
        time: f64,
        /// Where.
        hinge: HingeLabel,
        /// The difference.
        residual: f64,
        /// What rounding may make of it.
        most: f64,
    },
    /// A load is too large for a number, or none.
    #[error("at time {time} the loads are no finite numbers")]
    NotFinite {
        /// When.
        time: f64,
    },
}
