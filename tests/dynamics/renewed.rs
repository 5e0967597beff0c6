//! A tree with other masses is recognised as one that is new.

use nboom::formulation::{Seats, recognise};
use nboom::model::Joint;
use nboom::scalar::{RigidInertia, Vec3};

use crate::limbs;
use crate::random_scene::Rng;
use crate::satellites::{Satellite, random};

#[test]
fn what_was_recognised_takes_other_masses_where_links_hang_as_before() {
    for seed in 0..1000 {
        let mut tree = Satellite::of_moment(&random(seed)).tree;
        let mut known = recognise(&tree).expect("chains and paddles");
        let seats = Seats::of(&known, &tree);
        let dice = &mut Rng::new(seed ^ 0x9e3);
        let other = |dice: &mut Rng| {
            let body = dice.mass_properties(2.0, 0.5);
            RigidInertia::new(body.mass, body.center_of_mass, body.inertia)
        };
        tree.main = other(dice);
        for link in &mut tree.links {
            link.inertia = other(dice);
        }
        assert!(known.renew(&seats, &tree), "seed {seed}");
        assert_eq!(Ok(&known), recognise(&tree).as_ref(), "seed {seed}");
        let Some(link) = tree.links.last_mut() else { continue };
        let as_before = known.clone();
        match dice.below(3) {
            0 => link.point += Vec3::unit_x(),
            1 => link.axis = -link.axis,
            _ => link.joint = Joint::Prismatic,
        }
        assert!(!known.renew(&seats, &tree), "seed {seed}");
        assert_eq!(known, as_before, "seed {seed}");
        tree.links.pop();
        assert!(!known.renew(&seats, &tree), "seed {seed}");
    }
}

#[test]
fn limbs_are_recognised_anew() {
    let mut with_limbs = 0;
    for seed in 0..200 {
        let tree = limbs::satellite(seed).tree;
        let mut known = recognise(&tree).expect("no more links than limbs have");
        let seats = Seats::of(&known, &tree);
        with_limbs += usize::from(known.topology.has_limbs());
        assert_eq!(known.renew(&seats, &tree), !known.topology.has_limbs(), "seed {seed}");
    }
    assert!(with_limbs > 100, "{with_limbs}");
}
