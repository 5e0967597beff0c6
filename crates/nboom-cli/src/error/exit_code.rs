#[cfg(feature = "generator")]
use std::io;

#[cfg(feature = "generator")]
use nboom_package::PackageError;
use nboom_sim::SimError;
use nboom_verify::VerifyError;

use super::CliError;

/// Whether a path leads through a file, or to a directory where a file is expected or the reverse.
#[cfg(feature = "generator")]
fn is_wrong_path(kind: io::ErrorKind) -> bool {
    use io::ErrorKind::{AlreadyExists, IsADirectory, NotADirectory};
    matches!(kind, AlreadyExists | IsADirectory | NotADirectory)
}

impl CliError {
    /// 1 when a comparison failed, 2 when the input or the command line is wrong, 3 when computing or writing failed or was interrupted.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Deviation { .. } => 1,
            Self::Input(_) | Self::EndTime(_) | Self::Idle { .. } => 2,
            Self::Start(_) | Self::OutputIsInput { .. } => 2,
            Self::NoFormat | Self::VainFormat { .. } => 2,
            Self::Instructions { .. } => 2,
            Self::NoScene { .. } | Self::NoDeck(_) | Self::WouldReplace { .. } => 2,
            Self::NoPicture { .. } | Self::NoSvg { .. } => 2,
            #[cfg(feature = "generator")]
            Self::Exists { .. } | Self::NoToml { .. } | Self::NoWork => 2,
            #[cfg(feature = "generator")]
            Self::PackageOfLine { .. } => 2,
            Self::Results(error) if error.is_refusal() => 2,
            Self::Case(_) => 2,
            Self::Sweep(error) => error.exit_code(),
            Self::OutputTimes(_) | Self::Report(_) | Self::NoPage { .. } => 2,
            Self::OtherPage { .. } | Self::OtherUnits { .. } | Self::AmongResults { .. } => 2,
            Self::PlotsOfSweep { .. } | Self::SweepBesideOthers { .. } => 2,
            Self::Tables(error) if error.is_of_input() => 2,
            Self::Sections(_) | Self::Stresses(_) => 2,
            Self::Times { .. } | Self::Column { .. } | Self::NoReaction => 2,
            Self::Record(_) => 2,
            Self::Simulation {
                error: SimError::NoRoutine { .. } | SimError::NotCovered { .. },
                ..
            } => 2,
            Self::Verify(VerifyError::NotFinite { .. }) => 2,
            Self::Simulation { .. } | Self::Verify(_) => 3,
            Self::Certificate { .. } | Self::Signals(_) | Self::BrokenOff { .. } => 3,
            Self::Results(_) | Self::Tables(_) | Self::Stdout(_) => 3,
            #[cfg(feature = "generator")]
            Self::Package(PackageError::Outdated { .. } | PackageError::Deviation { .. }) => 1,
            #[cfg(feature = "generator")]
            Self::Package(
                PackageError::Codegen(_) | PackageError::NotOurs { .. } | PackageError::NoFolder,
            ) => 2,
            #[cfg(feature = "generator")]
            Self::Package(
                PackageError::Read { source, .. } | PackageError::Write { source, .. },
            ) if is_wrong_path(source.kind()) => 2,
            #[cfg(feature = "generator")]
            Self::Package(_) => 3,
        }
    }
}
