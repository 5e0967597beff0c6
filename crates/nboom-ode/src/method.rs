use std::fmt;

use crate::{
    Stepper, Tolerance, adams, automatic, gauss, gauss_lanes, radau, rkam, tableau, taylor,
};

/// What a method tells about itself, beside its steps.
pub(crate) struct Description {
    /// The name in commands and files.
    pub name: &'static str,
    /// What it is and is for, in one line.
    pub about: &'static str,
    /// Order of the error at the end of a fixed time, under a tolerance and while the motion is not
    /// stiff.
    pub order: fn(Tolerance) -> u32,
    /// Order of dense output, under a tolerance.
    pub dense_order: fn(Tolerance) -> u32,
    /// Whether invariants stay where they are for as long as a run goes on: quadratic ones to
    /// rounding, energies without a trend.
    pub keeps_invariants: bool,
    /// A stepper without a problem.
    pub stepper: fn(Tolerance) -> Box<dyn Stepper>,
}

/// Makes [`Method`] of a table with one row for each method: its name in the code and its description.
macro_rules! methods {
    ($($(#[$doc:meta])* $method:ident = $description:expr,)*) => {
        /// A method of integration.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Method {
            $($(#[$doc])* $method,)*
        }

        impl Method {
            /// All: the one that chooses, explicit ones from low to high order, the implicit ones.
            pub const ALL: [Self; [$(Self::$method),*].len()] = [$(Self::$method),*];

            fn description(self) -> &'static Description {
                match self {
                    $(Self::$method => &$description,)*
                }
            }
        }
    };
}

methods! {
    /// The method that changes among others by tolerance, motion and code.
    Auto = automatic::DESCRIPTION,
    /// The predictor and corrector of the 1970 program, of order 4.
    Rkam = rkam::DESCRIPTION,
    /// Dormand and Prince's explicit Runge-Kutta method of order 5.
    Dopri5 = tableau::dopri5::DESCRIPTION,
    /// Dormand and Prince's explicit Runge-Kutta method of order 8.
    Dop853 = tableau::dop853::DESCRIPTION,
    /// Adams' predictor and corrector of variable order.
    Adams = adams::DESCRIPTION,
    /// The Taylor series method, of an order that follows from the tolerance.
    Taylor = taylor::DESCRIPTION,
    /// Radau's implicit Runge-Kutta method of order 5.
    Radau5 = radau::order_5::DESCRIPTION,
    /// Radau's implicit Runge-Kutta method of order 9.
    Radau9 = radau::order_9::DESCRIPTION,
    /// Radau's implicit Runge-Kutta method of order 13.
    Radau13 = radau::order_13::DESCRIPTION,
    /// Gauss's implicit Runge-Kutta method of order 16 with constant steps.
    Gauss = gauss::DESCRIPTION,
    /// Gauss's implicit Runge-Kutta method of order 16 with stages side by side.
    GaussLanes = gauss_lanes::DESCRIPTION,
}

impl Method {
    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        self.description().name
    }

    /// The method with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// What it is and is for, in one line.
    pub fn about(self) -> &'static str {
        self.description().about
    }

    /// Order of the error at the end of a fixed time, under this tolerance and while the motion is
    /// not stiff.
    pub fn order(self, tolerance: Tolerance) -> u32 {
        (self.description().order)(tolerance)
    }

    /// Order of dense output, under this tolerance.
    pub fn dense_order(self, tolerance: Tolerance) -> u32 {
        (self.description().dense_order)(tolerance)
    }

    /// Whether it takes explicit Runge-Kutta steps, which may be taken in lanes of registers.
    pub fn takes_explicit_steps(self) -> bool {
        // Whatever the tolerance.
        let tolerance = Tolerance { relative: 1e-9, absolute: 1e-9 };
        self.stepper(tolerance).explicit().is_some()
    }

    /// Whether invariants stay where they are for as long as a run goes on: quadratic ones to
    /// rounding, energies without a trend.
    pub fn keeps_invariants(self) -> bool {
        self.description().keeps_invariants
    }

    /// A stepper without a problem.
    pub fn stepper(self, tolerance: Tolerance) -> Box<dyn Stepper> {
        (self.description().stepper)(tolerance)
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
