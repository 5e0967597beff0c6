use nboom_elements::{Coupled, CoupledEnd, CouplingLaw, Elements, HingeLaw, KickOffLaw, Push};
use nboom_model::{LinkRotor, Shape, Topology, WeldedTree};
use nboom_scalar::{Mat3, Real, Vec3, Wrench};

use crate::embedding::Embedding;
use crate::no_place::NoPlace;
use crate::parameters::{Parameters, Reader};
use crate::pose::{self, LinkPlace};
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
    /// h̄: angular momentum of rotors on the main body relative to it, main-body axes; it is constant.
    pub spin: Vec3<R>,
    /// The lines that push the hinges' links, at the places of [`RightSideLayout::lines`]; empty
    /// where nothing pushes any.
    pub lines: Vec<LinkLine<R>>,
    /// The coupling of each hinge with the one inboard of it, this hinge first; empty where there is none.
    pub couplings: Vec<CouplingLaw<R>>,
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
            spin: Vec3::zero(),
            lines: vec![LinkLine::absent(); RightSideLayout::LINES_OF_LINK * hinges],
            couplings: vec![uncoupled(); hinges],
        }
    }

    fn line(&self, place: usize) -> LinkLine<R> {
        self.lines.get(place).copied().unwrap_or_else(LinkLine::absent)
    }

    /// The places of the lines that may push the link of a hinge.
    fn places(&self, hinge: usize) -> impl Iterator<Item = usize> + use<R> {
        let hinges = self.laws.len();
        (0..RightSideLayout::LINES_OF_LINK).map(move |number| hinges * number + hinge)
    }

    /// Reads what [`write`](Self::write) writes.
    pub fn read(hinges: usize, numbers: impl IntoIterator<Item = R>) -> Self {
        let mut reader = Reader(numbers.into_iter());
        let mut law = || HingeLaw::of_numbers(std::array::from_fn(|_| reader.next()));
        let laws = (0..hinges).map(|_| law()).collect();
        let external = Wrench { moment: reader.vector(), force: reader.vector() };
        let spin = reader.vector();
        let places = 0..RightSideLayout::LINES_OF_LINK * hinges;
        let lines = places.map(|_| LinkLine::read(&mut reader)).collect();
        let mut coupling = || CouplingLaw::of_numbers(std::array::from_fn(|_| reader.next()));
        let couplings = (0..hinges).map(|_| coupling()).collect();
        Self { laws, external, spin, lines, couplings }
    }

    /// The numbers in the order of [`RightSideLayout`]: q₁, q₂, A₃, A₂, A₁, A₀, β₀ of each hinge; external
    /// moment and force; h̄; of each line its end on the link, that on the main body, and a₀ to a₃; ρ₁, ρ₂, k, θ, c of each
    /// coupling.
    pub fn write(&self) -> Vec<R> {
        let mut numbers = Vec::new();
        self.write_at(self.laws.len(), Some, &mut numbers);
        numbers
    }

    /// Adds to `numbers` those for the outer satellite of an embedding, on whose virtual links nothing
    /// acts.
    pub fn write_embedded(&self, embedding: &Embedding, numbers: &mut Vec<R>) {
        let inner = |outer: usize| embedding.hinges().iter().position(|&hinge| hinge == outer);
        self.write_at(embedding.outer().hinges(), inner, numbers);
    }

    /// Adds the numbers for a satellite of so many hinges, each of which is one of these or none.
    fn write_at(
        &self,
        hinges: usize,
        inner: impl Fn(usize) -> Option<usize>,
        numbers: &mut Vec<R>,
    ) {
        for hinge in 0..hinges {
            let none = [R::zero(); RightSideLayout::LAW];
            numbers.extend(inner(hinge).map_or(none, |inner| self.laws[inner].numbers()));
        }
        numbers.extend(self.external.moment.to_array());
        numbers.extend(self.external.force.to_array());
        numbers.extend(self.spin.to_array());
        for number in 0..RightSideLayout::LINES_OF_LINK {
            for hinge in 0..hinges {
                let place = inner(hinge).map(|inner| self.laws.len() * number + inner);
                let line = place.map_or_else(LinkLine::absent, |place| self.line(place));
                numbers.extend(line.point.to_array());
                numbers.extend(line.main_body_point.to_array());
                numbers.extend(line.law.numbers());
            }
        }
        for hinge in 0..hinges {
            let coupling = inner(hinge).and_then(|inner| self.couplings.get(inner).copied());
            numbers.extend(coupling.unwrap_or_else(uncoupled).numbers());
        }
    }
}

/// The law of a coupling that does nothing.
fn uncoupled<R: Real>() -> CouplingLaw<R> {
    CouplingLaw::of_numbers([R::zero(); RightSideLayout::COUPLING])
}

impl<R: Real> Forces<R> {
    /// Generalised forces conjugate to the hinges' angles: torques about hinges, those of couplings, and
    /// forces along lines, each of which turns all hinges inboard of its link; eqs. (6.1) and (6.17),
    /// corrected: note 5.
    pub fn torques(
        &self,
        topology: &Topology,
        parameters: &Parameters<R>,
        [beta, tau]: [&[R]; 2],
    ) -> Vec<R> {
        R::remark(|| "Hinges: torques of springs and dashpots.".to_owned());
        let hinges = self.laws.iter().zip(beta.iter().zip(tau));
        let mut torques: Vec<R> =
            hinges.map(|(law, (&beta, &tau))| law.torque(beta, tau)).collect();
        for (own, inboard, coupling) in self.coupled(topology) {
            R::remark(|| format!("Hinge {}: its coupling with hinge {}.", own + 1, inboard + 1));
            let both = |all: &[R]| [all[own], all[inboard]];
            let [of_own, of_inboard] = coupling.torques(both(beta), both(tau));
            torques[own] += of_own;
            torques[inboard] += of_inboard;
        }
        let mut first = 0;
        let appendages = topology.shapes().iter().zip(&parameters.branches);
        for (number, (shape, branch)) in appendages.enumerate() {
            let hinges = first..first + shape.hinges();
            first = hinges.end;
            if self.lines.is_empty() {
                continue;
            }
            R::remark(|| format!("Appendage {}: torques of the lines that push it.", number + 1));
            let links = pose::link_places(shape, branch, &beta[hinges.clone()]);
            let lines = hinges.clone().map(|hinge| self.places(hinge).map(|at| self.lines[at]));
            push(&branch.rot_body_from_appendage, &links, lines, &mut torques[hinges]);
        }
        torques
    }

    /// The couplings, each with its hinge and the one inboard of that.
    fn coupled(&self, topology: &Topology) -> Vec<(usize, usize, CouplingLaw<R>)> {
        let inboard = topology.inboard_hinges().into_iter().zip(&self.couplings).enumerate();
        inboard.filter_map(|(own, (inboard, law))| Some((own, inboard?, *law))).collect()
    }

    /// All that acts on the main body at the rate `omega`, about O, main-body axes: the external wrench, and the moment
    /// −ω̄ × h̄ of rotors that are carried along, which are not in the report.
    pub fn on_main_body(&self, omega: Vec3<R>) -> Wrench<R> {
        Wrench { moment: self.external.moment - omega.cross(self.spin), ..self.external }
    }

    /// Power of the parts of the torques that depend on rates, summed up appendage by appendage, its couplings last.
    pub fn rate_power(&self, topology: &Topology, tau: &[R]) -> R {
        let coupled = self.coupled(topology);
        let power_of = |hinge: usize| self.laws[hinge].rate_torque(tau[hinge]) * tau[hinge];
        let mut first = 0;
        let of_appendage = |shape: &Shape| {
            let hinges = first..first + shape.hinges();
            first = hinges.end;
            let own = coupled.iter().filter(|(own, ..)| hinges.contains(own));
            let of_couplings =
                own.map(|(own, inboard, law)| law.rate_power([tau[*own], tau[*inboard]]));
            hinges
                .clone()
                .map(power_of)
                .chain(of_couplings)
                .fold(R::zero(), |sum, power| sum + power)
        };
        let all = topology.shapes().iter().map(of_appendage);
        all.fold(R::zero(), |sum, power| sum + power)
    }
}

/// Adds to the torques about the hinges of an appendage those of the lines that push its links. The
/// reaction on the main body leaves no resultant.
fn push<R: Real>(
    rot_body_from_appendage: &Mat3<R>,
    links: &[LinkPlace<R>],
    lines: impl Iterator<Item = impl Iterator<Item = LinkLine<R>>>,
    torques: &mut [R],
) {
    for (i, (link, lines)) in links.iter().zip(lines).enumerate() {
        for line in lines {
            let fixed = rot_body_from_appendage.transpose_mul(line.main_body_point);
            let end = link.position + link.rot * line.point;
            let force = line.law.push(end - fixed);
            for joint in std::iter::successors(Some(i), |&j| links[j].inboard) {
                let LinkPlace { axis, position, slides, .. } = links[joint];
                let acts = if slides { force } else { (end - position).cross(force) };
                torques[joint] += axis.dot(acts);
            }
        }
    }
}

/// The first rotor that is not on the main body, or changes its speed.
fn other_rotor(tree: &WeldedTree<f64>) -> Option<usize> {
    let is_other =
        |rotor: &LinkRotor<f64>| rotor.link.is_some() || rotor.motion.acceleration != 0.0;
    tree.rotors.iter().position(is_other)
}

impl Forces<f64> {
    /// Those of `elements`, which act on `tree`, whose chains and paddles were `recognised`.
    ///
    /// # Errors
    /// What a right side has no place for.
    pub fn of(
        elements: &Elements<f64>,
        tree: &WeldedTree<f64>,
        recognised: &Recognised,
    ) -> Result<Self, NoPlace> {
        let mut forces = Self::none(recognised.links.len());
        forces.set(elements, tree, recognised)?;
        Ok(forces)
    }

    /// Makes them [those](Self::of) of other elements or another tree with as many links, without allocation unless
    /// couplings act.
    ///
    /// # Errors
    /// As [`of`](Self::of); then they are to be set again.
    pub fn set(
        &mut self,
        elements: &Elements<f64>,
        tree: &WeldedTree<f64>,
        recognised: &Recognised,
    ) -> Result<(), NoPlace> {
        let withheld = elements.withheld().map(|hinge| NoPlace::Withheld { hinge });
        let rotor = || other_rotor(tree).map(|rotor| NoPlace::Rotor { rotor });
        let is_other = |push: &&Push<f64>| push.link.is_some() || push.varies();
        let external = || {
            let push = elements.pushes().iter().find(is_other)?;
            Some(NoPlace::External { external: push.number })
        };
        if let Some(what) = withheld.or_else(rotor).or_else(external) {
            return Err(what);
        }
        (self.external, self.spin) = (Wrench::zero(), Vec3::zero());
        self.lines.fill(LinkLine::absent());
        self.couplings.fill(uncoupled());
        for (law, &link) in self.laws.iter_mut().zip(&recognised.links) {
            *law = elements.torques()[tree.links[link].hinge].law();
        }
        if let Some(external) = tree.holding_wrench().or_else(|| elements.external()) {
            self.external = external;
        }
        if let (Some(spin), None) = (tree.main_spin, tree.held) {
            self.spin = spin.momentum;
        }
        for (link, line) in elements.pushing() {
            let of_link = |&other: &usize| other == link;
            let hinge = recognised.links.iter().position(of_link).expect("every link has a hinge");
            let is_empty = |&place: &usize| self.lines[place] == LinkLine::absent();
            let place = self.places(hinge).find(is_empty);
            let place = place.ok_or(NoPlace::Lines { hinge: line.hinge })?;
            self.lines[place] = LinkLine {
                point: recognised.frames[hinge].point(line.point),
                main_body_point: line.main_body_point,
                law: *line.law(),
            };
        }
        for coupled in elements.coupled() {
            self.couple(coupled, recognised)?;
        }
        Ok(())
    }

    /// Adds a coupling; beside a hinge that is held it is a part of the other one's law.
    fn couple(&mut self, coupled: &Coupled<f64>, recognised: &Recognised) -> Result<(), NoPlace> {
        let no_place = NoPlace::Coupling { hinges: coupled.hinges };
        if !coupled.is_mutual {
            return Err(no_place);
        }
        let of = |link| recognised.links.iter().position(|&of| of == link).expect("a link's hinge");
        let law = coupled.law;
        let [first, second] = match coupled.ends {
            [CoupledEnd::Free(first), CoupledEnd::Free(second)] => [first, second].map(of),
            [CoupledEnd::Free(own), CoupledEnd::Held(angle)] => {
                self.laws[of(own)].add_linear(law.beside_held(angle));
                return Ok(());
            }
            [CoupledEnd::Held(angle), CoupledEnd::Free(own)] => {
                self.laws[of(own)].add_linear(law.reversed().beside_held(angle));
                return Ok(());
            }
            [CoupledEnd::Held(_), CoupledEnd::Held(_)] => return Ok(()),
        };
        let inboard = recognised.topology.inboard_hinges();
        let (own, law) = if inboard[first] == Some(second) {
            (first, law)
        } else if inboard[second] == Some(first) {
            (second, law.reversed())
        } else {
            return Err(no_place);
        };
        if self.couplings[own] != uncoupled() {
            return Err(no_place);
        }
        self.couplings[own] = law;
        Ok(())
    }
}
