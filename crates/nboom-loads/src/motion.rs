use nboom_scalar::Vec3;

/// Change of the velocities of a scene: per unit of time, accelerations; at a lock-up, jumps.
#[derive(Clone, Copy, Debug)]
pub struct VelocityChange<'a> {
    /// Of V, the inertial velocity of O, main-body axes; an acceleration without that of
    /// gravity \[L/T², L/T\].
    pub origin_body: Vec3<f64>,
    /// Of ω, main-body axes \[rad/T², rad/T\].
    pub omega_body: Vec3<f64>,
    /// Of τ, one entry for each hinge of the scene, zero for held ones \[rad/T², rad/T\].
    pub tau: &'a [f64],
}

/// The motion of a scene at one time; slices have one entry for each hinge of the scene.
#[derive(Clone, Copy, Debug)]
pub struct SceneMotion<'a> {
    /// ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<f64>,
    /// β \[rad\].
    pub beta: &'a [f64],
    /// τ, zero for held hinges \[rad/T\].
    pub tau: &'a [f64],
    /// Accelerations.
    pub acceleration: VelocityChange<'a>,
    /// Whether the kick-off spring of each hinge pushes.
    pub kick_off: &'a [bool],
}

/// What one of the hinges that lock in an instant contributes to it.
#[derive(Clone, Copy, Debug)]
pub struct LockUpShare<'a> {
    /// c of the hinge: impulse over peak of its pulse \[T\], positive.
    pub pulse_constant: f64,
    /// The jump of all velocities by the impulsive torque of this hinge alone; the jump of the
    /// instant is the sum over the hinges that lock.
    pub jump: VelocityChange<'a>,
}
