use nboom_expr::Graph;
use nboom_ode::Taylor;
use nboom_scalar::{DoubleDouble, Real};
use nboom_series::Series;

/// How accurately the motion is expanded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accuracy {
    /// The highest power of time.
    pub order: usize,
    /// Relative error allowed in a step.
    pub relative: f64,
    /// Absolute error allowed in a step, as a share of each variable's natural size.
    pub absolute: f64,
}

impl Accuracy {
    /// The accuracy of a reference: the errors of thousands of steps, magnified by the motion, stay
    /// below the digits of an `f64`. The order is that of fewest operations (see [`Taylor`]).
    pub const REFERENCE: Self = Self { order: 33, relative: 1e-28, absolute: 1e-31 };
}

/// The power series of a motion about one state.
#[derive(Clone, Debug)]
pub(crate) struct Expansion {
    accuracy: Accuracy,
    series: Series<DoubleDouble>,
    size: usize,
    /// Natural sizes of the variables that decide on the step.
    sizes: Vec<f64>,
    /// Those of all variables for each power in turn.
    coefficients: Vec<DoubleDouble>,
}

impl Expansion {
    /// Expands what `graph` computes with the `fixed` inputs. The first variables, whose natural
    /// sizes are `sizes`, decide on the step.
    pub fn new(graph: &Graph, fixed: &[DoubleDouble], sizes: Vec<f64>, accuracy: Accuracy) -> Self {
        let size = graph.outputs().len();
        let coefficients = vec![DoubleDouble::zero(); (accuracy.order + 1) * size];
        let series = Series::new(graph, fixed, accuracy.order);
        Self { accuracy, series, size, sizes, coefficients }
    }

    /// Expands about the variables `y` at time `t`. Returns the step at whose end neither of the
    /// last two terms exceeds the error allowed, and somewhat less; it is no number when a
    /// coefficient is none.
    pub fn expand(&mut self, t: DoubleDouble, y: &[DoubleDouble]) -> f64 {
        self.series.write(t, y, &mut self.coefficients);
        let order = self.accuracy.order;
        let largest = [order, order - 1].map(|power| self.largest(power));
        if largest.iter().all(|size| size.is_finite()) {
            Taylor::step_within(order, largest)
        } else {
            f64::NAN
        }
    }

    /// The largest coefficient of a power, in units of the error allowed; infinite when one is not
    /// finite.
    fn largest(&self, power: usize) -> f64 {
        let Accuracy { relative, absolute, .. } = self.accuracy;
        let of_power = |power: usize| &self.coefficients[power * self.size..][..self.sizes.len()];
        let terms = of_power(power).iter().zip(of_power(0)).zip(&self.sizes);
        let allowed = |y: f64, size: f64| absolute * size + relative * y.abs();
        let sizes = terms.map(|((c, y), &size)| c.to_f64().abs() / allowed(y.to_f64(), size));
        let finite = |size: f64| if size.is_finite() { size } else { f64::INFINITY };
        sizes.map(finite).fold(0.0, f64::max)
    }

    /// Writes the variables `since` after the time expanded about.
    pub fn evaluate(&self, since: DoubleDouble, out: &mut [DoubleDouble]) {
        let mut powers = self.coefficients.rchunks(self.size);
        out.copy_from_slice(powers.next().expect("there is a power 0"));
        for of_power in powers {
            for (out, &c) in out.iter_mut().zip(of_power) {
                *out = *out * since + c;
            }
        }
    }
}
