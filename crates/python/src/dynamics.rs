//! Equations of motion at states in bulk.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use nboom_scalar::{Quaternion, Vec3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{self, Rows, zeros};
use crate::evaluator::{EightStates, Evaluator, Found, State};
use crate::patience::Patience;
use crate::routine::LANES;

/// Unknowns of all states that are taken between two looks for Ctrl-C.
const PIECE: usize = 1024;

/// How far the length of an attitude may be from 1.
const UNIT: f64 = 1e-6;

/// Accelerations, and where a formulation forms them mass matrix and forcing, of a scene with the same hinges held.
#[pyclass(frozen, module = "nboom")]
pub(crate) struct Dynamics {
    evaluator: Mutex<Evaluator>,
    free: usize,
    /// Labels of the free hinges.
    #[pyo3(get)]
    hinges: Vec<String>,
    /// `generated` or `generic`.
    #[pyo3(get)]
    path: &'static str,
    /// The form of the equations of motion.
    #[pyo3(get)]
    formulation: &'static str,
    /// Why this code.
    #[pyo3(get)]
    reason: String,
}

/// The arguments of a call.
struct Arguments<'py> {
    omega: Rows<'py>,
    beta: Rows<'py>,
    tau: Rows<'py>,
    torque: Option<Rows<'py>>,
    attitude: Option<Rows<'py>>,
    time: f64,
    count: Option<usize>,
}

/// The arguments as lists of rows.
struct Lists<'a> {
    omega: Cow<'a, [f64]>,
    beta: Cow<'a, [f64]>,
    tau: Cow<'a, [f64]>,
    torque: Option<Cow<'a, [f64]>>,
    attitude: Option<Cow<'a, [f64]>>,
    free: usize,
    time: f64,
    /// Whether the arguments have a row for each of several states.
    are_rows: bool,
}

impl Dynamics {
    pub fn of(evaluator: Evaluator, hinges: Vec<String>) -> Self {
        let (path, formulation, reason) = evaluator.about();
        let free = hinges.len();
        Self { evaluator: Mutex::new(evaluator), free, hinges, path, formulation, reason }
    }

    fn arguments<'py>(
        &self,
        omega: &Bound<'py, PyAny>,
        beta: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
        torque: Option<&Bound<'py, PyAny>>,
        attitude: Option<&Bound<'py, PyAny>>,
        time: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Arguments<'py>> {
        let hinges = |name, of| Rows::read(name, of, self.free, "free hinge");
        let omega = Rows::read("omega", omega, 3, "axis")?;
        let (beta, tau) = (hinges("beta", beta)?, hinges("tau", tau)?);
        let torque = torque.map(|torque| hinges("torque", torque)).transpose()?;
        let attitude = attitude
            .map(|attitude| {
                Rows::read("attitude", attitude, 4, "part of a quaternion, scalar first")
            })
            .transpose()?;
        let time = time.map_or(Ok(0.0), |time| arrays::finite("time", time))?;
        let all: Vec<&Rows<'_>> =
            [&omega, &beta, &tau].into_iter().chain(&torque).chain(&attitude).collect();
        let count = arrays::count(&all)?;
        Ok(Arguments { omega, beta, tau, torque, attitude, time, count })
    }

    /// Hands all states to an evaluator, piece by piece: more than one piece to one of their own, without Python's lock.
    fn evaluate(
        &self,
        py: Python<'_>,
        states: usize,
        mut work: impl FnMut(&mut Evaluator, Range<usize>) -> PyResult<()> + Send,
    ) -> PyResult<()> {
        let piece = (PIECE / (6 + self.free)).next_multiple_of(LANES).max(LANES);
        if states <= piece {
            // Whoever holds it does not wait for Python's lock.
            let mut evaluator = self.evaluator.lock().unwrap_or_else(PoisonError::into_inner);
            return work(&mut evaluator, 0..states);
        }
        let mut own = self.evaluator.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let mut patience = Patience::new();
        py.detach(|| {
            (0..states).step_by(piece).try_for_each(|first| {
                work(&mut own, first..states.min(first + piece))?;
                patience.look()
            })
        })
    }
}

#[pymethods]
impl Dynamics {
    /// Accelerations of the main body and of the free hinges.
    ///
    /// All forces of the scene act as in a run that is in the state: thrusters as they burn at `time`, springs and
    /// tables as they are at `beta`.
    ///
    /// Parameters
    /// ----------
    /// omega : array (3,) or (N, 3)
    ///     Angular rate of the main body, main-body axes [rad/T].
    /// beta : array (n,) or (N, n)
    ///     Angles of the n free hinges, in the order of `hinges` [rad]; of a slide its travel [L].
    /// tau : array (n,) or (N, n)
    ///     Their rates [rad/T, L/T].
    /// torque : array (n,) or (N, n), optional
    ///     Torques about the hinges, of slides forces, beside those of the scene.
    /// attitude : array (4,) or (N, 4), optional
    ///     Unit quaternion, scalar first, that turns main-body components into inertial ones; needed only
    ///     for forces that depend on it. By default that in which the scene holds its main body, else 1.
    /// time : float, optional
    ///     For what depends on it: thrusters and torques, a driven main body, rotors. By default 0.
    ///
    /// Returns
    /// -------
    /// omega_dot : array (3,) or (N, 3)
    ///     Angular acceleration, main-body axes [rad/T^2].
    /// origin : array (3,) or (N, 3)
    ///     Inertial acceleration of the main body's point O without gravity, main-body axes [L/T^2].
    /// tau_dot : array (n,) or (N, n)
    ///     Accelerations of the hinges [rad/T^2, L/T^2].
    ///
    /// Raises
    /// ------
    /// ValueError, TypeError
    ///     Of arguments of other shapes, or without finite real numbers, and of an attitude at which gravity would
    ///     act on a main body from elsewhere than in the attitude in which the scene holds it.
    #[pyo3(
        signature = (omega, beta, tau, torque=None, attitude=None, time=None),
        text_signature = "($self, omega, beta, tau, torque=None, attitude=None, time=0.0)"
    )]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        omega: &Bound<'py, PyAny>,
        beta: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
        torque: Option<&Bound<'py, PyAny>>,
        attitude: Option<&Bound<'py, PyAny>>,
        time: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let arguments = self.arguments(omega, beta, tau, torque, attitude, time)?;
        let (count, free) = (arguments.count, self.free);
        let (states, lists) = (count.unwrap_or(1), arguments.lists(free)?);
        let [mut omega_dot, mut origin] = [zeros(&[states, 3])?, zeros(&[states, 3])?];
        let mut tau_dot = zeros(&[states, free])?;
        let mut found =
            Found { omega_dot: &mut omega_dot, origin: &mut origin, tau_dot: &mut tau_dot };
        self.evaluate(py, states, |evaluator, piece| {
            lists.require_finite(piece.clone())?;
            lists.require_attitudes(evaluator, piece.clone())?;
            lists.accelerations(evaluator, piece, &mut found);
            Ok(())
        })?;
        Ok((
            arrays::rows(py, omega_dot, count, 3)?,
            arrays::rows(py, origin, count, 3)?,
            arrays::rows(py, tau_dot, count, free)?,
        ))
    }

    /// Matrix and right side of the formulation's system for the accelerations.
    ///
    /// The unknowns are (v', omega', sigma') of `report`, (v', omega', tau') of `relative`, and (a_O, omega', tau')
    /// of all others, where the matrix is that of kinetic energy; O is at the inertial origin, gravity left out. Where
    /// the main body is held, the first six of the right side have what holds it, and with that a_O, as `origin`.
    /// Arguments are those of `accelerations`.
    ///
    /// Returns
    /// -------
    /// matrix : array (6 + n, 6 + n) or (N, 6 + n, 6 + n)
    /// forcing : array (6 + n,) or (N, 6 + n)
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the formulation never forms them, as `articulated` in library code, or not for a main body that is held.
    #[pyo3(
        signature = (omega, beta, tau, torque=None, attitude=None, time=None),
        text_signature = "($self, omega, beta, tau, torque=None, attitude=None, time=0.0)"
    )]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn equations<'py>(
        &self,
        py: Python<'py>,
        omega: &Bound<'py, PyAny>,
        beta: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
        torque: Option<&Bound<'py, PyAny>>,
        attitude: Option<&Bound<'py, PyAny>>,
        time: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let arguments = self.arguments(omega, beta, tau, torque, attitude, time)?;
        let (count, size) = (arguments.count, 6 + self.free);
        let (states, lists) = (count.unwrap_or(1), arguments.lists(self.free)?);
        let mut matrices = zeros(&[states, size, size])?;
        let mut forcing = zeros(&[states, size])?;
        self.evaluate(py, states, |evaluator, piece| {
            lists.require_finite(piece.clone())?;
            lists.require_attitudes(evaluator, piece.clone())?;
            for i in piece {
                let matrix = &mut matrices[size * size * i..size * size * (i + 1)];
                let right = &mut forcing[size * i..size * (i + 1)];
                lists.set_outside(evaluator, i);
                evaluator.equations(&lists.state(i), matrix, right).map_err(|why| {
                    PyValueError::new_err(format!("formulation {}: {why}", self.formulation))
                })?;
            }
            Ok(())
        })?;
        Ok((arrays::matrices(py, matrices, count, size)?, arrays::rows(py, forcing, count, size)?))
    }

    fn __repr__(&self) -> String {
        let Self { path, formulation, hinges, .. } = self;
        format!("<nboom.Dynamics: {path} {formulation}, {} free hinges>", hinges.len())
    }
}

impl Arguments<'_> {
    fn lists(&self, free: usize) -> PyResult<Lists<'_>> {
        Ok(Lists {
            omega: self.omega.list()?,
            beta: self.beta.list()?,
            tau: self.tau.list()?,
            torque: self.torque.as_ref().map(Rows::list).transpose()?,
            attitude: self.attitude.as_ref().map(Rows::list).transpose()?,
            free,
            time: self.time,
            are_rows: self.count.is_some(),
        })
    }
}

impl Lists<'_> {
    /// # Errors
    /// `ValueError` where a number of these states is not finite.
    fn require_finite(&self, states: Range<usize>) -> PyResult<()> {
        let lists = [
            ("omega", Some(&self.omega), 3),
            ("beta", Some(&self.beta), self.free),
            ("tau", Some(&self.tau), self.free),
            ("torque", self.torque.as_ref(), self.free),
            ("attitude", self.attitude.as_ref(), 4),
        ];
        for (name, list, width) in lists {
            let numbers =
                list.map_or(&[][..], |list| &list[width * states.start..width * states.end]);
            if let Some(at) = numbers.iter().position(|number| !number.is_finite()) {
                let (row, column) = (states.start + at / width, at % width);
                let place =
                    if self.are_rows { format!("{row}, {column}") } else { column.to_string() };
                let found = numbers[at];
                return Err(PyValueError::new_err(format!(
                    "{name}[{place}]: {found} found, a finite number expected"
                )));
            }
        }
        Ok(())
    }

    /// # Errors
    /// `ValueError` where an attitude of these states is no unit quaternion, or not the one in which the main body is
    /// held.
    fn require_attitudes(&self, evaluator: &Evaluator, states: Range<usize>) -> PyResult<()> {
        for i in states {
            let Some(attitude) = self.attitude(i) else { return Ok(()) };
            let norm = attitude.norm_squared().sqrt();
            let wrong = if (norm - 1.0).abs() > UNIT {
                format!("a quaternion of length {norm} found, 1 expected")
            } else if !evaluator.holds_at(&attitude) {
                "found one with another direction of gravity than that in which the main body is held, \
                 expected that of the scene"
                    .to_owned()
            } else {
                continue;
            };
            let place = if self.are_rows { format!("[{i}]") } else { String::new() };
            return Err(PyValueError::new_err(format!("attitude{place}: {wrong}")));
        }
        Ok(())
    }

    /// That of state number `i`, if it is said.
    fn attitude(&self, i: usize) -> Option<Quaternion<f64>> {
        let q = &self.attitude.as_ref()?[4 * i..4 * i + 4];
        Some(Quaternion { scalar: q[0], vector: Vec3::new(q[1], q[2], q[3]) })
    }

    fn state(&self, i: usize) -> State<'_> {
        let hinges = i * self.free..(i + 1) * self.free;
        let omega = &self.omega[3 * i..3 * i + 3];
        State {
            omega: Vec3::new(omega[0], omega[1], omega[2]),
            beta: &self.beta[hinges.clone()],
            tau: &self.tau[hinges.clone()],
            added: self.torque.as_ref().map(|torque| &torque[hinges]),
        }
    }

    fn eight_states(&self, first: usize) -> EightStates<'_> {
        let hinges = first * self.free..(first + LANES) * self.free;
        EightStates {
            omega: &self.omega[3 * first..3 * (first + LANES)],
            beta: &self.beta[hinges.clone()],
            tau: &self.tau[hinges.clone()],
            added: self.torque.as_ref().map(|torque| &torque[hinges]),
        }
    }

    /// Says at which attitude state number `i` is, and when.
    fn set_outside(&self, evaluator: &mut Evaluator, i: usize) {
        evaluator.set_outside(self.attitude(i), self.time);
    }

    /// Takes some states, eight at once as far as there is code for it.
    fn accelerations(
        &self,
        evaluator: &mut Evaluator,
        states: Range<usize>,
        found: &mut Found<'_>,
    ) {
        let mut i = states.start;
        if self.attitude.is_none() {
            self.set_outside(evaluator, i);
            while i + LANES <= states.end {
                if !evaluator.accelerations_of_eight(&self.eight_states(i), found, i) {
                    break;
                }
                i += LANES;
            }
        }
        for i in i..states.end {
            if self.attitude.is_some() {
                self.set_outside(evaluator, i);
            }
            evaluator.accelerations(&self.state(i), found, i);
        }
    }
}
