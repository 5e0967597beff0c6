//! Where the links of a limb are.

use nboom_model::{Limb, LimbJoint};
use nboom_scalar::{Mat3, Real, Vec3};

use crate::parameters::{Branch, Mount};
use crate::pose::{LinkPlace, about_first};

/// The places of all links, along the axes of the first joint.
pub(crate) fn link_places<R: Real>(
    limb: &Limb,
    branch: &Branch<R>,
    beta: &[R],
) -> Vec<LinkPlace<R>> {
    let mut places: Vec<LinkPlace<R>> = Vec::with_capacity(beta.len());
    // Of each link, the axes in which it turns, and how far; parallel joints have them in common.
    let mut turning: Vec<(Mat3<R>, R)> = Vec::with_capacity(beta.len());
    for (i, (of_limb, &beta)) in limb.links().iter().zip(beta).enumerate() {
        let inboard = of_limb.inboard.map(usize::from);
        let (axes, position, alpha) = match (inboard, branch.mount(i)) {
            (None, _) => (Mat3::identity(), branch.point, R::zero()),
            (Some(inboard), Mount::Parallel([ly, lz])) => {
                let link = &places[inboard];
                let way = link.rot * Vec3::new(R::zero(), ly, lz);
                (turning[inboard].0, link.position + way, turning[inboard].1)
            }
            (Some(inboard), Mount::Across { rot, point }) => {
                let link = &places[inboard];
                (link.rot * rot, link.position + link.rot * point, R::zero())
            }
        };
        let slides = of_limb.joint == LimbJoint::Prismatic;
        let axis = axes * Vec3::unit_x();
        let alpha = if slides { R::zero() } else { alpha + beta };
        let rot = if slides { axes } else { axes * about_first(alpha.sin_cos()) };
        let position = if slides { position + axis * beta } else { position };
        turning.push((axes, alpha));
        places.push(LinkPlace { rot, position, axis, slides, inboard });
    }
    places
}
