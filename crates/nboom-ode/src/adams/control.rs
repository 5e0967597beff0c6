use super::HIGHEST;
use super::formulas::Formulas;

/// Chooses order and length of steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Control {
    /// Order of the step that is tried, and of the next one.
    pub order: usize,
    next_order: usize,
    /// Whether order and length still grow with every step.
    is_starting: bool,
    /// Errors in units of the tolerance: the one by which a step is judged, and those of its order and of the two below.
    judged: f64,
    errors: [f64; 3],
    /// How often the step was rejected.
    rejections: usize,
}

/// A step is to err by this share of what is allowed.
const AIM: f64 = 0.5;
/// Steps grow if they may by this much or more, and by so much at most: while they are equal, errors of other orders
/// are known best.
const GROWTH: [f64; 2] = [1.2, 2.0];
/// Steps shrink by this much at least, and at most.
const SHRINKAGE: [f64; 2] = [0.9, 0.5];
/// Rejections after which the differences are no guide any more.
const MOST_REJECTIONS: usize = 3;

impl Default for Control {
    fn default() -> Self {
        Self {
            order: 1,
            next_order: 1,
            is_starting: true,
            judged: 0.0,
            errors: [0.0; 3],
            rejections: 0,
        }
    }
}

impl Control {
    /// Notes the errors of a step, from the norms of the differences beyond its order and the two below.
    pub fn judge(&mut self, formulas: &Formulas, norms: [f64; 3]) {
        let norms = norms.map(|norm| if norm.is_finite() { norm } else { f64::INFINITY });
        self.judged = formulas.judged() * norms[0];
        let error = |below: usize| match formulas.order.saturating_sub(below) {
            0 => f64::INFINITY,
            order => formulas.error(order, norms[below]),
        };
        self.errors = [0, 1, 2].map(error);
    }

    pub fn is_good(&self) -> bool {
        self.judged <= 1.0
    }

    /// Whether the order below errs by less.
    fn lowers(&self) -> bool {
        let [own, below, further] = self.errors;
        match self.order {
            1 => false,
            2 => below <= 0.5 * own,
            _ => below.max(further) <= own,
        }
    }

    /// The length of the next step after a good one; `above` is the norm of the difference beyond the order above.
    pub fn accept(&mut self, formulas: &Formulas, above: Option<f64>) -> f64 {
        let (step, order) = (formulas.step, self.order);
        let lowers = self.lowers();
        self.rejections = 0;
        self.is_starting &= !lowers && order < HIGHEST;
        if self.is_starting {
            self.next_order = order + 1;
            return GROWTH[1] * step;
        }
        let [own, below, _] = self.errors;
        let above = above.map_or(f64::INFINITY, |norm| formulas.error(order + 1, norm));
        let (next_order, error) = if lowers || order > 1 && below <= own.min(above) {
            (order - 1, below)
        } else if above < if order > 1 { own } else { 0.5 * own } {
            (order + 1, above)
        } else {
            (order, own)
        };
        self.next_order = next_order;
        step * factor(next_order, error)
    }

    /// The length to try after one that errs too much.
    pub fn reject(&mut self, step: f64) -> f64 {
        let [own, below, _] = self.errors;
        let mut error = own;
        if self.lowers() {
            (self.order, error) = (self.order - 1, below);
        }
        self.is_starting = false;
        self.rejections += 1;
        if self.rejections < MOST_REJECTIONS {
            return SHRINKAGE[1] * step;
        }
        self.order = 1;
        step * wanted(1, error).clamp(0.1, SHRINKAGE[1])
    }

    pub fn advance(&mut self) {
        self.order = self.next_order;
    }
}

/// The factor from a step to one that errs as it is to, if it is of this order.
fn wanted(order: usize, error: f64) -> f64 {
    (AIM / error).powf(1.0 / (order + 1) as f64)
}

fn factor(order: usize, error: f64) -> f64 {
    let [least, most] = GROWTH;
    if error > AIM {
        return wanted(order, error).clamp(SHRINKAGE[1], SHRINKAGE[0]);
    }
    let may_grow = error * least.powi(order as i32 + 1) <= AIM;
    if may_grow { wanted(order, error).min(most) } else { 1.0 }
}
