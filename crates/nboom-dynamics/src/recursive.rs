use std::sync::Arc;

use nboom_elements::{Commands, Elements};
use nboom_model::{Mode, RotorMotion, Scene, WeldedTree};
use nboom_scalar::{ArticulatedInertia, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::articulated_body::{self, HingeFactor, Load};
use crate::base::BaseFactor;
use crate::composite_body;
use crate::pose::{self, LinkConstants, LinkPose};

/// Rates of the main body and angles and rates of the free hinges, in the order of
/// [`Recursive::free_hinges`].
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a, R> {
    /// ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<R>,
    /// β of the free hinges \[rad\].
    pub beta: &'a [R],
    /// τ of the free hinges \[rad/T\].
    pub tau: &'a [R],
}

/// Accelerations of the main body and the free hinges.
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerations<R> {
    /// ω̇, main-body axes \[rad/T²\].
    pub omega_dot_body: Vec3<R>,
    /// a_O, inertial acceleration of O without gravity, main-body axes \[L/T²\].
    pub origin_body: Vec3<R>,
    /// τ̇ of the free hinges \[rad/T²\].
    pub tau_dot: Vec<R>,
}

impl<R: Real> Accelerations<R> {
    /// Zero accelerations of a scene with this many free hinges.
    pub fn for_hinges(free: usize) -> Self {
        Self {
            omega_dot_body: Vec3::zero(),
            origin_body: Vec3::zero(),
            tau_dot: vec![R::zero(); free],
        }
    }
}

/// The recursive formulation of one scene, in one mode at a time.
///
/// Evaluations allocate nothing; setting the mode does where there was not so much before.
#[derive(Clone, Debug)]
pub struct Recursive<R> {
    pub(crate) scene: Arc<Scene>,
    pub(crate) tree: WeldedTree<R>,
    pub(crate) constants: Vec<LinkConstants<R>>,
    pub(crate) elements: Elements<R>,
    /// How the rotors turn at a time, from which their speeds go on straight.
    pub(crate) rotors: (R, Vec<RotorMotion<R>>),
    free: Vec<usize>,
    pub(crate) poses: Vec<LinkPose<R>>,
    pub(crate) hinges: Vec<HingeFactor<R>>,
    pub(crate) base: BaseFactor<R>,
    pub(crate) articulated: Vec<ArticulatedInertia<R>>,
    pub(crate) composite: Vec<RigidInertia<R>>,
    pub(crate) omegas: Vec<Vec3<R>>,
    pub(crate) twists: Vec<Twist<R>>,
    pub(crate) wrenches: Vec<Wrench<R>>,
}

impl<R: Real> Recursive<R> {
    /// The formulation of `scene` in the mode in which the scene starts.
    pub fn new(scene: &Scene) -> Self {
        Self::of_scene(Arc::new(scene.clone()))
    }

    /// The [`new`](Self::new) formulation of a scene that it shares.
    pub fn of_scene(scene: Arc<Scene>) -> Self {
        let mode = Mode::at_start(&scene);
        let beta: Vec<R> =
            scene.bodies.iter().map(|body| R::constant(body.hinge.start.angle)).collect();
        let tree = WeldedTree::new(&scene, &mode, &beta);
        Self::of_tree(scene, &mode, tree)
    }

    /// Changes the mode; `beta` has the angle of every hinge of the scene \[rad\], of which those
    /// of the held ones are built in. Rotors [go on](Self::spin_from) from the speeds with which
    /// the scene starts.
    pub fn set_mode(&mut self, mode: &Mode, beta: &[R]) {
        self.tree.weld(&self.scene, mode, beta);
        self.elements.set(&self.scene, mode, &self.tree);
        self.take_up_tree();
    }

    /// Changes to a mode of another scene, as [`set_mode`](Self::set_mode) does to one of the same.
    pub fn set_scene(&mut self, scene: &Arc<Scene>, mode: &Mode, beta: &[R]) {
        self.scene = Arc::clone(scene);
        self.set_mode(mode, beta);
    }

    /// The scene.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    fn of_tree(scene: Arc<Scene>, mode: &Mode, tree: WeldedTree<R>) -> Self {
        let mut recursive = Self {
            elements: Elements::new(&scene, mode, &tree),
            rotors: (R::zero(), Vec::new()),
            constants: Vec::new(),
            free: Vec::new(),
            poses: Vec::new(),
            hinges: Vec::new(),
            base: BaseFactor::unset(),
            articulated: Vec::new(),
            composite: Vec::new(),
            omegas: Vec::new(),
            twists: Vec::new(),
            wrenches: Vec::new(),
            scene,
            tree,
        };
        recursive.take_up_tree();
        recursive
    }

    /// Makes ready what follows from the tree.
    fn take_up_tree(&mut self) {
        let Self { scene, tree, rotors: (since, motions), constants, free, .. } = self;
        *since = R::constant(scene.initial.time);
        motions.clear();
        motions.extend(tree.rotors.iter().map(|rotor| rotor.motion));
        constants.clear();
        constants.extend(tree.links.iter().map(LinkConstants::new));
        free.clear();
        free.extend(tree.links.iter().map(|link| link.hinge));
        let links = tree.links.len();
        self.poses.clear();
        self.poses.resize(links, LinkPose::unset());
        self.hinges.resize(links, HingeFactor::unset());
        self.articulated.resize(links, ArticulatedInertia::of(&RigidInertia::zero()));
        self.composite.resize(links, RigidInertia::zero());
        self.omegas.resize(links, Vec3::zero());
        self.twists.resize(links, Twist::zero());
        self.wrenches.resize(links, Wrench::zero());
    }

    /// Holds `commands` in place of those that were held, until the mode is set anew.
    pub fn command(&mut self, commands: &Commands) {
        self.elements.command(commands);
    }

    /// The hinges that turn in this mode, as numbered in the scene, ascending.
    pub fn free_hinges(&self) -> &[usize] {
        &self.free
    }

    /// Where a hinge stands among those, if it does.
    pub fn position_of(&self, hinge: usize) -> Option<usize> {
        self.free.binary_search(&hinge).ok()
    }

    /// The tree of links of this mode.
    pub fn tree(&self) -> &WeldedTree<R> {
        &self.tree
    }

    /// The force elements as they act in this mode.
    pub fn elements(&self) -> &Elements<R> {
        &self.elements
    }

    /// Whether [`acting_on_main_body`](Self::acting_on_main_body) is anything.
    pub fn acts_on_main_body(&self) -> bool {
        let acts = self.tree.has_rotors() || self.elements.acts_from_outside();
        self.tree.held.map_or(acts, |held| held != Twist::zero())
    }

    /// All that acts from outside and the [moment](nboom_model::Spin::moment) of the rotors of the
    /// main body at the rate `omega_body`, about O, main-body axes: what belongs to the motion of
    /// the main body beside the [generalised forces](Self::hinge_forces) of the hinges, in the
    /// posture in which they were asked for. Of a main body that is held it is
    /// the [wrench that holds it](WeldedTree::holding_wrench).
    pub fn acting_on_main_body(&self, omega_body: Vec3<R>) -> Wrench<R> {
        if let Some(holding) = self.tree.holding_wrench() {
            return holding;
        }
        let mut acting = self.acting_from_outside();
        if let Some(spin) = self.tree.main_spin {
            acting.moment -= spin.moment(omega_body);
        }
        acting
    }

    /// Accelerations by articulated bodies: ω̇, a_O without gravity, τ̇.
    #[inline(always)]
    pub fn accelerations(&mut self, motion: &Motion<'_, R>, out: &mut Accelerations<R>) {
        self.accelerations_with(|_, _| {}, motion, out);
    }

    /// [Accelerations](Self::accelerations) with further torques: `add` adds them to those about
    /// the free hinges, which it gets with their numbers in the scene.
    #[inline(always)]
    pub fn accelerations_with(
        &mut self,
        add: impl FnOnce(&[usize], &mut [R]),
        motion: &Motion<'_, R>,
        out: &mut Accelerations<R>,
    ) {
        self.factor(motion.beta);
        let main = self.load(motion, &mut out.tau_dot);
        add(&self.free, &mut out.tau_dot);
        let of_main = self.solve(main, self.tree.held, &mut out.tau_dot);
        out.omega_dot_body = of_main.angular;
        out.origin_body = of_main.linear;
    }

    /// Sets the accelerations of a main body that is held to what they are but for rounding.
    pub fn hold(&self, found: &mut Accelerations<R>) {
        if let Some(held) = self.tree.held {
            (found.omega_dot_body, found.origin_body) = (held.angular, held.linear);
        }
    }

    /// The kinetic-energy matrix B₀ of (V, ω, τ) by composite bodies: (6 + free)² entries, row
    /// by row.
    pub fn mass_matrix(&mut self, beta: &[R], out: &mut [R]) {
        self.place(beta);
        composite_body::mass_matrix(&self.tree, &self.poses, &mut self.composite, out);
    }

    /// The right side u₀ of B₀ (a_O, ω̇, τ̇) = u₀, gravity left out: 6 + free entries.
    pub fn forcing(&mut self, motion: &Motion<'_, R>, out: &mut [R]) {
        self.place(motion.beta);
        self.forcing_in_place(motion, out);
    }

    /// B₀ and u₀ of one motion, as [`mass_matrix`](Self::mass_matrix) and
    /// [`forcing`](Self::forcing) give them; the links are placed once.
    pub fn equations(&mut self, motion: &Motion<'_, R>, matrix: &mut [R], forcing: &mut [R]) {
        self.mass_matrix(motion.beta, matrix);
        self.forcing_in_place(motion, forcing);
    }

    fn forcing_in_place(&mut self, motion: &Motion<'_, R>, out: &mut [R]) {
        let (of_base, torques) = out.split_at_mut(6);
        let load = self.load(motion, torques);
        let (tree, poses) = (&self.tree, &self.poses);
        let main = composite_body::gather(tree, poses, &mut self.wrenches, load, torques);
        let (f, m) = (-main.force, -main.moment);
        of_base.copy_from_slice(&[f.x, f.y, f.z, m.x, m.y, m.z]);
    }

    /// Generalised forces conjugate to the free hinges' angles: torques about hinges, forces along
    /// lines, and what acts on links from outside, eqs. (6.1) and (6.17), corrected: note 5.
    ///
    /// The reaction of a line on the main body leaves no resultant, so nothing else of it enters
    /// the equations.
    #[inline(always)]
    pub fn hinge_forces(&mut self, motion: &Motion<'_, R>, out: &mut [R]) {
        let Self { elements, free, tree, constants, poses, .. } = self;
        elements.set_torques(free, [motion.beta, motion.tau], out);
        if elements.pushing().next().is_none() && elements.on_links().next().is_none() {
            return;
        }
        pose::place(tree, constants, motion.beta, poses);
        let inward = |link| std::iter::successors(Some(link), |&j: &usize| tree.links[j].inboard);
        for (link, line) in elements.pushing() {
            let (end, force) = line.end_and_force(poses);
            for j in inward(link) {
                let pose = &poses[j];
                out[j] += pose.along(&Wrench::of_force(end - pose.position, force));
            }
        }
        for (link, push) in elements.on_links() {
            let wrench = push.wrench(Some(&poses[link].rot));
            for j in inward(link) {
                let offset = poses[link].position - poses[j].position;
                out[j] += poses[j].along(&wrench.seen_from(offset));
            }
        }
        elements.withhold(poses, out);
    }

    #[inline(always)]
    pub(crate) fn place(&mut self, beta: &[R]) {
        pose::place(&self.tree, &self.constants, beta, &mut self.poses);
        pose::turn_inertias(&self.tree, beta, &mut self.poses);
    }

    #[inline(always)]
    pub(crate) fn factor(&mut self, beta: &[R]) {
        self.place(beta);
        let (tree, poses) = (&self.tree, &self.poses);
        self.base = articulated_body::factor(tree, poses, &mut self.articulated, &mut self.hinges);
    }

    /// (ω̇, a_O), which are `held` if something, and τ̇ from what acts against the main link, about
    /// O, the `wrenches` against all others, and the hinge torques in `tau_dot`.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        main: Wrench<R>,
        held: Option<Twist<R>>,
        tau_dot: &mut [R],
    ) -> Twist<R> {
        let Self { wrenches, twists, .. } = self;
        let load = Load { wrenches, main, held, tau_dot, twists };
        articulated_body::solve(&self.tree, &self.poses, &self.hinges, &self.base, load)
    }

    /// Sets `wrenches` and `torques` to what acts in this motion; returns the main link's share.
    #[inline(always)]
    fn load(&mut self, motion: &Motion<'_, R>, torques: &mut [R]) -> Wrench<R> {
        let mut main = articulated_body::bias(
            &self.tree,
            &self.poses,
            motion.omega_body,
            motion.tau,
            &mut self.omegas,
            &mut self.twists,
            &mut self.wrenches,
        );
        let Self { elements, free, poses, wrenches, .. } = self;
        elements.set_torques(free, [motion.beta, motion.tau], torques);
        for (link, line) in elements.pushing() {
            let (end, force) = line.end_and_force(poses);
            let arm = end - poses[link].position;
            wrenches[link].subtract(Wrench::of_force(arm, force));
            main.add(Wrench::of_force(line.main_body_point, force));
        }
        elements.withhold(poses, torques);
        for (link, push) in elements.on_links() {
            wrenches[link].subtract(push.wrench(Some(&poses[link].rot)));
        }
        if let Some(external) = elements.external() {
            main.subtract(external);
        }
        main
    }
}

impl Recursive<f64> {
    /// The same formulation of the same `mode`, which was set last, over numbers each of which holds several
    /// of `f64`.
    pub fn over<R: Real>(&self, mode: &Mode) -> Recursive<R> {
        Recursive::of_tree(Arc::clone(&self.scene), mode, WeldedTree::constant(&self.tree))
    }
}
