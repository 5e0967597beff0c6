use nboom_scalar::{Mat3, Real, Sym3, Vec3};

use crate::Scene;

/// Deliberate departures of a motion from that of rigid bodies under the scene's forces, made to
/// follow another program. By default there are none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Departures {
    /// Bodies whose inertia about their mass centre turns otherwise than they do.
    pub turned: Vec<TurnOrder>,
    /// Moments of forces along lines that do not turn a hinge.
    pub withheld: Vec<Withheld>,
}

impl Departures {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.turned.is_empty() && self.withheld.is_empty()
    }

    /// The bodies and hinges that they name.
    pub(crate) fn named(&self) -> impl Iterator<Item = usize> {
        let of_turned = self.turned.iter().flat_map(|order| {
            [order.body, order.mount].into_iter().chain(order.hinges.iter().copied())
        });
        let of_withheld = self.withheld.iter().flat_map(|w| [w.line, w.outboard, w.inboard]);
        of_turned.chain(of_withheld)
    }
}

/// The rotations that turn the inertia of a body about its mass centre into main-body axes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TurnOrder {
    /// The body.
    pub body: usize,
    /// The hinge whose mounting axes, on the main body, the rotations start from.
    pub mount: usize,
    /// The hinges that turn it, the outermost rotation first.
    pub hinges: Vec<usize>,
}

/// The moment of the line of hinge `line` about hinge `outboard`, which does not turn hinge `inboard`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Withheld {
    /// The hinge of the line's body.
    pub line: usize,
    /// The hinge about which the moment is.
    pub outboard: usize,
    /// The hinge that it does not turn.
    pub inboard: usize,
}

/// The inertia of a body about its mass centre that turns by a [`TurnOrder`].
///
/// It is the tensor of a rigid body only while all hinges of the body are held.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnedInertia<R> {
    rot_main_from_mount: Mat3<R>,
    turns: Vec<Turn<R>>,
    inertia: Sym3<R>,
}

/// The rotation of one hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turn<R> {
    axis: Vec3<R>,
    /// Of a hinge that is held.
    angle: R,
    /// Of a hinge that is free.
    link: Option<usize>,
}

impl<R: Real> TurnedInertia<R> {
    /// By this order. `beta` has the angle of every hinge of the scene; `link` tells the link of a
    /// hinge that is free.
    pub(crate) fn new(
        scene: &Scene,
        order: &TurnOrder,
        beta: &[R],
        link: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        let turn = |&i: &usize| {
            let axis = Vec3::constant(scene.bodies[i].axis);
            Turn { axis, angle: beta[i], link: link(i) }
        };
        let mount = scene.bodies[order.mount].mount.rot_inboard_from_hinge;
        Self {
            rot_main_from_mount: Mat3::constant(mount),
            turns: order.hinges.iter().map(turn).collect(),
            inertia: Sym3::constant(scene.bodies[order.body].mass_properties.inertia),
        }
    }

    /// Makes every number a scalar of this kind.
    pub(crate) fn constant(turned: &TurnedInertia<f64>) -> Self {
        let turn = |turn: &Turn<f64>| Turn {
            axis: Vec3::constant(turn.axis),
            angle: R::constant(turn.angle),
            link: turn.link,
        };
        Self {
            rot_main_from_mount: Mat3::constant(turned.rot_main_from_mount),
            turns: turned.turns.iter().map(turn).collect(),
            inertia: Sym3::constant(turned.inertia),
        }
    }

    /// The tensor at the angles `beta` of the links \[rad\], main-body axes.
    #[inline]
    pub fn inertia(&self, beta: &[R]) -> Sym3<R> {
        let rot = self.turns.iter().fold(self.rot_main_from_mount, |rot, turn| {
            rot * Mat3::about_axis(turn.axis, turn.link.map_or(turn.angle, |j| beta[j]))
        });
        self.inertia.rotated(&rot)
    }
}
