use nboom_model::{Shape, Topology};

use crate::parameters::Layout;
use crate::right_side::RightSideLayout;

/// The numbers of a rigid body, about its origin, then the way from a link to the next hinge.
const OF_LINK: [&str; Layout::LINK] = [
    "mass",
    "first moment x",
    "first moment y",
    "first moment z",
    "moment of inertia xx",
    "moment of inertia yy",
    "moment of inertia zz",
    "inertia xy",
    "inertia xz",
    "inertia yz",
    "y of the next hinge",
    "z of the next hinge",
];

/// The numbers of an appendage before its links.
const OF_APPENDAGE: [&str; Layout::BRANCH] = [
    "rotation xx",
    "rotation xy",
    "rotation xz",
    "rotation yx",
    "rotation yy",
    "rotation yz",
    "rotation zx",
    "rotation zy",
    "rotation zz",
    "x of the first hinge",
    "y of the first hinge",
    "z of the first hinge",
];

/// The numbers of a limb's link whose joint is parallel to its inboard one, before those of its body.
const OF_WAY: [&str; Layout::WAY] = ["y from the inboard joint", "z from the inboard joint"];

/// The numbers of any other limb's link, before those of its body.
const OF_MOUNT: [&str; Layout::BRANCH] = [
    "rotation xx",
    "rotation xy",
    "rotation xz",
    "rotation yx",
    "rotation yy",
    "rotation yz",
    "rotation zx",
    "rotation zy",
    "rotation zz",
    "x from the inboard joint",
    "y from the inboard joint",
    "z from the inboard joint",
];

/// The numbers of the torque about a hinge.
const OF_LAW: [&str; RightSideLayout::LAW] = ["q1", "q2", "A3", "A2", "A1", "A0", "beta0"];

/// The external wrench.
const OF_WRENCH: [&str; RightSideLayout::EXTERNAL] =
    ["moment x", "moment y", "moment z", "force x", "force y", "force z"];

/// Angular momentum of rotors.
const OF_SPIN: [&str; RightSideLayout::SPIN] = ["x", "y", "z"];

/// The numbers of a line that pushes a link.
const OF_LINE: [&str; RightSideLayout::LINE] = [
    "x of the end on the link",
    "y of the end on the link",
    "z of the end on the link",
    "x of the end on the main body",
    "y of the end on the main body",
    "z of the end on the main body",
    "a0",
    "a1",
    "a2",
    "a3",
];

/// The numbers of the coupling of a hinge with the one inboard of it.
const OF_COUPLING: [&str; RightSideLayout::COUPLING] =
    ["own weight", "inboard hinge's weight", "stiffness", "rest", "damping"];

/// What the numbers of a link are.
fn of_link(shape: &Shape, link: usize) -> Vec<&'static str> {
    let Shape::Limb(limb) = shape else { return OF_LINK.to_vec() };
    let mount = match Layout::mount(limb, link) {
        0 => &[][..],
        Layout::WAY => &OF_WAY,
        _ => &OF_MOUNT,
    };
    [mount, &OF_LINK[..Layout::BODY]].concat()
}

impl Layout {
    /// What parameter `number` of a topology is, counted from 0; appendages are counted from 1 in
    /// the topology's order, links from the inboard one.
    ///
    /// # Panics
    /// When the topology has no such parameter.
    pub fn name(topology: &Topology, number: usize) -> String {
        if number < Self::MAIN {
            return format!("{} of the main body", OF_LINK[number]);
        }
        let mut at = number - Self::MAIN;
        for (i, shape) in topology.shapes().iter().enumerate() {
            let appendage = i + 1;
            if at < Self::BRANCH {
                return format!("{} of appendage {appendage}", OF_APPENDAGE[at]);
            }
            at -= Self::BRANCH;
            for link in 0..shape.hinges() {
                let names = of_link(shape, link);
                if let Some(name) = names.get(at) {
                    return format!("{name} of link {} of appendage {appendage}", link + 1);
                }
                at -= names.len();
            }
        }
        panic!("parameter {number} of {topology}")
    }
}

impl RightSideLayout {
    /// What parameter `number` of a topology is, counted from 0, in the words of [`Layout::name`].
    ///
    /// # Panics
    /// When the topology has no such parameter.
    pub fn name(topology: &Topology, number: usize) -> String {
        let (laws, external) = (Self::law(topology, 0).start, Self::external(topology));
        if number < laws {
            return Layout::name(topology, number);
        }
        if external.contains(&number) {
            return format!("external {}", OF_WRENCH[number - external.start]);
        }
        let spin = Self::spin(topology);
        if spin.contains(&number) {
            return format!("angular momentum {} of rotors", OF_SPIN[number - spin.start]);
        }
        let link = |hinge: usize| {
            let shapes = topology.shapes().iter().enumerate();
            let links = shapes.flat_map(|(i, shape)| (1..=shape.hinges()).map(move |j| (i + 1, j)));
            let (appendage, link) = links.clone().nth(hinge % topology.hinges()).expect("a hinge");
            format!("link {link} of appendage {appendage}")
        };
        if number < external.start {
            let at = number - laws;
            return format!("{} of the hinge of {}", OF_LAW[at % Self::LAW], link(at / Self::LAW));
        }
        assert!(number < Self::parameters(topology), "parameter {number} of {topology}");
        let couplings = Self::coupling(topology, 0).start;
        if number >= couplings {
            let (hinge, at) =
                ((number - couplings) / Self::COUPLING, (number - couplings) % Self::COUPLING);
            let (what, link) = (OF_COUPLING[at], link(hinge));
            return format!("{what} of the coupling of the hinge of {link} with the inboard one");
        }
        let (place, at) = ((number - spin.end) / Self::LINE, (number - spin.end) % Self::LINE);
        let which = if place < topology.hinges() { "" } else { "second " };
        format!("{} of the {which}line that pushes {}", OF_LINE[at], link(place))
    }
}

#[cfg(test)]
mod tests {
    use nboom_elements::{CouplingLaw, HingeLaw, KickOffLaw};

    use super::*;
    use crate::{Forces, Parameters};

    #[test]
    fn names_of_forces_are_those_of_the_numbers_that_are_written() {
        let topology: Topology = "S2_P".parse().expect("a topology");
        let first = RightSideLayout::law(&topology, 0).start;
        let mut forces = Forces::none(4);
        forces.laws[3] = HingeLaw::of_numbers([0.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0]);
        forces.external.force.y = 1.0;
        forces.spin.z = 6.0;
        forces.lines[1].main_body_point.z = 2.0;
        forces.lines[4 + 2].law = KickOffLaw::of_numbers([0.0, 3.0, 0.0, 0.0]);
        forces.couplings[1] = CouplingLaw::of_numbers([0.0, 0.0, 0.0, 4.0, 0.0]);
        let (written, nothing) = (forces.write(), Forces::none(4).write());
        let differ = (0..written.len()).filter(|&i| written[i] != nothing[i]);
        let names = differ.map(|i| RightSideLayout::name(&topology, first + i));
        assert_eq!(
            names.collect::<Vec<_>>(),
            [
                "A1 of the hinge of link 2 of appendage 2",
                "external force y",
                "angular momentum z of rotors",
                "z of the end on the main body of the line that pushes link 2 of appendage 1",
                "a1 of the second line that pushes link 1 of appendage 2",
                "rest of the coupling of the hinge of link 2 of appendage 1 with the inboard one",
            ]
        );
        let last = RightSideLayout::parameters(&topology) - 1;
        let name = RightSideLayout::name(&topology, last);
        assert_eq!(
            name,
            "damping of the coupling of the hinge of link 2 of appendage 2 with the inboard one"
        );
        assert_eq!(RightSideLayout::name(&topology, 0), "mass of the main body");
    }

    #[test]
    fn names_are_those_of_the_numbers_that_are_written() {
        let topology: Topology = "S2_P".parse().expect("a topology");
        let count = Layout::parameters(&topology);
        let mut numbers = Parameters::read(&topology, vec![0.0; count]);
        numbers.main.about_origin.yz = 1.0;
        numbers.branches[0].links[1].inertia.first_moment.y = 2.0;
        numbers.branches[1].rot_body_from_appendage.rows[1].z = 3.0;
        numbers.branches[1].links[0].next[1] = 4.0;
        let written = numbers.write();
        let names = (0..count).filter(|&i| written[i] != 0.0).map(|i| Layout::name(&topology, i));
        assert_eq!(
            names.collect::<Vec<_>>(),
            [
                "inertia yz of the main body",
                "first moment y of link 2 of appendage 1",
                "rotation yz of appendage 2",
                "z of the next hinge of link 1 of appendage 2",
            ]
        );
        assert_eq!(
            Layout::name(&topology, count - 1),
            "z of the next hinge of link 2 of appendage 2"
        );
        let topology: Topology = "Trp".parse().expect("a topology");
        let last = Layout::parameters(&topology) - 1;
        assert_eq!(Layout::name(&topology, last), "inertia yz of link 2 of appendage 1");
        let way = last - Layout::BODY;
        assert_eq!(
            Layout::name(&topology, way),
            "z from the inboard joint of link 2 of appendage 1"
        );
    }
}
