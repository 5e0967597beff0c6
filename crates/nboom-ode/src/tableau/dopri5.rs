//! Coefficients of the method of order 5(4) with dense output of order 4: Dormand and Prince,
//! J. Comput. Appl. Math. 6 (1980); dense output by Shampine, as in Hairer, Nørsett, Wanner,
//! Solving Ordinary Differential Equations I, 2nd ed., Section II.6.

use crate::method::Description;
use crate::{Method, RungeKutta};

use super::{Control, Row, Tableau};

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "dopri5",
    about: "explicit Runge-Kutta 5(4), for relative errors down to about 1e-5",
    order: |_| 5,
    dense_order: |_| 4,
    keeps_invariants: false,
    stepper: |tolerance| Box::new(RungeKutta::dopri5(tolerance)),
};

/// The method of Dormand and Prince of order 5 with an estimate of order 4.
pub(crate) const DOPRI5: Tableau = Tableau {
    method: Method::Dopri5,
    stages: 6,
    c: &C,
    a: &A,
    error: &[
        (0, 71.0 / 57600.0),
        (2, -71.0 / 16695.0),
        (3, 71.0 / 1920.0),
        (4, -17253.0 / 339_200.0),
        (5, 22.0 / 525.0),
        (6, -1.0 / 40.0),
    ],
    lower_error: &[],
    dense: &[&[
        (0, -12_715_105_075.0 / 11_282_082_432.0),
        (2, 87_487_479_700.0 / 32_700_410_799.0),
        (3, -10_690_763_975.0 / 1_880_347_072.0),
        (4, 701_980_252_875.0 / 199_316_789_632.0),
        (5, -1_453_857_185.0 / 822_651_844.0),
        (6, 69_997_945.0 / 29_380_423.0),
    ]],
    control: Control { exponent: 1.0 / 5.0, compensation: 0.75, shrink: 0.2, grow: 10.0 },
    stability_limit: 3.25,
};

const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

const A: [Row; 7] = [
    &[],
    &[(0, 0.2)],
    &[(0, 3.0 / 40.0), (1, 9.0 / 40.0)],
    &[(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)],
    &[(0, 19372.0 / 6561.0), (1, -25360.0 / 2187.0), (2, 64448.0 / 6561.0), (3, -212.0 / 729.0)],
    &[
        (0, 9017.0 / 3168.0),
        (1, -355.0 / 33.0),
        (2, 46732.0 / 5247.0),
        (3, 49.0 / 176.0),
        (4, -5103.0 / 18656.0),
    ],
    &[
        (0, 35.0 / 384.0),
        (2, 500.0 / 1113.0),
        (3, 125.0 / 192.0),
        (4, -2187.0 / 6784.0),
        (5, 11.0 / 84.0),
    ],
];
