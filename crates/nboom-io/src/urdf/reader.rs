//! What elements of a document say.

use nboom_model::MassProperties;
use nboom_scalar::{Mat3, Sym3, Vec3};
use roxmltree::Node;

use super::lines::Lines;
use super::namespace::{attribute, elements, value};
use crate::diagnostic::{Report, quoted};

/// Reads elements of a document, and reports what is wrong with them.
pub(super) struct Reader<'r, 'd, 'f> {
    pub lines: &'d Lines<'d>,
    pub report: &'r mut Report<'f>,
}

/// Where a frame is in another one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub point: Vec3<f64>,
    /// Turns components of the frame into those of the other one.
    pub rot: Mat3<f64>,
}

/// What a link says of its mass, in its own frame, and the bytes at which it does.
pub(super) struct Inertial {
    pub body: MassProperties,
    pub mass_at: usize,
    pub inertia_at: usize,
}

impl Placement {
    pub fn none() -> Self {
        Self { point: Vec3::zero(), rot: Mat3::identity() }
    }

    /// Where a frame is that is placed so in this one.
    pub fn then(&self, inner: &Self) -> Self {
        Self { point: self.point + self.rot * inner.point, rot: self.rot * inner.rot }
    }

    /// A body of this frame, seen from the other one.
    pub fn of_body(&self, body: &MassProperties) -> MassProperties {
        let center = self.point + self.rot * body.center_of_mass;
        MassProperties::new(body.mass, center, body.inertia.rotated(&self.rot))
    }
}

impl<'d> Reader<'_, 'd, '_> {
    pub fn error(&mut self, node: Node<'d, 'd>, symbol: &str, found: &str, expected: &str) {
        self.error_at(node.range().start, symbol, found, expected);
    }

    /// An error at a byte of the text.
    pub fn error_at(
        &mut self,
        at: usize,
        symbol: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        self.report.error(self.lines.position(at), symbol, found, expected);
    }

    /// The child of this tag, with attributes that it has; a second one is an error.
    pub fn child(&mut self, node: Node<'d, 'd>, tag: &str) -> Option<Node<'d, 'd>> {
        let mut children = elements(node).filter(|child| child.tag_name().name() == tag);
        let first = children.next();
        if let Some(second) = children.next() {
            self.error(second, tag, &format!("a second `{tag}`"), "one");
        }
        if let Some(first) = first {
            self.check_attributes(first);
        }
        first
    }

    /// An attribute that must be there.
    pub fn text(&mut self, node: Node<'d, 'd>, name: &str) -> Option<&'d str> {
        let found = value(node, name);
        if found.is_none() {
            let tag = node.tag_name().name();
            self.error(node, name, &format!("`{tag}` without `{name}`"), "one");
        }
        found
    }

    /// The numbers of an attribute, if it is there.
    pub fn numbers<const N: usize>(&mut self, node: Node<'d, 'd>, name: &str) -> Option<[f64; N]> {
        let attribute = attribute(node, name)?;
        let words: Vec<&str> = attribute.value().split_ascii_whitespace().take(N + 1).collect();
        let number = |word: &&str| word.parse::<f64>().ok().filter(|x| x.is_finite());
        let numbers: Option<Vec<f64>> = words.iter().map(number).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        if numbers.is_none() {
            let at = attribute.range().start;
            let found = quoted(attribute.value());
            let expected =
                if N == 1 { "a finite number".to_owned() } else { format!("{N} finite numbers") };
            self.error_at(at, name, found, expected);
        }
        numbers
    }

    /// Reports attributes that are no numbers, though none of them is taken over.
    pub fn check_numbers<const N: usize>(&mut self, node: Node<'d, 'd>, names: [&str; N]) {
        for name in names {
            let _: Option<[f64; 1]> = self.numbers(node, name);
        }
    }

    /// A number that must be there; what is reported is zero.
    pub fn number(&mut self, node: Node<'d, 'd>, name: &str) -> f64 {
        if self.text(node, name).is_none() {
            return 0.0;
        }
        self.numbers(node, name).map_or(0.0, |[number]| number)
    }

    /// What `origin` says of where a frame is; nothing is no change.
    pub fn placement(&mut self, node: Node<'d, 'd>) -> Placement {
        let Some(origin) = self.child(node, "origin") else { return Placement::none() };
        let mut three = |name: &str| self.numbers(origin, name).unwrap_or([0.0; 3]);
        let ([x, y, z], [roll, pitch, yaw]) = (three("xyz"), three("rpy"));
        let about = |axis: Vec3<f64>, angle: f64| Mat3::about_axis(axis, angle);
        let rot =
            about(Vec3::unit_z(), yaw) * about(Vec3::unit_y(), pitch) * about(Vec3::unit_x(), roll);
        Placement { point: Vec3::new(x, y, z), rot }
    }

    /// What `inertial` says of a link, in its frame.
    pub fn inertial(&mut self, link: Node<'d, 'd>) -> Option<Inertial> {
        let inertial = self.child(link, "inertial")?;
        let placement = self.placement(inertial);
        let mass = self.child(inertial, "mass");
        let tensor = self.child(inertial, "inertia");
        for (child, tag) in [(mass, "mass"), (tensor, "inertia")] {
            if child.is_none() {
                self.error(inertial, tag, &format!("`inertial` without `{tag}`"), "one");
            }
        }
        let (mass, tensor) = (mass?, tensor?);
        let (mass_at, inertia_at) = (mass.range().start, tensor.range().start);
        let mass = self.number(mass, "value");
        let [xx, xy, xz] = ["ixx", "ixy", "ixz"].map(|name| self.number(tensor, name));
        let [yy, yz, zz] = ["iyy", "iyz", "izz"].map(|name| self.number(tensor, name));
        let inertia = Sym3 { xx, yy, zz, xy, xz, yz };
        let body = placement.of_body(&MassProperties::new(mass, Vec3::zero(), inertia));
        Some(Inertial { body, mass_at, inertia_at })
    }
}
