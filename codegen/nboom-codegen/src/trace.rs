//! Equations run on recording scalars: what a request asks for, as graphs.

mod rolled;
mod routine;
mod split;
mod stage;
mod stresses;

use nboom_model::Shape;

pub(crate) use rolled::{
    Among, Chain, Equal, Joints, Kind, LimbSteps, Paddle, PartSteps, Placed, Rolled, Steps,
    TrunkSteps, own_places,
};
pub use routine::trace;
pub(crate) use split::Split;
pub(crate) use stage::{Masked, Traced};

use crate::request::{CodegenError, Request};

/// Operations beyond which an evaluation is emitted as loops: more straight-line code than this
/// no longer fits the processor's instruction cache.
pub const STRAIGHT_LIMIT: usize = 2550;

/// The most operations of all straight lines, and of all steps of joints: an optimising compiler takes 17 seconds
/// for that much code in all instruction sets, and 95 for twice as much. A limb beyond it is taken joint by joint,
/// which is about as fast by then.
pub const OPERATION_LIMIT: usize = 20_000;

/// Links beyond which a limb is not tried as straight lines, equal parts counted once.
const STRAIGHT_LINKS: usize = 64;

/// So many equal appendages fill a register, and a loop over it beats a straight line.
const PACK: usize = 4;

/// So many equal limbs do, or equal parts of one: each is longer than a chain, and both are one straight line. The
/// estimate of a routine's time in nboom-sim counts on it.
const PAIR: usize = 2;

/// Hinges beyond which no straight line is tried: none is shorter than the limit.
const STRAIGHT_HINGES: usize = 16;

/// The equations of a request, recorded.
pub(crate) enum Equations {
    /// Whole, for one straight line.
    Straight(Split),
    /// Step by step, for loops over links and equal appendages.
    Rolled(Box<Rolled>),
}

impl Equations {
    /// Those of a request that was checked.
    ///
    /// # Errors
    /// When no loops can be made of what is too long for one line.
    pub fn of(request: &Request) -> Result<Self, CodegenError> {
        let is_short = |straight: &Split| straight.evaluation().flops() <= STRAIGHT_LIMIT;
        let straight = || Split::new(trace(request), request.assumptions.len()).at(request.level);
        if !request.has_loops() {
            let straight = straight();
            check_length(request, &straight)?;
            return Ok(Self::Straight(straight));
        }
        if request.has_lines() || request.couples_beyond_chains() {
            let few = request.topology.hinges() <= STRAIGHT_HINGES;
            let straight = few.then(straight).filter(is_short);
            let (topology, limit) = (request.topology.to_string(), STRAIGHT_LIMIT);
            let straight = straight.ok_or(CodegenError::StraightAlone { topology, limit })?;
            return Ok(Self::Straight(straight));
        }
        let side_by_side = request.topology.groups().any(|(shape, count)| match shape {
            Shape::Chain(_) | Shape::Paddle => count >= PACK,
            Shape::Limb(limb) => count >= PAIR || !limb.equal_parts().is_empty(),
        });
        let straight = (request.topology.hinges() <= STRAIGHT_HINGES && !side_by_side)
            .then(straight)
            .filter(is_short);
        if let Some(straight) = straight {
            return Ok(Self::Straight(straight));
        }
        let rolled = Rolled::of(request);
        let operations = rolled.joint_operations();
        if operations > OPERATION_LIMIT {
            return Err(too_long(request, operations));
        }
        Ok(Self::Rolled(Box::new(rolled)))
    }
}

/// # Errors
/// When an optimising compiler would take too long for it.
fn check_length(request: &Request, straight: &Split) -> Result<(), CodegenError> {
    let operations = straight.evaluation().flops();
    if operations > OPERATION_LIMIT {
        return Err(too_long(request, operations));
    }
    Ok(())
}

fn too_long(request: &Request, operations: usize) -> CodegenError {
    let (topology, formulation) = (request.topology.to_string(), request.formulation);
    CodegenError::Budget { topology, formulation, operations, limit: OPERATION_LIMIT }
}
