//! Where nothing has inertia.

use nboom_model::Joint;
use nboom_scalar::ArticulatedInertia;

use crate::Recursive;

/// Share of the inertia at a hinge below which that about its axis is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// What is free to move and has no inertia, so that there are no accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singularity {
    /// The main body, about an axis or along one.
    MainBody,
    /// What is outboard of this hinge, numbered as in the scene, about its axis or, where it slides, along that.
    Hinge(usize),
}

impl Singularity {
    /// The hinge; none if it is the main body.
    pub fn hinge(self) -> Option<usize> {
        match self {
            Self::MainBody => None,
            Self::Hinge(hinge) => Some(hinge),
        }
    }
}

impl Recursive<f64> {
    /// What has no inertia at the angles `beta` of the free hinges; of several hinges the last.
    pub fn singularity(&mut self, beta: &[f64]) -> Option<Singularity> {
        self.factor(beta);
        self.singularity_as_computed()
    }

    /// The [same](Self::singularity) at the angles of the [accelerations](Self::accelerations) that were computed
    /// last.
    pub fn singularity_as_computed(&self) -> Option<Singularity> {
        let regular = |j: usize| {
            let (pivot, at_hinge) = (1.0 / self.hinges[j].inverse_pivot, &self.articulated[j]);
            let whole = match self.poses[j].joint {
                Joint::Revolute => at_hinge.angular,
                Joint::Prismatic => at_hinge.linear,
            };
            pivot > ROUNDING * whole.trace()
        };
        let singular = (0..self.hinges.len()).rev().find(|&j| !regular(j));
        let of_hinge = singular.map(|j| Singularity::Hinge(self.free_hinges()[j]));
        let is_of_main = || self.tree.held.is_none() && !self.base.is_above(self.on_main());
        of_hinge.or_else(|| is_of_main().then_some(Singularity::MainBody))
    }

    /// What is rounding in the main link's inertia, angular and linear: of what hangs on it, that which moves freely
    /// has been subtracted.
    fn on_main(&self) -> [f64; 2] {
        let sizes = |of: ArticulatedInertia<f64>| [of.angular.trace(), of.linear.trace()];
        let roots = (0..self.tree.links.len()).filter(|&j| self.tree.links[j].inboard.is_none());
        let seen = |j: usize| sizes(self.articulated[j].seen_from(self.poses[j].offset));
        roots.map(seen).fold([0.0; 2], |[a, l], [angular, linear]| {
            [a + ROUNDING * angular, l + ROUNDING * linear]
        })
    }
}
