use crate::{GaussLanes, Method, RungeKutta, Stepper, Tolerance, Window};

/// A method for motions that are not stiff.
#[derive(Debug)]
pub(super) enum Smooth {
    Explicit(Box<RungeKutta>),
    Lanes(Box<GaussLanes>),
}

/// Share of the stability limit beyond which a step counts as bounded by it: the tighter the
/// tolerance, the further below the limit steps settle. Oscillations that accuracy bounds stay
/// below a third of it.
const NEAR: f64 = 0.7;

/// A step of [`GaussLanes`] times the magnitude of a damped motion's eigenvalue above which its
/// iteration costs more than an explicit method.
const LIMIT_OF_LANES: f64 = 2.0;

impl Smooth {
    pub fn new(method: Method, tolerance: Tolerance) -> Self {
        match method {
            Method::GaussLanes => Self::Lanes(Box::new(GaussLanes::new(tolerance))),
            Method::Dopri5 => Self::Explicit(Box::new(RungeKutta::dopri5(tolerance))),
            _ => Self::Explicit(Box::new(RungeKutta::dop853(tolerance))),
        }
    }

    /// Whether stability, or convergence, and not accuracy bounds the step just taken.
    pub fn is_held_back(&mut self) -> bool {
        match self {
            Self::Explicit(method) => method.stiffness() > NEAR * method.stability_limit(),
            Self::Lanes(method) => method.is_held_back(),
        }
    }

    /// A step times the magnitude of the largest eigenvalue, up to which these steps pay.
    pub fn limit(&self) -> f64 {
        match self {
            Self::Explicit(method) => method.stability_limit(),
            Self::Lanes(_) => LIMIT_OF_LANES,
        }
    }

    pub fn stepper(&self) -> &dyn Stepper {
        match self {
            Self::Explicit(method) => &**method,
            Self::Lanes(method) => &**method,
        }
    }

    pub fn stepper_mut(&mut self) -> &mut dyn Stepper {
        match self {
            Self::Explicit(method) => &mut **method,
            Self::Lanes(method) => &mut **method,
        }
    }

    pub fn window_mut(&mut self) -> &mut Window {
        match self {
            Self::Explicit(method) => method.window_mut(),
            Self::Lanes(method) => method.window_mut(),
        }
    }
}
