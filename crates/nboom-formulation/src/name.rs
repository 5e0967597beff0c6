use nboom_model::{Shape, Topology};

use crate::parameters::Layout;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Parameters;

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
