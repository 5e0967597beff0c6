use nboom_dynamics::Recursive;
use nboom_formulation::{Forces, RightSideLayout, recognise};

use crate::code::fit::{Fit, Repertoire};

/// A generated right side fitted to a scene in one mode: the rates of change of attitude, ω, β and τ in
/// one call.
#[derive(Clone, Debug)]
pub(crate) struct RightSide {
    fit: Fit,
    constants: Vec<f64>,
    /// For each free hinge, the routine's.
    hinges: Vec<usize>,
    /// Whether the variables of the mode stand as the routine wants them.
    in_order: bool,
    coordinates: Vec<f64>,
    rates: Vec<f64>,
}

impl RightSide {
    /// The best routine of `repertoire` for what acts in the mode of `dynamics`. `None` if there is
    /// none.
    pub fn fit(dynamics: &Recursive<f64>, repertoire: &Repertoire) -> Option<Self> {
        let tree = dynamics.tree();
        let recognised = recognise(tree).ok()?;
        let forces = Forces::of(dynamics.elements(), tree, &recognised)?;
        let fit = repertoire.right_side(&recognised, &forces)?;
        let mut hinges = vec![0; recognised.links.len()];
        for (&link, &hinge) in recognised.links.iter().zip(fit.embedding.hinges()) {
            hinges[link] = hinge;
        }
        let in_order = hinges.iter().copied().eq(0..fit.embedding.outer().hinges());
        Some(Self {
            constants: fit.constants(),
            hinges,
            in_order,
            coordinates: vec![0.0; fit.kernel.coordinates],
            rates: vec![0.0; fit.kernel.outputs],
            fit,
        })
    }

    /// Writes the rates of attitude, ω, β and τ at `y`, which begins with these, to the beginning of
    /// `dy`; returns the power of the parts of the hinge torques that depend on rates.
    pub fn write(&mut self, y: &[f64], dy: &mut [f64]) -> f64 {
        let Self { fit, constants, hinges, in_order, coordinates, rates } = self;
        let topology = fit.embedding.outer();
        let (first, end) = (RightSideLayout::STATE, RightSideLayout::STATE + 2 * hinges.len());
        let power = RightSideLayout::power(topology);
        if *in_order {
            fit.kernel.evaluate(constants, &y[..end], rates);
            dy[..end].copy_from_slice(&rates[..end]);
            return rates[power];
        }
        let tau = RightSideLayout::tau(topology).start;
        coordinates[..first].copy_from_slice(&y[..first]);
        let (of_beta, of_tau) = y[first..end].split_at(hinges.len());
        for (&hinge, (beta, rate)) in hinges.iter().zip(of_beta.iter().zip(of_tau)) {
            (coordinates[first + hinge], coordinates[tau + hinge]) = (*beta, *rate);
        }
        fit.kernel.evaluate(constants, coordinates, rates);
        dy[..first].copy_from_slice(&rates[..first]);
        let (of_beta, of_tau) = dy[first..end].split_at_mut(hinges.len());
        for (&hinge, (beta, rate)) in hinges.iter().zip(of_beta.iter_mut().zip(of_tau)) {
            (*beta, *rate) = (rates[first + hinge], rates[tau + hinge]);
        }
        rates[power]
    }
}
