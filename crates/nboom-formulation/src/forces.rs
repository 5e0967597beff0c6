use nboom_elements::{Elements, HingeLaw, KickOffLaw};
use nboom_model::WeldedTree;
use nboom_scalar::{Real, Vec3, Wrench};

use crate::embedding::Embedding;
use crate::parameters::Reader;
use crate::recognise::Recognised;
use crate::right_side::RightSideLayout;

/// Numbers of what acts on a satellite of chains and paddles in one mode, hinges in the topology's
/// order.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces<R> {
    /// The torque about each hinge.
    pub laws: Vec<HingeLaw<R>>,
    /// External wrench about O, main-body axes.
    pub external: Wrench<R>,
    /// The line that pushes the link of each hinge.
    pub lines: Vec<LinkLine<R>>,
}

/// A force along the line between a point of a link and one of the main body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkLine<R> {
    /// The end on the link, from the origin and along the axes in which the link's constants are
    /// written ([`LinkFrame`](crate::LinkFrame)).
    pub point: Vec3<R>,
    /// The end on the main body from O, main-body axes.
    pub main_body_point: Vec3<R>,
    /// The force by the line's length.
    pub law: KickOffLaw<R>,
}

/// The length of a line that does not push, 2⁴⁰⁰: no hinge angle makes it zero, and its square is a
/// number.
const FAR: f64 = f64::from_bits((1023 + 400) << 52);

impl<R: Real> LinkLine<R> {
    /// A line that does not push. Its end on the link is so far along ê₁ that its length never
    /// vanishes, and nothing is divided by zero.
    pub fn absent() -> Self {
        Self {
            point: Vec3::new(R::constant(FAR), R::zero(), R::zero()),
            main_body_point: Vec3::zero(),
            law: KickOffLaw::of_numbers([R::zero(); 4]),
        }
    }

    fn read<I: Iterator<Item = R>>(reader: &mut Reader<I>) -> Self {
        let (point, main_body_point) = (reader.vector(), reader.vector());
        let coefficients = [reader.next(), reader.next(), reader.next(), reader.next()];
        Self { point, main_body_point, law: KickOffLaw::of_numbers(coefficients) }
    }
}

impl<R: Real> Forces<R> {
    /// Nothing acts on a satellite of so many hinges.
    pub fn none(hinges: usize) -> Self {
        Self {
            laws: vec![HingeLaw::of_numbers([R::zero(); RightSideLayout::LAW]); hinges],
            external: Wrench::zero(),
            lines: vec![LinkLine::absent(); hinges],
        }
    }

    /// Reads what [`write`](Self::write) writes.
    pub fn read(hinges: usize, numbers: impl IntoIterator<Item = R>) -> Self {
        let mut reader = Reader(numbers.into_iter());
        let mut law = || HingeLaw::of_numbers(std::array::from_fn(|_| reader.next()));
        let laws = (0..hinges).map(|_| law()).collect();
        let external = Wrench { moment: reader.vector(), force: reader.vector() };
        let lines = (0..hinges).map(|_| LinkLine::read(&mut reader)).collect();
        Self { laws, external, lines }
    }

    /// The numbers in the order of [`RightSideLayout`]: q₁, q₂, A₂, A₁, A₀ of each hinge; external
    /// moment and force; of each line its end on the link, that on the main body, and a₀ to a₃.
    pub fn write(&self) -> Vec<R> {
        let mut numbers: Vec<R> = self.laws.iter().flat_map(HingeLaw::numbers).collect();
        numbers.extend(self.external.moment.to_array());
        numbers.extend(self.external.force.to_array());
        for LinkLine { point, main_body_point, law } in &self.lines {
            numbers.extend(point.to_array());
            numbers.extend(main_body_point.to_array());
            numbers.extend(law.numbers());
        }
        numbers
    }

    /// The numbers for the outer satellite of an embedding, on whose virtual links nothing acts.
    pub fn embedded(&self, embedding: &Embedding) -> Self {
        let mut outer = Self::none(embedding.outer().hinges());
        outer.external = self.external;
        for (&hinge, (law, line)) in
            embedding.hinges().iter().zip(self.laws.iter().zip(&self.lines))
        {
            (outer.laws[hinge], outer.lines[hinge]) = (*law, *line);
        }
        outer
    }
}

impl Forces<f64> {
    /// Those of `elements`, which act on `tree`, whose chains and paddles were `recognised`.
    ///
    /// `None` where a right side has no place for them: where a free hinge has a torque table, where
    /// two lines push one link, and where a line does not transmit all of its moment.
    pub fn of(
        elements: &Elements<f64>,
        tree: &WeldedTree<f64>,
        recognised: &Recognised,
    ) -> Option<Self> {
        if elements.withholds() {
            return None;
        }
        let mut forces = Self::none(recognised.links.len());
        for (law, &link) in forces.laws.iter_mut().zip(&recognised.links) {
            *law = *elements.torques()[tree.links[link].hinge].law()?;
        }
        if let Some(thrust) = elements.thrust() {
            forces.external = thrust.wrench;
        }
        for (link, line) in elements.pushing() {
            let hinge = recognised.links.iter().position(|&other| other == link)?;
            if forces.lines[hinge] != LinkLine::absent() {
                return None;
            }
            forces.lines[hinge] = LinkLine {
                point: recognised.frames[hinge].point(line.point),
                main_body_point: line.main_body_point,
                law: *line.law(),
            };
        }
        Some(forces)
    }
}
