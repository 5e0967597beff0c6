use std::fmt;

use crate::{
    Automatic, Bound, Gauss, Radau, Rkam, RkamSettings, RungeKutta, Stepper, Taylor, Tolerance,
};

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// An explicit method for the tolerance, or the implicit one while the motion is stiff.
    Auto,
    /// The predictor and corrector of the 1970 program, of order 4.
    Rkam,
    /// Dormand and Prince's explicit Runge-Kutta method of order 5.
    Dopri5,
    /// Dormand and Prince's explicit Runge-Kutta method of order 8.
    Dop853,
    /// The Taylor series method, of an order that follows from the tolerance.
    Taylor,
    /// Radau's implicit Runge-Kutta method of order 5.
    Radau5,
    /// Gauss's implicit Runge-Kutta method of order 16 with constant steps.
    Gauss,
}

impl Method {
    /// All: the one that chooses, explicit ones from low to high order, the implicit ones.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Rkam,
        Self::Dopri5,
        Self::Dop853,
        Self::Taylor,
        Self::Radau5,
        Self::Gauss,
    ];

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Rkam => "rkam",
            Self::Dopri5 => "dopri5",
            Self::Dop853 => "dop853",
            Self::Taylor => "taylor",
            Self::Radau5 => "radau5",
            Self::Gauss => "gauss",
        }
    }

    /// The method with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// What it is for, in one line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Auto => "dopri5, dop853 or radau5, by tolerance and stiffness",
            Self::Rkam => "Adams-Moulton 4 as in 1970, to see what the original saw",
            Self::Dopri5 => "explicit Runge-Kutta 5(4), for relative errors down to about 1e-5",
            Self::Dop853 => "explicit Runge-Kutta 8(5,3), for smaller ones",
            Self::Taylor => "Taylor series of an order that fits the tolerance, down to rounding",
            Self::Radau5 => "implicit Runge-Kutta 5(3), for stiff hinges and latches",
            Self::Gauss => "implicit Runge-Kutta 16, symmetric, for long free spin",
        }
    }

    /// Order of the error at the end of a fixed time, under this tolerance and while the motion is
    /// not stiff.
    pub fn order(self, tolerance: Tolerance) -> u32 {
        match self {
            Self::Taylor => Taylor::order(tolerance) as u32,
            Self::Rkam => 4,
            Self::Auto => Automatic::explicit(tolerance).order(tolerance),
            Self::Dopri5 => 5,
            Self::Dop853 => 8,
            Self::Radau5 => 5,
            Self::Gauss => 16,
        }
    }

    /// Order of dense output, under this tolerance.
    pub fn dense_order(self, tolerance: Tolerance) -> u32 {
        match self {
            Self::Taylor => Taylor::order(tolerance) as u32,
            Self::Auto => Automatic::explicit(tolerance).dense_order(tolerance),
            Self::Rkam | Self::Dopri5 => 4,
            Self::Dop853 => 7,
            Self::Radau5 => 3,
            Self::Gauss => 8,
        }
    }

    /// Whether invariants stay where they are for as long as a run goes on: quadratic ones to
    /// rounding, energies without a trend.
    pub fn keeps_invariants(self) -> bool {
        self == Self::Gauss
    }

    /// A stepper without a problem.
    pub fn stepper(self, tolerance: Tolerance) -> Box<dyn Stepper> {
        match self {
            Self::Auto => Box::new(Automatic::new(tolerance)),
            Self::Rkam => Box::new(Rkam::new(RkamSettings::meeting(Bound::Within(tolerance)))),
            Self::Dopri5 => Box::new(RungeKutta::dopri5(tolerance)),
            Self::Dop853 => Box::new(RungeKutta::dop853(tolerance)),
            Self::Taylor => Box::new(Taylor::new(tolerance)),
            Self::Radau5 => Box::new(Radau::new(tolerance)),
            Self::Gauss => Box::new(Gauss::new(tolerance)),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
