use nboom_dynamics::{Invariants, Motion, Recursive};
use nboom_elements::Coordinate;
use nboom_model::{Mode, RotorMotion, Scene};
use nboom_scalar::{Number, Quaternion, Vec3};

/// The motion at one time, with everything that is not integrated filled in.
#[derive(Clone, Debug)]
pub(crate) struct State<R = f64> {
    pub time: R,
    pub attitude: Quaternion<R>,
    pub omega_body: Vec3<R>,
    /// β of every hinge.
    pub beta: Vec<R>,
    /// τ of every hinge; zero where held.
    pub tau: Vec<R>,
    /// The system mass centre, inertial axes.
    pub center: PointMotion<R>,
    /// O of a main body that is held, inertial axes.
    pub held: Option<PointMotion<R>>,
    /// Of every rotor.
    pub rotors: Vec<RotorMotion<R>>,
    pub work: Work<R>,
    pub momenta: Momenta<R>,
    /// Room for β and τ of the free hinges.
    free: [Vec<R>; 2],
}

/// Momenta as they were integrated; none of those that were not. No impulse at a hinge changes them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Momenta<R = f64> {
    /// H̄_c, inertial axes.
    pub angular_inertial: Option<Vec3<R>>,
    /// π of every hinge.
    pub hinges: Vec<Option<R>>,
}

impl<R: Number> Momenta<R> {
    fn of_none(hinges: usize) -> Self {
        Self { angular_inertial: None, hinges: vec![None; hinges] }
    }

    /// Leaves none.
    pub fn forget(&mut self) {
        self.angular_inertial = None;
        self.hinges.fill(None);
    }
}

/// Position and velocity of a point, inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointMotion<R = f64> {
    pub position: Vec3<R>,
    pub velocity: Vec3<R>,
}

/// What forces without a potential have done since the initial time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Work<R = f64> {
    /// Work of the rate-dependent hinge torques.
    pub dashpots: R,
    /// Work of friction until the mode began.
    pub friction: R,
    /// Work of what acts from outside, and of what moves a main body that is held.
    pub thrust: R,
    /// Work on what carries rotors of the moments by which their motors push off from it to speed
    /// them up.
    pub spin_up: R,
    /// Impulse of the thrust, inertial axes.
    pub thrust_impulse: Vec3<R>,
    /// Angular impulse of the thrust about the mass centre, inertial axes.
    pub thrust_angular_impulse: Vec3<R>,
    /// Kinetic energy taken away by lock-ups and impacts.
    pub lock_ups: R,
}

impl<R: Number> Work<R> {
    pub fn none() -> Self {
        Self {
            dashpots: R::zero(),
            friction: R::zero(),
            thrust: R::zero(),
            spin_up: R::zero(),
            thrust_impulse: Vec3::zero(),
            thrust_angular_impulse: Vec3::zero(),
            lock_ups: R::zero(),
        }
    }
}

impl<R: Number> State<R> {
    /// The initial state of `scene`, but for the mass centre, which is put at O.
    pub fn initial(scene: &Scene) -> Self {
        let hinges = scene.bodies.len();
        let mut state = Self {
            time: R::zero(),
            attitude: Quaternion { scalar: R::one(), vector: Vec3::zero() },
            omega_body: Vec3::zero(),
            beta: vec![R::zero(); hinges],
            tau: vec![R::zero(); hinges],
            center: PointMotion { position: Vec3::zero(), velocity: Vec3::zero() },
            held: None,
            rotors: Vec::with_capacity(scene.rotors.len()),
            work: Work::none(),
            momenta: Momenta::of_none(hinges),
            free: [Vec::with_capacity(hinges), Vec::with_capacity(hinges)],
        };
        state.begin(scene);
        state
    }

    /// Goes back to the [initial](Self::initial) state of `scene`, without allocation.
    pub fn begin(&mut self, scene: &Scene) {
        let initial = &scene.initial;
        let Quaternion { scalar, vector } = initial.attitude;
        let attitude =
            Quaternion { scalar: R::constant(scalar), vector: Vec3::constant(vector) }.normalized();
        self.time = R::constant(initial.time);
        self.attitude = from_non_negative_scalar(attitude);
        self.omega_body = Vec3::constant(initial.omega_body);
        let hinges = self.beta.iter_mut().zip(&mut self.tau).zip(&scene.bodies);
        for ((beta, tau), body) in hinges {
            let start = body.hinge.start;
            (*beta, *tau) = (R::constant(start.angle), R::constant(start.rate));
        }
        self.center = PointMotion {
            position: Vec3::constant(initial.position_inertial),
            velocity: Vec3::constant(initial.velocity_inertial),
        };
        self.held = scene.base.is_held().then_some(self.center);
        self.rotors.clear();
        self.rotors.extend(scene.rotors.iter().map(|rotor| {
            let speed = R::constant(rotor.speed.at(initial.time));
            RotorMotion { speed, acceleration: 0.0 }
        }));
        self.work = Work::none();
        self.momenta.forget();
    }

    /// Changes the speeds of the rotors from now on as their tables say in `mode`, and at the
    /// `commanded` rates beside where there are some.
    pub fn spin_up(&mut self, scene: &Scene, mode: &Mode, commanded: Option<&[f64]>) {
        let tables = scene.rotors.iter().zip(&mode.rotors);
        for (i, (motion, (rotor, &piece))) in self.rotors.iter_mut().zip(tables).enumerate() {
            let commanded = commanded.map_or(0.0, |rates| rates[i]);
            motion.acceleration = rotor.speed.acceleration(piece) + commanded;
        }
    }

    /// Whether a rotor changes its speed.
    pub fn spins_up(&self) -> bool {
        self.rotors.iter().any(|motion| motion.acceleration != 0.0)
    }

    /// Puts the mass centre where it belongs when O moves as `origin`; `dynamics` is in the mode of
    /// the state.
    pub fn put_center(&mut self, dynamics: &mut Recursive<R>, origin: PointMotion<R>) {
        self.center.velocity = Vec3::zero();
        let found = self.invariants(dynamics);
        let to_inertial = self.attitude.to_matrix();
        self.center = PointMotion {
            position: origin.position + to_inertial * found.mass_center,
            velocity: origin.velocity - to_inertial * found.origin_velocity,
        };
    }

    /// Puts the mass centre where the hinges carry it if the main body is held; `dynamics` is in
    /// the mode of the state.
    pub fn follow_hinges(&mut self, dynamics: &mut Recursive<R>) {
        if let Some(origin) = self.held {
            self.put_center(dynamics, origin);
        }
    }

    /// Makes it `other`, of the same scene, without allocation.
    pub fn copy_from(&mut self, other: &Self) {
        let Self { time, attitude, omega_body, beta, tau, center, held, .. } = other;
        let Self { rotors, work, momenta, .. } = other;
        (self.time, self.attitude, self.omega_body) = (*time, *attitude, *omega_body);
        (self.center, self.held, self.work) = (*center, *held, *work);
        self.beta.clone_from(beta);
        self.tau.clone_from(tau);
        self.rotors.clone_from(rotors);
        self.momenta.angular_inertial = momenta.angular_inertial;
        self.momenta.hinges.clone_from(&momenta.hinges);
    }

    /// What free fall, or the motion of a main body that is held, carries on: the mass centre, or
    /// O.
    pub fn carried(&self) -> PointMotion<R> {
        self.held.unwrap_or(self.center)
    }

    /// Energy and momenta in main-body axes; `dynamics` is in the mode of the state.
    pub fn invariants(&mut self, dynamics: &mut Recursive<R>) -> Invariants<R> {
        dynamics.turn_rotors(self.time);
        let to_inertial = self.attitude.to_matrix();
        let center_velocity = to_inertial.transpose() * self.center.velocity;
        dynamics.invariants(&self.motion(dynamics), center_velocity)
    }

    /// Length of a line and its rate.
    pub fn line_length(&self, dynamics: &Recursive<R>, line: usize) -> [R; 2] {
        let free = dynamics.free_hinges();
        let found = dynamics.line_length(line, |j| [self.beta[free[j]], self.tau[free[j]]]);
        let length = found.squared.sqrt();
        [length, found.squared_rate / (length + length)]
    }

    /// What the law of an element is a function of, and its rate; of a rate only itself, as a state has no
    /// accelerations.
    pub fn coordinate(&self, dynamics: &Recursive<R>, coordinate: Coordinate) -> [R; 2] {
        match coordinate {
            Coordinate::Length(line) => self.line_length(dynamics, line),
            Coordinate::Angle(hinge) => [self.beta[hinge], self.tau[hinge]],
            Coordinate::Rate(hinge) => [self.tau[hinge], R::zero()],
        }
    }

    /// The motion of the free hinges in the mode of `dynamics`.
    pub fn motion(&mut self, dynamics: &Recursive<R>) -> Motion<'_, R> {
        let Self { omega_body, beta, tau, free: [free_beta, free_tau], .. } = self;
        for (all, of_free) in [(beta, &mut *free_beta), (tau, &mut *free_tau)] {
            of_free.clear();
            of_free.extend(dynamics.free_hinges().iter().map(|&i| all[i]));
        }
        Motion { omega_body: *omega_body, beta: free_beta, tau: free_tau }
    }
}

impl<R: Number> PointMotion<R> {
    /// Where a constant `acceleration` takes it in `duration`.
    pub fn after(self, duration: R, acceleration: Vec3<R>) -> Self {
        let halfway = self.velocity + acceleration * (R::constant(0.5) * duration);
        Self {
            position: self.position + halfway * duration,
            velocity: self.velocity + acceleration * duration,
        }
    }
}

impl State {
    /// Length of a line.
    pub fn length_of(&self, dynamics: &Recursive<f64>, line: usize) -> f64 {
        let free = dynamics.free_hinges();
        dynamics.line_length_squared(line, |j| self.beta[free[j]]).sqrt()
    }
}

fn from_non_negative_scalar<R: Number>(q: Quaternion<R>) -> Quaternion<R> {
    let sign = R::constant(if q.scalar.to_f64() < 0.0 { -1.0 } else { 1.0 });
    Quaternion { scalar: q.scalar * sign, vector: q.vector * sign }
}
