//! Where the links of a limb are, and how they move.

use nboom_model::LimbLink;
use nboom_scalar::{Real, Vec3};

use crate::chain::{self, ChainLink, Spin, Turned};
use crate::limb::stance::{Stance, Standing};
use crate::limb::turn::Turn;
use crate::parameters::{Branch, Mount};

/// A link in one state.
pub(crate) struct Moving<R> {
    pub stance: Stance<R>,
    pub motion: Motion<R>,
    pub body: Turned<R>,
}

/// How a link and the axes move in which it is written.
pub(crate) struct Motion<R> {
    /// How far the link has turned from these axes, and how fast it turns.
    pub alpha: R,
    pub sigma: R,
    /// ω of these axes.
    pub spin: Spin<R>,
    /// Bias acceleration of the link's origin.
    pub origin: Vec3<R>,
}

/// The motion at a mount: ω of the axes there, angle and rate about ê₁ of the link inboard of it where that is
/// parallel, and the bias acceleration.
pub(crate) struct AtMount<R> {
    pub spin: Vec3<R>,
    pub alpha: R,
    pub sigma: R,
    pub bias: Vec3<R>,
}

/// All `links` of an appendage whose coordinates and rates are β, τ, when its mount moves so.
pub(crate) fn outward<R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    of_first: &AtMount<R>,
    rates: impl Iterator<Item = [R; 2]>,
) -> Vec<Moving<R>> {
    let mut moving: Vec<Moving<R>> = Vec::with_capacity(links.len());
    for (i, (link, rates)) in links.iter().zip(rates).enumerate() {
        R::remark(|| format!("Link {number},{}, outward: its bias.", i + 1));
        let on_inboard = link.inboard.map(|inboard| {
            let Moving { stance, motion, .. } = &moving[usize::from(inboard)];
            motion.at(stance, &branch.mount(i))
        });
        let at_mount = on_inboard.as_ref().unwrap_or(of_first);
        let [beta, tau] = rates;
        let constants = &branch.links[i];
        moving.push(match Standing::of(links, i) {
            Standing::Sliding => Moving::sliding(constants, at_mount, rates),
            standing => {
                let alpha = at_mount.alpha + beta;
                let turn = Turn::by(alpha);
                Moving::turning(constants, at_mount, standing.turns(turn), [alpha, tau])
            }
        });
    }
    moving
}

/// The motion at the mount of an appendage on a main body that turns at `omega`.
pub(crate) fn of_main_body<R: Real>(branch: &Branch<R>, omega: Vec3<R>) -> AtMount<R> {
    let spin = branch.rot_body_from_appendage.transpose_mul(omega);
    let bias = Spin::new(spin).bias_of_main_point(branch.point);
    AtMount { spin, alpha: R::zero(), sigma: R::zero(), bias }
}

impl<R: Real> Moving<R> {
    /// A link that has turned by `alpha` from the axes of its mount, at τ from what is inboard of it.
    pub fn turning(
        constants: &ChainLink<R>,
        at_mount: &AtMount<R>,
        [axes_turned, turned]: [Turn<R>; 2],
        [alpha, tau]: [R; 2],
    ) -> Self {
        let spin = Spin::new(axes_turned.vector_back(at_mount.spin));
        let origin = axes_turned.vector_back(at_mount.bias);
        let from = (at_mount.sigma, origin);
        let (body, sigma, _) =
            chain::outward_at(&spin, constants, (turned.sin, turned.cos), tau, from);
        let bias = angular_bias(turned, spin.w, sigma);
        let stance = Stance { axes_turned, turned, travel: R::zero(), bias };
        Self { stance, motion: Motion { alpha, sigma, spin, origin }, body }
    }

    /// A link at travel β from its mount, at τ.
    pub fn sliding(constants: &ChainLink<R>, at_mount: &AtMount<R>, [beta, tau]: [R; 2]) -> Self {
        let (zero, still) = (R::zero(), Turn::still());
        let w = at_mount.spin;
        let spin = Spin::new(w);
        let coriolis = Vec3::new(zero, w.z, -w.y) * (tau + tau);
        let along = Vec3::new(beta, zero, zero);
        let origin = at_mount.bias + spin.bias_of_main_point(along) + coriolis;
        let (body, sigma, _) =
            chain::outward_at(&spin, constants, (still.sin, still.cos), zero, (zero, origin));
        let bias = angular_bias(still, w, sigma);
        let stance = Stance { axes_turned: still, turned: still, travel: beta, bias };
        Self { stance, motion: Motion { alpha: zero, sigma, spin, origin }, body }
    }
}

impl<R: Real> Motion<R> {
    /// How a mount on the link moves, which stands so.
    #[inline]
    pub fn at(&self, stance: &Stance<R>, mount: &Mount<R>) -> AtMount<R> {
        match mount {
            Mount::Parallel(way) => {
                let bias = self.origin + self.spin.bias_of(self.sigma, stance.way(*way));
                AtMount { spin: self.spin.w, alpha: self.alpha, sigma: self.sigma, bias }
            }
            Mount::Across { rot, point } => {
                let Stance { turned, bias, .. } = *stance;
                let w = own_spin(turned, self.spin.w, self.sigma);
                let of_point = Spin::new(w).bias_of_main_point(*point);
                let bias = turned.vector_back(self.origin) + (of_point + bias.cross(*point));
                let (spin, bias) = (rot.transpose_mul(w), rot.transpose_mul(bias));
                AtMount { spin, alpha: R::zero(), sigma: R::zero(), bias }
            }
        }
    }
}

/// ω along the own axes of a link that has turned so far from axes that turn at `w`, and turns at `sigma`
/// about ê₁.
fn own_spin<R: Real>(turned: Turn<R>, w: Vec3<R>, sigma: R) -> Vec3<R> {
    turned.vector_back(Vec3::new(w.x + sigma, w.y, w.z))
}

/// ω × ê₁ σ of such a link.
fn angular_bias<R: Real>(turned: Turn<R>, w: Vec3<R>, sigma: R) -> Vec3<R> {
    let w = own_spin(turned, w, sigma);
    Vec3::new(R::zero(), sigma * w.z, -(sigma * w.y))
}
