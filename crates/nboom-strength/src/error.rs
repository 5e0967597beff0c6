use nboom_model::HingeLabel;
use nboom_sections::SectionError;

/// Why stresses cannot be computed. Messages leave out the time, which the error of the run that they end
/// says.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrengthError {
    /// A section is wrong.
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
    /// The loads contradict the motion: the moment about a free hinge's axis is not that of its
    /// spring and dashpot.
    #[error(
        "the load about the axis of hinge {hinge} differs from its torque by \
         {residual:e} of what it is made of, at most {most:e} expected"
    )]
    Unbalanced {
        /// When.
        time: f64,
        /// Where.
        hinge: HingeLabel,
        /// The difference.
        residual: f64,
        /// The difference that rounding explains.
        most: f64,
    },
    /// A load, or a stress under it, is infinite or not a number.
    #[error("the loads or their stresses are no finite numbers")]
    NotFinite {
        /// When.
        time: f64,
    },
}

#[cfg(test)]
mod tests {
    use nboom_sim::SimError;

    use super::*;

    #[test]
    fn the_time_is_said_once() {
        let source = std::io::Error::other(StrengthError::NotFinite { time: 0.025 });
        let told = SimError::Record { time: 0.025, source }.to_string();
        assert_eq!(told, "at time 0.025: the loads or their stresses are no finite numbers");
    }
}
