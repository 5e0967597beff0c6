use nboom_scalar::{Real, Vec3};

/// Change of the velocities of a scene: per unit of time, accelerations; at a lock-up or an impact, jumps.
#[derive(Clone, Copy, Debug)]
pub struct VelocityChange<'a, R = f64> {
    /// Of V, the inertial velocity of O, main-body axes; an acceleration without that of
    /// gravity \[L/T², L/T\].
    pub origin_body: Vec3<R>,
    /// Of ω, main-body axes \[rad/T², rad/T\].
    pub omega_body: Vec3<R>,
    /// Of τ, one entry for each hinge of the scene, zero for held ones \[rad/T², rad/T\].
    pub tau: &'a [R],
}

/// Of how many hinges, forces and torques from outside on hinged bodies, and rotors in hinged
/// bodies a motion is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotionSize {
    /// Hinges.
    pub hinges: usize,
    /// Forces and torques from outside on hinged bodies.
    pub externals: usize,
    /// Rotors in hinged bodies.
    pub rotors: usize,
}

impl MotionSize {
    /// How many numbers such a motion is.
    pub fn count(self) -> usize {
        9 + 4 * self.hinges + 3 * self.externals + 2 * self.rotors
    }
}

/// The motion of a scene at one time; slices have one entry for each hinge of the scene.
#[derive(Clone, Copy, Debug)]
pub struct SceneMotion<'a, R = f64> {
    /// ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<R>,
    /// β \[rad\].
    pub beta: &'a [R],
    /// τ, zero for held hinges \[rad/T\].
    pub tau: &'a [R],
    /// Accelerations.
    pub acceleration: VelocityChange<'a, R>,
    /// Force along the line from the main body to the body of each hinge over its length, its force
    /// density; zero where none acts \[F/L\].
    pub force_densities: &'a [R],
    /// The forces and torques from outside on hinged bodies, as the scene lists them; zero where
    /// one does not act. Body axes, or main-body axes where it is given along inertial ones \[F,
    /// FL\].
    pub outside: &'a [[R; 3]],
    /// Speed relative to its body, and the rate of change of that, of each rotor in a hinged body,
    /// as the scene lists them \[rad/T, rad/T²\].
    pub rotors: &'a [[R; 2]],
}

impl<'a, R: Real> SceneMotion<'a, R> {
    /// The motion in a row of numbers: ω, the acceleration of O, ω̇, then β, τ, τ̇ and the force
    /// densities of all hinges, then what acts from outside, then the rotors.
    ///
    /// # Panics
    /// When there are not [`count`](MotionSize::count) of them.
    pub fn of_numbers(numbers: &'a [R], size: MotionSize) -> Self {
        assert_eq!(numbers.len(), size.count(), "one number for each quantity");
        let MotionSize { hinges, externals, .. } = size;
        let (outside, rotors) = numbers[9 + 4 * hinges..].split_at(3 * externals);
        let vector = |at: usize| Vec3::new(numbers[at], numbers[at + 1], numbers[at + 2]);
        let of_hinges = |row: usize| &numbers[9 + row * hinges..9 + (row + 1) * hinges];
        Self {
            omega_body: vector(0),
            beta: of_hinges(0),
            tau: of_hinges(1),
            acceleration: VelocityChange {
                origin_body: vector(3),
                omega_body: vector(6),
                tau: of_hinges(2),
            },
            force_densities: of_hinges(3),
            outside: outside.as_chunks().0,
            rotors: rotors.as_chunks().0,
        }
    }

    /// Writes the row that [`of_numbers`](Self::of_numbers) reads.
    ///
    /// # Panics
    /// When a slice has another length than it should.
    pub fn write(&self, numbers: &mut [R]) {
        let VelocityChange { origin_body, omega_body, tau } = self.acceleration;
        let vectors = [self.omega_body, origin_body, omega_body];
        let (of_vectors, of_hinges) = numbers.split_at_mut(9);
        for (place, vector) in of_vectors.chunks_exact_mut(3).zip(vectors) {
            place.copy_from_slice(&vector.to_array());
        }
        let hinges = self.beta.len();
        let (of_hinges, rest) = of_hinges.split_at_mut(4 * hinges);
        let (outside, rotors) = rest.split_at_mut(3 * self.outside.len());
        outside.copy_from_slice(self.outside.as_flattened());
        rotors.copy_from_slice(self.rotors.as_flattened());
        for (row, values) in [self.beta, self.tau, tau, self.force_densities].iter().enumerate() {
            of_hinges[row * hinges..(row + 1) * hinges].copy_from_slice(values);
        }
    }
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
