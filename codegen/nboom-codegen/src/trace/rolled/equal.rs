//! Equal appendages, and equal parts of limbs: what they are called, and where their numbers stand.

use nboom_formulation::{Layout, RightSideLayout};
use nboom_model::{Shape, Topology};

use crate::request::{Request, identifier};

/// Letters beyond which the name of a limb is long.
const LONG: usize = 12;

/// Equal appendages, or equal parts of a limb on one link.
pub(crate) struct Equal {
    pub shape: Shape,
    pub count: usize,
    /// Where the parameters of the first one begin.
    pub parameter: usize,
    /// Hinges before.
    pub hinge: usize,
    /// Where the laws of a right side begin.
    pub law: usize,
    /// Where the couplings of a right side begin.
    pub coupling: usize,
    /// Of parts of a limb, what names of functions begin with. Their numbers stand part by part, as those of the
    /// limb do, where those of equal appendages stand side by side.
    pub part: Option<String>,
}

impl Equal {
    /// How many parameters an appendage has.
    pub fn parameters(&self) -> usize {
        Layout::appendage(&self.shape)
    }

    /// Where the parameters of link `i` begin among those of an appendage.
    pub fn link(&self, i: usize) -> usize {
        Layout::BRANCH + (0..i).map(|link| Layout::link(&self.shape, link)).sum::<usize>()
    }

    /// What names of functions begin with: `s3` for chains of three links, `p` for paddles, and for limbs whose
    /// names are long their links and the hinges before; of parts of a limb as they are called.
    pub fn prefix(&self) -> String {
        if let Some(part) = &self.part {
            return part.clone();
        }
        if matches!(self.shape, Shape::Limb(_)) && self.shape_name().len() > LONG {
            return format!("t{}_{}", self.shape.hinges(), self.hinge);
        }
        identifier(&Topology::new([self.shape.clone()])).to_lowercase()
    }

    /// What its shape is called in a topology.
    pub fn shape_name(&self) -> String {
        Topology::new([self.shape.clone()]).to_string()
    }

    /// What is assumed of every appendage: `size` numbers from `offset` on, and of every one of
    /// `repeats` repetitions a link apart.
    pub fn assumptions(
        &self,
        request: &Request,
        offset: usize,
        size: usize,
        repeats: usize,
    ) -> Vec<Option<f64>> {
        let start = |appendage: usize, repeat: usize| {
            self.parameter + appendage * self.parameters() + offset + repeat * Layout::LINK
        };
        self.common(request, start, size, repeats)
    }

    /// What is assumed of the law of every hinge.
    pub fn of_laws(&self, request: &Request) -> Vec<Option<f64>> {
        let hinges = self.shape.hinges();
        let start = |appendage: usize, hinge: usize| {
            self.law + (appendage * hinges + hinge) * RightSideLayout::LAW
        };
        self.common(request, start, RightSideLayout::LAW, hinges)
    }

    /// What is assumed of every coupling of a hinge with the one inboard of it in the same appendage.
    pub fn of_couplings(&self, request: &Request) -> Vec<Option<f64>> {
        let hinges = self.shape.hinges();
        let start = |appendage: usize, outboard: usize| {
            self.coupling + (appendage * hinges + 1 + outboard) * RightSideLayout::COUPLING
        };
        self.common(request, start, RightSideLayout::COUPLING, hinges - 1)
    }

    /// What is assumed of `size` numbers wherever they `start`, by appendage and repetition.
    pub fn common(
        &self,
        request: &Request,
        start: impl Fn(usize, usize) -> usize,
        size: usize,
        repeats: usize,
    ) -> Vec<Option<f64>> {
        let common = |i: usize| {
            let at = |appendage, repeat| request.assumptions[start(appendage, repeat) + i];
            let same = |appendage| (0..repeats).all(|repeat| at(appendage, repeat) == at(0, 0));
            at(0, 0).filter(|_| (0..self.count).all(same))
        };
        (0..size).map(common).collect()
    }
}
