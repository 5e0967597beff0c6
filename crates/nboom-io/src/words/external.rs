use nboom_model::{Course, External, ExternalAxes, ExternalKind};
use nboom_scalar::Vec3;

/// A force or a torque from outside, in words; of what it is given for, the main body or a hinged one.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct ExternalWords(External);

/// A force at `point` of a body (from its origin, body axes), always on until it has times.
pub fn thruster(force: impl Into<Vec3<f64>>, point: impl Into<Vec3<f64>>) -> ExternalWords {
    ExternalWords(External {
        body: None,
        kind: ExternalKind::Force,
        amount: force.into(),
        axes: ExternalAxes::Body,
        point: point.into(),
        course: Course::ALWAYS,
    })
}

/// A torque on a body, always on until it has times.
pub fn torque(torque: impl Into<Vec3<f64>>) -> ExternalWords {
    let ExternalWords(as_force) = thruster(torque, Vec3::zero());
    ExternalWords(External { kind: ExternalKind::Torque, ..as_force })
}

impl ExternalWords {
    /// Where it acts, from the body's origin, body axes.
    pub fn point(mut self, point: impl Into<Vec3<f64>>) -> Self {
        self.0.point = point.into();
        self
    }

    /// It keeps its direction along inertial axes, and not along those of the body.
    pub fn along_inertial_axes(mut self) -> Self {
        self.0.axes = ExternalAxes::Inertial;
        self
    }

    /// Time at which it starts; by default it acts from the first.
    pub fn from(mut self, from: f64) -> Self {
        let (_, off) = self.pulse();
        self.0.course = Course::Pulse { on: from, off };
        self
    }

    /// Time at which it stops; by default it never does.
    pub fn until(mut self, until: f64) -> Self {
        let (on, _) = self.pulse();
        self.0.course = Course::Pulse { on, off: until };
        self
    }

    fn pulse(&self) -> (f64, f64) {
        match self.0.course {
            Course::Pulse { on, off } => (on, off),
            Course::Table(_) => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// Its share at ascending times, as pairs of time and share; straight between them, and nothing before the first
    /// and from the last on.
    pub fn over_time(mut self, points: Vec<[f64; 2]>) -> Self {
        self.0.course = Course::Table(points);
        self
    }
}

impl From<ExternalWords> for External {
    fn from(ExternalWords(external): ExternalWords) -> Self {
        external
    }
}

/// The name of the tables of a kind.
pub(crate) fn table(kind: ExternalKind) -> &'static str {
    match kind {
        ExternalKind::Force => "thruster",
        ExternalKind::Torque => "torque",
    }
}
