use nboom_scalar::{Real, Twist, Wrench};

use crate::{Accelerations, Motion, Recursive, articulated_body, composite_body};

impl<R: Real> Recursive<R> {
    /// What a held main body is held with, so that all move with these accelerations: force, and moment about
    /// O, main-body axes.
    ///
    /// It is the rate of change of the momenta, eqs. (8.7) and (8.12), about O without gravity, less what else
    /// [acts from outside](Self::set_outside).
    #[inline(always)]
    pub fn reaction(
        &mut self,
        motion: &Motion<'_, R>,
        accelerations: &Accelerations<R>,
    ) -> Wrench<R> {
        self.place(motion.beta);
        let Self { tree, poses, omegas, twists, wrenches, .. } = self;
        let Motion { omega_body, tau, .. } = *motion;
        let mut main =
            articulated_body::bias(tree, poses, omega_body, tau, omegas, twists, wrenches);
        let of_main =
            Twist { angular: accelerations.omega_dot_body, linear: accelerations.origin_body };
        main.add(tree.main.momentum(of_main));
        for (j, link) in tree.links.iter().enumerate() {
            let pose = &poses[j];
            twists[j] = link.inboard.map_or(of_main, |i| twists[i]).at(pose.offset);
            twists[j].add(pose.motion(accelerations.tau_dot[j]));
            wrenches[j].add(pose.inertia.momentum(twists[j]));
        }
        let mut net = composite_body::carry_inward(tree, poses, wrenches, main);
        net.subtract(self.acting_from_outside());
        net
    }
}
