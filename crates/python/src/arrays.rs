//! Arrays of states that come from Python, and arrays that go there.

use std::borrow::Cow;

use numpy::{
    Element, IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayDescrMethods, PyArrayDyn,
    PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::PyTypeInfo;
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyFloat;

/// Rows of numbers: one, of an array of one dimension, or several.
pub(crate) struct Rows<'py> {
    name: &'static str,
    array: PyReadonlyArrayDyn<'py, f64>,
    /// How many rows an array of two dimensions has.
    pub count: Option<usize>,
}

impl<'py> Rows<'py> {
    /// An argument that has rows of `width` numbers, one for each `of` these.
    ///
    /// # Errors
    /// `TypeError` where it has no numbers, `ValueError` where it has another shape.
    pub fn read(
        name: &'static str,
        argument: &Bound<'py, PyAny>,
        width: usize,
        of: &str,
    ) -> PyResult<Self> {
        let array = match argument.cast::<PyArrayDyn<f64>>() {
            Ok(array) if is_plain(array) => array.clone(),
            _ => numbers(name, argument)?,
        };
        let shape = array.shape();
        let count = match *shape {
            [found] if found == width => None,
            [count, found] if found == width => Some(count),
            _ => {
                return Err(PyValueError::new_err(format!(
                    "{name}: an array of shape {} found, ({width},) or (N, {width}) expected, one number for each {of}",
                    told(shape)
                )));
            }
        };
        Ok(Self { name, array: array.readonly(), count })
    }

    /// All numbers, row after row.
    ///
    /// # Errors
    /// `MemoryError` where they have to be copied, and there is no memory for that.
    pub fn list(&self) -> PyResult<Cow<'_, [f64]>> {
        match self.array.as_slice() {
            Ok(numbers) if self.array.is_c_contiguous() => Ok(Cow::Borrowed(numbers)),
            _ => {
                let mut list = room(self.array.shape())?;
                list.extend(self.array.as_array());
                Ok(Cow::Owned(list))
            }
        }
    }
}

/// How many states these arguments have; `None` if all are of one state.
///
/// # Errors
/// `ValueError` where they have different numbers of rows.
pub(crate) fn count(rows: &[&Rows<'_>]) -> PyResult<Option<usize>> {
    let several = rows.iter().find(|rows| rows.count.is_some());
    let Some(several) = several else { return Ok(None) };
    // An array without columns says nothing.
    match rows.iter().find(|rows| rows.count != several.count) {
        None => Ok(several.count),
        Some(other) => Err(PyValueError::new_err(format!(
            "{}: {} found, rows of {} as in {} expected",
            other.name,
            other.count.map_or("one state".to_owned(), |count| format!("rows of {count} states")),
            several.count.unwrap_or_default(),
            several.name,
        ))),
    }
}

/// Whether an array is of numpy's own class, and its numbers stand where a processor takes numbers from: those of a
/// field of records may not.
fn is_plain(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    let size = size_of::<f64>() as isize;
    array.get_type().is(PyArrayDyn::<f64>::type_object(array.py()))
        && array.data().is_aligned()
        && array.strides().iter().all(|stride| stride % size == 0)
}

/// Anything that numpy makes an array of real numbers of, as an array of its own.
fn numbers<'py>(
    name: &'static str,
    argument: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numpy = argument.py().import("numpy")?;
    if argument.is_instance(&numpy.getattr("ma")?.getattr("MaskedArray")?)? {
        return Err(PyTypeError::new_err(format!(
            "{name}: a masked array found, an array of numpy without a mask expected"
        )));
    }
    let found = numpy.call_method1("asarray", (argument,))?;
    let array = found.cast::<PyUntypedArray>()?;
    let kind = array.dtype().kind();
    if !matches!(kind, b'f' | b'i' | b'u') {
        return Err(PyTypeError::new_err(format!(
            "{name}: {} found, real numbers expected",
            array.dtype().str()?
        )));
    }
    let array = found.call_method1("astype", ("float64",))?;
    Ok(array.cast_into::<PyArrayDyn<f64>>()?)
}

/// An argument that is a finite number.
///
/// # Errors
/// `TypeError` where it is no number, `ValueError` where it is not finite.
pub(crate) fn finite(name: &str, argument: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number = match argument.cast_exact::<PyFloat>() {
        Ok(number) => number.value(),
        Err(_) => {
            let checks = argument.py().import("nboom.checks")?;
            checks.call_method1("number", (name, argument))?.extract()?
        }
    };
    if number.is_finite() {
        return Ok(number);
    }
    Err(PyValueError::new_err(format!("{name}: {number} found, a finite number expected")))
}

fn told(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        several => {
            let sizes: Vec<String> = several.iter().map(usize::to_string).collect();
            format!("({})", sizes.join(", "))
        }
    }
}

/// An empty list that an array of this shape fits into.
///
/// # Errors
/// `MemoryError`, where Rust would end the process.
pub(crate) fn room<T>(shape: &[usize]) -> PyResult<Vec<T>> {
    let count = shape.iter().try_fold(1_usize, |count, &size| count.checked_mul(size));
    let mut list = Vec::new();
    match count.map(|count| list.try_reserve_exact(count)) {
        Some(Ok(())) => Ok(list),
        _ => Err(PyMemoryError::new_err(format!(
            "an array of shape {} found, one that fits into memory expected",
            told(shape)
        ))),
    }
}

/// The numbers of an array of this shape, all zero.
///
/// # Errors
/// As [`room`].
pub(crate) fn zeros(shape: &[usize]) -> PyResult<Vec<f64>> {
    let mut zeros = room(shape)?;
    zeros.resize(shape.iter().product(), 0.0);
    Ok(zeros)
}

/// An array for numbers of one state, or of each of several.
pub(crate) fn rows<'py>(
    py: Python<'py>,
    numbers: Vec<f64>,
    count: Option<usize>,
    width: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let flat = numbers.into_pyarray(py);
    match count {
        None => Ok(flat.into_any()),
        Some(count) => Ok(flat.reshape([count, width])?.into_any()),
    }
}

/// An array for a matrix of one state, or of each of several.
pub(crate) fn matrices<'py>(
    py: Python<'py>,
    numbers: Vec<f64>,
    count: Option<usize>,
    size: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let flat: Bound<'py, PyArray1<f64>> = numbers.into_pyarray(py);
    match count {
        None => {
            let matrix: Bound<'py, PyArray2<f64>> = flat.reshape([size, size])?;
            Ok(matrix.into_any())
        }
        Some(count) => {
            let matrices: Bound<'py, PyArray3<f64>> = flat.reshape([count, size, size])?;
            Ok(matrices.into_any())
        }
    }
}

/// An array of one dimension that takes the place of a list.
pub(crate) fn list<T: Element>(py: Python<'_>, numbers: Vec<T>) -> Bound<'_, PyAny> {
    numbers.into_pyarray(py).into_any()
}
