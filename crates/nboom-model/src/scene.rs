use std::ops::{Deref, Range};

use nboom_scalar::{Sym3, Vec3};

use crate::{
    Appendage, Base, BodyName, Coupling, Departures, Errors, External, Gravity, Hinge, HingeLabel,
    InitialMotion, Joint, MassProperties, ModelError, ModelWarning, Mount, Rotor, Shapes,
    TorqueTable, check, warning,
};

/// One body of the tree with the hinge that joins it to its inboard body.
///
/// Its origin is a point on the hinge axis. Its axes stand parallel to the hinge axes of `mount`
/// when the hinge angle is zero, and turn about `axis` by the hinge angle. A body that slides keeps
/// its axes, and its origin moves along `axis` by the travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Index of the inboard body; `None` is the main body.
    pub inboard: Option<usize>,
    /// Where the hinge sits on the inboard body.
    pub mount: Mount,
    /// Whether it turns about the axis or slides along it.
    pub joint: Joint,
    /// Unit vector along the hinge axis, body axes.
    pub axis: Vec3<f64>,
    /// Mass properties, from the hinge, body axes.
    pub mass_properties: MassProperties,
    /// The outer end, from the hinge, body axes; no motion depends on it.
    pub tip: Vec3<f64>,
    /// What acts about the hinge and when it is released and locks.
    pub hinge: Hinge,
}

/// A scene as written, not yet checked.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDescription {
    /// Name, used for output folders.
    pub name: String,
    /// The main body, from O.
    pub main_body: MassProperties,
    /// How it is held.
    pub base: Base,
    /// The hinged bodies, branch by branch, inboard before outboard.
    pub bodies: Vec<Body>,
    /// Torques over an angle, beside those of spring and dashpot; at most one about a hinge.
    pub torque_tables: Vec<TorqueTable>,
    /// Springs and dampers between two hinges.
    pub couplings: Vec<Coupling>,
    /// Rotors whose speeds are commanded.
    pub rotors: Vec<Rotor>,
    /// Uniform gravity.
    pub gravity: Option<Gravity>,
    /// Forces and torques from outside.
    pub externals: Vec<External>,
    /// Motion of the main body at the initial time.
    pub initial: InitialMotion,
    /// Time at which the run ends \[T\].
    pub end_time: f64,
}

impl SceneDescription {
    /// A main body alone, at rest at the inertial origin at time zero.
    pub fn at_rest(name: &str, main_body: MassProperties, end_time: f64) -> Self {
        Self {
            name: name.to_owned(),
            main_body,
            base: Base::Free,
            bodies: Vec::new(),
            torque_tables: Vec::new(),
            couplings: Vec::new(),
            rotors: Vec::new(),
            gravity: None,
            externals: Vec::new(),
            initial: InitialMotion::at_rest(),
            end_time,
        }
    }

    /// The initial piece of each force law that has several. For each kick-off spring, by hinge, it
    /// is 1: the spring is beyond its limit length and does not push. Then, for each hinge with friction, it is
    /// [that of its rate](piece_of_friction) at the start. Then, for each torque table, it is the number of its points
    /// below the angle at which its hinge starts.
    pub fn pieces_at_rest(&self) -> Vec<usize> {
        let springs = self.bodies.iter().filter_map(|body| body.hinge.kick_off).map(|_| 1);
        let tables = self.torque_tables.iter().map(|table| {
            let start = self.bodies.get(table.hinge).map_or(0.0, |body| body.hinge.start.angle);
            table.points.iter().filter(|[angle, _]| *angle < start).count()
        });
        let frictions = self.hinges_with_friction();
        let frictions = frictions.map(|i| piece_of_friction(self.bodies[i].hinge.start.rate));
        springs.chain(frictions).chain(tables).collect()
    }

    /// The places of friction among the pieces of a mode, in the order of
    /// [`hinges_with_friction`](Self::hinges_with_friction): after those of kick-off springs.
    pub fn friction_pieces(&self) -> Range<usize> {
        let first = self.bodies.iter().filter(|body| body.hinge.kick_off.is_some()).count();
        first..first + self.hinges_with_friction().count()
    }

    /// The hinges with friction, ascending.
    pub fn hinges_with_friction(&self) -> impl Iterator<Item = usize> {
        let has_friction = |(i, body): (usize, &Body)| (body.hinge.friction > 0.0).then_some(i);
        self.bodies.iter().enumerate().filter_map(has_friction)
    }

    /// The forces and torques from outside that act on hinged bodies.
    pub fn externals_on_hinged(&self) -> impl Iterator<Item = &External> {
        self.externals.iter().filter(|external| external.body.is_some())
    }

    /// The rotors in hinged bodies.
    pub fn rotors_in_hinged(&self) -> impl Iterator<Item = &Rotor> {
        self.rotors.iter().filter(|rotor| rotor.body.is_some())
    }

    /// Gives a main body that is driven the angular rate and the velocity of its prescribed motion
    /// at the initial time and attitude, each unless it is `given`.
    pub fn begin_driven(&mut self, given: [bool; 2]) {
        let Some(drive) = self.base.drive().filter(|drive| !drive.points.is_empty()) else {
            return;
        };
        let [rate, speed] = drive.rates_at(self.initial.time);
        let [omega_body, along] = [drive.axis * rate, drive.axis * speed];
        let velocity = self.initial.attitude.normalized().to_matrix() * along;
        if !given[0] {
            self.initial.omega_body = omega_body;
        }
        if !given[1] {
            self.initial.velocity_inertial = velocity;
        }
    }

    /// Adds the bodies of one more appendage.
    pub fn attach(&mut self, appendage: &Appendage) {
        self.bodies.extend(appendage.bodies(self.bodies.len()));
    }
}

/// A scene that has been checked: masses are positive, inertias physical, numbers finite and
/// references valid.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    description: SceneDescription,
    labels: Vec<HingeLabel>,
    /// Which hinges add to the angle of their inboard hinge.
    adding: Vec<bool>,
    shapes: Shapes,
    departures: Departures,
}

impl Scene {
    /// Checks a description. What acts from outside, a kick-off spring or a coupling that never
    /// exerts a force is left out.
    ///
    /// # Errors
    /// Everything that is wrong with it, not only the first.
    pub fn new(description: SceneDescription) -> Result<Self, Errors<ModelError>> {
        let labels = labels(&description.bodies);
        Self::labelled(description, labels)
    }

    fn labelled(
        mut description: SceneDescription,
        labels: Vec<HingeLabel>,
    ) -> Result<Self, Errors<ModelError>> {
        for body in &mut description.bodies {
            let kick_off = &mut body.hinge.kick_off;
            *kick_off = kick_off.filter(|spring| spring.coefficients != [0.0; 4]);
        }
        description.couplings.retain(|coupling| !coupling.is_nothing());
        let errors = check::find(&description, &labels);
        description.externals.retain(|external| !external.is_nothing());
        if !errors.is_empty() {
            return Err(Errors(errors));
        }
        let (shapes, departures) = (Shapes::default(), Departures::default());
        let bodies = &description.bodies;
        let adding = bodies.iter().map(|body| adds_to_inboard_angle(bodies, body)).collect();
        Ok(Self { description, labels, adding, shapes, departures })
    }

    /// The scene with another end of the run.
    ///
    /// # Errors
    /// When that time is not finite or before the initial one.
    pub fn ending_at(&self, end_time: f64) -> Result<Self, Errors<ModelError>> {
        self.with_description(SceneDescription { end_time, ..self.description.clone() })
    }

    /// The scene with another description of the same bodies, whose names, shapes and departures stay.
    ///
    /// # Errors
    /// Everything that is wrong with it, not only the first.
    ///
    /// # Panics
    /// When it has not as many bodies.
    pub fn with_description(
        &self,
        description: SceneDescription,
    ) -> Result<Self, Errors<ModelError>> {
        assert_eq!(description.bodies.len(), self.bodies.len(), "the bodies are the same");
        let mut labels = labels(&description.bodies);
        for (label, named) in labels.iter_mut().zip(&self.labels) {
            label.name.clone_from(&named.name);
        }
        let Self { labels, adding, description, .. } = Self::labelled(description, labels)?;
        Ok(Self { description, labels, adding, ..self.clone() })
    }

    /// The scene under another name.
    #[must_use]
    pub fn called(mut self, name: String) -> Self {
        self.description.name = name;
        self
    }

    /// Names the hinged bodies, for people.
    ///
    /// # Panics
    /// When there is not one name for each.
    #[must_use]
    pub fn with_names(mut self, names: Vec<String>) -> Self {
        assert_eq!(names.len(), self.bodies.len(), "one name for each body");
        for (label, name) in self.labels.iter_mut().zip(names) {
            label.name = Some(name.into());
        }
        self
    }

    /// The name of hinged body `i`, if it has one.
    pub fn name_of(&self, i: usize) -> Option<&str> {
        self.labels.get(i)?.name.as_deref()
    }

    /// Gives bodies shapes, for pictures.
    #[must_use]
    pub fn with_shapes(self, mut shapes: Shapes) -> Self {
        // Scenes that look alike are equal.
        while let Some(None) = shapes.bodies.last() {
            shapes.bodies.pop();
        }
        Self { shapes, ..self }
    }

    /// The shapes of the bodies that have one.
    pub fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    /// Replaces the departures of the scene's motion.
    ///
    /// # Panics
    /// When they name a body or hinge that it has not.
    #[must_use]
    pub fn with_departures(self, departures: Departures) -> Self {
        let count = self.bodies.len();
        assert!(departures.named().all(|i| i < count), "departures are of the scene");
        Self { departures, ..self }
    }

    /// The departures of the motion from that of rigid bodies under the scene's forces.
    pub fn departures(&self) -> &Departures {
        &self.departures
    }

    /// The scene with a main body that moves freely; without gravity, if it was held, since only what holds a
    /// main body makes gravity act on what hangs on it.
    #[must_use]
    pub fn with_free_main_body(mut self) -> Self {
        if self.description.base.is_held() {
            self.description.base = Base::Free;
            self.description.gravity = None;
        }
        self
    }

    /// What is allowed but probably not meant.
    pub fn warnings(&self) -> Vec<ModelWarning> {
        warning::find(self)
    }

    /// What users call hinge `i`.
    pub fn label(&self, i: usize) -> HingeLabel {
        self.labels[i].clone()
    }

    /// What users call the hinges.
    pub fn labels(&self) -> &[HingeLabel] {
        &self.labels
    }

    /// What messages call a hinged body, or the main body.
    pub fn body_name(&self, body: Option<usize>) -> BodyName {
        body.map_or(BodyName::MainBody, |body| BodyName::Segment(self.label(body)))
    }

    /// Six of a main body that moves freely, and one for each hinge, whether it is held or free.
    pub fn degrees_of_freedom(&self) -> usize {
        let of_main_body = if self.description.base.is_held() { 0 } else { 6 };
        of_main_body + self.description.bodies.len()
    }

    /// Mass of all bodies, m_T.
    pub fn total_mass(&self) -> f64 {
        let hinged = self.description.bodies.iter().map(|body| body.mass_properties.mass);
        self.description.main_body.mass + hinged.sum::<f64>()
    }

    /// The natural size of a change of β of hinge `i`: a radian, or where it slides the way from
    /// its start to its latch, without a latch the size of its body.
    pub fn coordinate_scale(&self, i: usize) -> f64 {
        let Body { joint, hinge, tip, mass_properties, mount, .. } = &self.description.bodies[i];
        if !joint.slides() {
            return 1.0;
        }
        let start = hinge.start.angle;
        let of_latch = hinge.lock_angle.map_or(0.0, |latch| (latch - start).abs());
        let of_body = [*tip, mass_properties.center_of_mass, mount.point].map(Vec3::norm);
        let sizes = [of_latch, start.abs(), of_body[0], of_body[1], of_body[2]];
        sizes.into_iter().find(|&size| size > 0.0).unwrap_or(1.0)
    }

    /// What the rotors of a hinged body, or of the main body, add to its inertia, body axes.
    pub fn rotor_inertia_of(&self, body: Option<usize>) -> Sym3<f64> {
        Rotor::inertia_of(&self.description.rotors, body)
    }

    /// Whether hinge `i` turns about an axis parallel to its inboard hinge, so that the angles
    /// of the two add up to α.
    pub fn adds_to_inboard_angle(&self, i: usize) -> bool {
        self.adding[i]
    }

    /// The arm, if body `i` is a paddle: hinged to a body of the main body, about another axis.
    pub fn arm_of_paddle(&self, i: usize) -> Option<usize> {
        let bodies = &self.description.bodies;
        let inboard = bodies[i].inboard.filter(|&inboard| bodies[inboard].inboard.is_none());
        let turn = |inboard| [i, inboard].into_iter().all(|i: usize| !bodies[i].joint.slides());
        inboard.filter(|&inboard| turn(inboard) && !self.adds_to_inboard_angle(i))
    }

    /// Sums along each appendage of hinge angles β or rates τ, in place: α or σ.
    pub fn accumulate_along_appendages(&self, values: &mut [f64]) {
        for i in 0..values.len() {
            if let (true, Some(inboard)) =
                (self.adds_to_inboard_angle(i), self.description.bodies[i].inboard)
            {
                values[i] += values[inboard];
            }
        }
    }
}

impl Deref for Scene {
    type Target = SceneDescription;

    fn deref(&self) -> &SceneDescription {
        &self.description
    }
}

fn adds_to_inboard_angle(bodies: &[Body], body: &Body) -> bool {
    body.inboard.is_some_and(|inboard| {
        let inboard = &bodies[inboard];
        let turn = [body.joint, inboard.joint] == [Joint::Revolute; 2];
        let axis_inboard = body.mount.rot_inboard_from_hinge * body.axis;
        turn && (axis_inboard - inboard.axis).norm() < 1e-9
    })
}

fn labels(bodies: &[Body]) -> Vec<HingeLabel> {
    let mut labels = Vec::with_capacity(bodies.len());
    let (mut appendages, mut segment) = (0, 0);
    for body in bodies {
        if body.inboard.is_none() {
            appendages += 1;
            segment = 0;
        }
        let label = HingeLabel::new(appendages.max(1) - 1, segment);
        labels.push(HingeLabel { joint: body.joint, ..label });
        segment += 1;
    }
    labels
}

/// The piece of friction that holds at a rate: 0 below zero, 1 above it, and 2 at rest, where what friction does
/// depends on all that acts.
pub fn piece_of_friction(rate: f64) -> usize {
    match rate {
        down if down < 0.0 => 0,
        up if up > 0.0 => 1,
        _ => 2,
    }
}
