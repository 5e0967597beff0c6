//! Columns of the tables of stresses and hinge loads.

use crate::StressSigns;
use crate::heads::{Head, Holds};

const STRESS: &str = "F/L^2";

fn places() -> [Head; 2] {
    [
        Head::count("appendage", "appendage, from 1"),
        Head::count("segment", "segment of the appendage, from 1"),
    ]
}

/// Where the event of a row happened.
fn event_places() -> [Head; 2] {
    [
        Head::count("event_appendage", "appendage of the hinge that locks or hits its stop"),
        Head::count("event_segment", "segment of the hinge that locks or hits its stop"),
    ]
}

fn event() -> Head {
    Head::text("event", "lock_up or impact where its pulse adds to the load, else nothing")
}

fn points() -> [Head; 2] {
    [
        Head::number("xi", "L", "place in the section along xi"),
        Head::number("zeta", "L", "place in the section along zeta"),
    ]
}

fn share() -> Head {
    Head::number("share", "1", "part of that pulse in the load")
}

/// P and Q, or their impulses.
fn loads(force: &'static str, moment: &'static str) -> [Head; 6] {
    let force = |name, about| Head::number(name, force, about);
    let moment = |name, about| Head::number(name, moment, about);
    [
        force("p_xi", "P on what is outboard, along xi of the segment"),
        force("p_eta", "P on what is outboard, along eta of the segment"),
        force("p_zeta", "P on what is outboard, along zeta of the segment"),
        moment("q_xi", "Q on what is outboard, about xi of the segment"),
        moment("q_eta", "Q on what is outboard, about eta of the segment"),
        moment("q_zeta", "Q on what is outboard, about zeta of the segment"),
    ]
}

fn components(signs: StressSigns) -> [Head; 3] {
    let component =
        |name, what: &str| Head::number(name, STRESS, format!("{what}; {}", signs.name()));
    [
        component("sigma_22", "normal stress"),
        component("sigma_21", "shear stress along xi"),
        component("sigma_23", "shear stress along zeta"),
    ]
}

fn von_mises() -> Head {
    Head::number("von_mises", STRESS, "von Mises stress")
}

/// Of `stress.csv`.
pub(crate) fn stress(signs: StressSigns) -> Vec<Head> {
    let mut heads = vec![Head::time("time"), event()];
    heads.extend(places());
    heads.push(Head::count("station", "station of the segment, from 1, outboard first"));
    heads.push(Head::text("point", "axis point by its angle, or max where von_mises is largest"));
    heads.extend(points());
    heads.extend(components(signs));
    heads.push(Head::number("principal_1", STRESS, "larger principal stress"));
    heads.push(Head::number("principal_2", STRESS, "smaller principal stress"));
    heads.push(von_mises());
    heads.extend(loads("F", "F L"));
    heads
}

/// Of `hinge_loads.csv`.
pub(crate) fn hinge_loads() -> Vec<Head> {
    let mut heads = vec![Head::time("time"), event()];
    heads.extend(places());
    heads.extend(loads("F", "F L"));
    heads
}

/// Of `latch_impulses.csv`.
pub(crate) fn latch_impulses() -> Vec<Head> {
    let mut heads = vec![Head::time("time of the lock-up or impact")];
    heads.extend(event_places());
    heads.extend(places());
    heads.extend(loads("F T", "F L T"));
    heads
}

/// Of `stress_envelope.csv`; `breaks` where a part has an ultimate stress.
pub(crate) fn envelope(signs: StressSigns, breaks: bool) -> Vec<Head> {
    let mut heads = places().to_vec();
    heads.push(Head::count("station", "station of the segment, from 1, outboard first"));
    heads.extend([Head::time("time of the largest von Mises stress"), event()]);
    heads.extend(event_places());
    heads.extend(points());
    heads.extend(components(signs));
    heads.push(von_mises());
    heads.push(Head::text("driver", "component of the load that alone makes most of the stress"));
    heads.push(Head::number("margin", "1", "margin to yielding"));
    heads.push(share());
    heads.extend(loads("F", "F L"));
    heads.extend(breaks.then(|| Head::number("ultimate_margin", "1", "margin to breaking")));
    heads
}

/// Of `hinge_load_envelope.csv`.
pub(crate) fn hinge_envelope() -> Vec<Head> {
    let mut heads = places().to_vec();
    heads.push(Head::text("quantity", "force or moment, which of them is largest"));
    heads.extend([Head::time("time of the largest load"), event()]);
    heads.extend(event_places());
    let about = "largest force, in the unit of p_xi, or moment, in that of q_xi";
    heads.push(Head::of("magnitude", Holds::Various, about));
    heads.push(share());
    heads.extend(loads("F", "F L"));
    heads
}
