//! The one place that lists the force elements.

use nboom_model::{Mode, Scene, WeldedTree};
use nboom_scalar::{Mat3, Real, Twist, Vec3, Wrench};

use crate::{Coordinate, Line, Names, Placed, Switched};

mod commands;
mod coupling;
mod external;
mod friction;
mod gravity;
mod hinge_law;
mod hinge_torque;
mod kick_off;
mod magnitude;
mod own_law;
mod torque_table;
mod withheld;

pub use commands::{Commands, Reach};
pub use coupling::{Coupled, CoupledEnd, CouplingLaw};
pub use external::Push;
pub use friction::friction_torques;
pub use gravity::{gravity, gravity_potential};
pub use hinge_law::HingeLaw;
pub use hinge_torque::HingeTorque;
pub use kick_off::KickOffLaw;
pub use own_law::{OwnLaw, OwnLaws};
use withheld::WithheldMoment;

/// The kinds of elements that are told apart in messages and files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A spring that pushes a body off the main body until it has reached its limit length.
    KickOff,
    /// Coulomb's friction about a hinge.
    Friction,
    /// A torque about a hinge, tabulated over its angle.
    TorqueTable,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::KickOff, Self::Friction, Self::TorqueTable];

    /// What it is called.
    pub fn names(self) -> &'static Names {
        match self {
            Self::KickOff => &kick_off::NAMES,
            Self::Friction => &friction::NAMES,
            Self::TorqueTable => &torque_table::NAMES,
        }
    }
}

/// Tells `each` kind, hinge, coordinate and bounds of each element whose law has several pieces, in the order
/// of [`SceneDescription::pieces_at_rest`](nboom_model::SceneDescription): lines first,
/// then friction.
pub(crate) fn switched(
    scene: &Scene,
    mut each: impl FnMut(Kind, usize, Coordinate, &mut dyn Iterator<Item = f64>),
) {
    let spring = |i: usize| Some((i, scene.bodies[i].hinge.kick_off?));
    let springs = (0..scene.bodies.len()).filter_map(spring);
    for (line, (hinge, spring)) in springs.enumerate() {
        let limit = &mut std::iter::once(spring.limit_length);
        each(Kind::KickOff, hinge, Coordinate::Length(line), limit);
    }
    for hinge in scene.hinges_with_friction() {
        each(Kind::Friction, hinge, Coordinate::Rate(hinge), &mut std::iter::once(0.0));
    }
    for table in &scene.torque_tables {
        let angles = &mut table.points.iter().map(|point| point[0]);
        each(Kind::TorqueTable, table.hinge, Coordinate::Angle(table.hinge), angles);
    }
}

/// The force elements of a scene as they act in one mode, by what they act on: torques about
/// hinges, forces along lines between two bodies, and forces and torques from outside.
///
/// Evaluations allocate nothing.
#[derive(Clone, Debug)]
pub struct Elements<R> {
    torques: Vec<HingeTorque<R>>,
    couplings: Vec<Coupled<R>>,
    lines: Vec<Line<R>>,
    withheld: Vec<WithheldMoment<R>>,
    pushes: Vec<Push<R>>,
    /// What a control law commands on the main body.
    commanded: Option<Wrench<R>>,
    /// Pushes on the main link and command together.
    external: Option<Wrench<R>>,
    switched: Vec<Switched>,
}

impl<R: Real> Elements<R> {
    /// Those of `scene` in `mode`, whose links are those of `tree`.
    pub fn new(scene: &Scene, mode: &Mode, tree: &WeldedTree<R>) -> Self {
        let mut elements = Self {
            torques: Vec::with_capacity(scene.bodies.len()),
            couplings: Vec::with_capacity(scene.couplings.len()),
            lines: Vec::new(),
            withheld: Vec::new(),
            pushes: Vec::new(),
            commanded: None,
            external: None,
            switched: Vec::with_capacity(mode.pieces.len()),
        };
        elements.set(scene, mode, tree);
        elements
    }

    /// Makes them the [new](Self::new) ones of any scene, mode and tree, in the room that they have.
    pub fn set(&mut self, scene: &Scene, mode: &Mode, tree: &WeldedTree<R>) {
        HingeTorque::write_all(scene, mode, &mut self.torques);
        self.couplings.clear();
        self.couplings.extend(Coupled::all(scene, tree));
        self.lines.clear();
        self.lines.extend(Line::all(scene, mode, tree));
        self.withheld.clear();
        self.withheld.extend(WithheldMoment::all(scene, mode, tree, &self.lines));
        Push::write_all(scene, mode, tree, &mut self.pushes);
        self.commanded = None;
        self.external = on_main_link(&self.pushes, None);
        Switched::write_all(scene, &mut self.switched);
    }

    /// The law of the torque about each hinge of the scene, whether it is held or free.
    pub fn torques(&self) -> &[HingeTorque<R>] {
        &self.torques
    }

    /// The forces along lines, by hinge.
    pub fn lines(&self) -> &[Line<R>] {
        &self.lines
    }

    /// The lines that act on links, each with its link.
    #[inline(always)]
    pub fn pushing(&self) -> impl Iterator<Item = (usize, &Line<R>)> {
        self.lines.iter().filter(|line| line.acts).filter_map(|line| Some((line.link?, line)))
    }

    /// Holds `commands` in place of those that it held.
    ///
    /// A torque that is held is a constant part of the law of its hinge, with a potential.
    pub fn command(&mut self, commands: &Commands) {
        for (torque, &commanded) in self.torques.iter_mut().zip(commands.hinge_torques()) {
            torque.hold(commanded);
        }
        self.commanded = commands::held(commands);
        self.external = on_main_link(&self.pushes, self.commanded);
    }

    /// Sets what acts from outside to what it is at `time` when `rot_inertial_from_main` is the attitude.
    #[inline(always)]
    pub fn set_pushes(&mut self, rot_inertial_from_main: &Mat3<R>, time: R) {
        let varying = self.pushes.iter_mut().filter(|push| push.varies());
        varying.for_each(|push| push.set(rot_inertial_from_main, time));
        self.external = on_main_link(&self.pushes, self.commanded);
    }

    /// Whether what acts from outside is other at another time or attitude.
    #[inline(always)]
    pub fn pushes_vary(&self) -> bool {
        self.pushes.iter().any(Push::varies)
    }

    /// Whether something acts from outside: a force or torque of the scene, or what a control law commands.
    #[inline(always)]
    pub fn acts_from_outside(&self) -> bool {
        !self.pushes.is_empty() || self.commanded.is_some()
    }

    /// What acts from outside, in the scene's order.
    pub fn pushes(&self) -> &[Push<R>] {
        &self.pushes
    }

    /// What acts from outside on links other than the main one, each with its link.
    #[inline(always)]
    pub fn on_links(&self) -> impl Iterator<Item = (usize, &Push<R>)> {
        self.pushes.iter().filter_map(|push| Some((push.link?, push)))
    }

    /// What acts on the main link from outside, about O along main-body axes, if anything does: forces and torques
    /// of the scene, and what a control law commands.
    #[inline(always)]
    pub fn external(&self) -> Option<Wrench<R>> {
        self.external
    }

    /// Power of what acts on the main link from outside when O moves as `twist`, and its moment about `point`, from O;
    /// main-body axes.
    #[inline(always)]
    pub fn external_power_and_moment(&self, twist: Twist<R>, point: Vec3<R>) -> (R, Vec3<R>) {
        let (mut power, mut of_all) = (R::zero(), Vec3::zero());
        for push in self.pushes.iter().filter(|push| push.link.is_none()) {
            let (of_one, moment) = push.power_and_moment(None, twist, point);
            power += of_one;
            of_all += moment;
        }
        if let Some(Wrench { moment, force }) = self.commanded {
            power += force.dot(twist.linear) + moment.dot(twist.angular);
            of_all += moment - point.cross(force);
        }
        (power, of_all)
    }

    /// Sets `out` to the forces and torques from outside on hinged bodies, as the scene lists them; zero where one does
    /// not act. Body axes, or main-body axes where it is given along inertial ones.
    pub fn set_on_hinged(&self, out: &mut [[R; 3]]) {
        out.fill([R::zero(); 3]);
        for (place, acting) in self.pushes.iter().filter_map(Push::on_hinged) {
            out[place] = acting.to_array();
        }
    }

    /// The elements with several pieces to their law.
    pub fn switched(&self) -> &[Switched] {
        &self.switched
    }

    /// Sets `out` to the torques about the hinges `free` at their angles and rates.
    #[inline(always)]
    pub fn set_torques(&self, free: &[usize], [beta, tau]: [&[R]; 2], out: &mut [R]) {
        for (j, &hinge) in free.iter().enumerate() {
            out[j] = self.torques[hinge].torque(beta[j], tau[j]);
        }
        for coupling in &self.couplings {
            coupling.add_to_free([beta, tau], out);
        }
    }

    /// Sets `out` to the torques about all hinges of the scene at their angles and rates, whether they are
    /// held or free.
    pub fn set_all_torques(&self, [beta, tau]: [&[R]; 2], out: &mut [R]) {
        let laws = self.torques.iter().zip(beta.iter().zip(tau));
        for (torque, (law, (&beta, &tau))) in out.iter_mut().zip(laws) {
            *torque = law.torque(beta, tau);
        }
        for coupling in &self.couplings {
            coupling.add_to_all([beta, tau], out);
        }
    }

    /// The couplings that act on a free hinge.
    pub fn coupled(&self) -> impl Iterator<Item = &Coupled<R>> {
        self.couplings.iter().filter(|coupling| coupling.acts())
    }

    /// Potential energy of each coupling at β of all hinges, with its first hinge.
    pub fn coupling_potentials(&self, beta: &[R]) -> impl Iterator<Item = (usize, R)> {
        self.couplings.iter().map(|coupling| (coupling.hinge(), coupling.potential(beta)))
    }

    /// For each coupling its first hinge and the power of what no potential accounts for, at β and τ of all hinges of
    /// the scene.
    pub fn coupling_powers(&self, motion: [&[R]; 2]) -> impl Iterator<Item = (usize, R)> {
        self.couplings.iter().map(move |coupling| (coupling.hinge(), coupling.power_in(motion)))
    }

    /// Takes off the torques about the hinges of `links` what lines do not transmit.
    #[inline(always)]
    pub fn withhold<P: Placed<R>>(&self, links: &[P], torques: &mut [R]) {
        for moment in &self.withheld {
            torques[moment.link] -= moment.torque(links);
        }
    }

    /// The hinge of the first line that does not transmit all of its moment, if there is one.
    pub fn withheld(&self) -> Option<usize> {
        self.withheld.first().map(WithheldMoment::hinge)
    }

    /// Power of what no potential accounts for: of the parts of the torques about the hinges `free` that
    /// depend on their rates, at their β and τ.
    #[inline(always)]
    pub fn rate_power(&self, free: &[usize], [beta, tau]: [&[R]; 2]) -> R {
        let mut power = R::zero();
        for (&hinge, &tau) in free.iter().zip(tau) {
            power += self.torques[hinge].rate_torque(tau) * tau;
        }
        for coupling in &self.couplings {
            power += coupling.power([beta, tau]);
        }
        power
    }
}

impl Elements<f64> {
    /// Whether some torque about the hinges `free` does work that no potential accounts for.
    pub fn has_rate_power(&self, free: &[usize]) -> bool {
        free.iter().any(|&hinge| self.torques[hinge].depends_on_rate())
            || self.couplings.iter().any(Coupled::has_power)
    }
}

/// What acts on the main link together.
#[inline(always)]
fn on_main_link<R: Real>(pushes: &[Push<R>], commanded: Option<Wrench<R>>) -> Option<Wrench<R>> {
    let mut all: Option<Wrench<R>> = None;
    for push in pushes.iter().filter(|push| push.link.is_none()) {
        let wrench = push.wrench(None);
        match &mut all {
            Some(sum) => sum.add(wrench),
            None => all = Some(wrench),
        }
    }
    match (&mut all, commanded) {
        (Some(sum), Some(wrench)) => sum.add(wrench),
        (None, _) => all = commanded,
        (Some(_), None) => {}
    }
    all
}

/// Energy that the elements about hinges and along lines can store on their way, every term taken by
/// its magnitude.
pub fn stored(scene: &Scene) -> f64 {
    let hinges = scene.bodies.iter().map(|body| &body.hinge);
    let springs: f64 = hinges.map(|hinge| hinge_law::stored(hinge) + kick_off::stored(hinge)).sum();
    let couplings = scene.couplings.iter().map(|one| coupling::stored(scene, one));
    springs
        + couplings.sum::<f64>()
        + scene.torque_tables.iter().map(torque_table::stored).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_model::{
        Appendage, Hinge, KickOffSpring, MassProperties, Mount, SceneDescription, Segment,
    };
    use nboom_scalar::{Sym3, Vec3};

    #[test]
    fn a_mode_has_a_place_for_each_element_with_several_pieces() {
        let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        let spring = KickOffSpring {
            main_body_point: Vec3::zero(),
            body_point: Vec3::unit_y(),
            coefficients: [1.0, 0.0, 0.0, 0.0],
            limit_length: 2.0,
        };
        let hinges = [None, Some(spring), None, Some(spring)];
        let segment = |kick_off| Segment {
            length: 1.0,
            mass_properties: body,
            hinge: Hinge { kick_off, ..Hinge::free() },
        };
        let mut description = SceneDescription::at_rest("springs", body, 1.0);
        let segments = hinges.map(segment).to_vec();
        description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
        let scene = Scene::new(description).expect("physical bodies");
        let mode = Mode::at_start(&scene);
        let elements =
            Elements::<f64>::new(&scene, &mode, &WeldedTree::new(&scene, &mode, &[0.0; 4]));
        let switched = elements.switched();
        assert_eq!(switched.iter().map(|e| e.id.hinge).collect::<Vec<_>>(), [1, 3]);
        assert_eq!(switched.len(), mode.pieces.len());
        for (index, element) in switched.iter().enumerate() {
            assert_eq!(element.id.index, index);
            assert!(mode.pieces[index] <= element.bounds.len());
        }
        assert_eq!(elements.pushing().count(), 0);
    }
}
