//! What a routine assumes, in words.

use nboom_formulation::{Layout, RightSideLayout};
use nboom_model::{Shape, Topology};

use crate::request::{Output, Request};

impl Request {
    /// One phrase for each thing that the routine does not compute because of what it assumes.
    pub fn assumptions_in_words(&self) -> Vec<String> {
        phrases(self)
    }
}

fn phrases(request: &Request) -> Vec<String> {
    let Request { topology, assumptions, .. } = request;
    let mut phrases = Vec::new();
    if !request.external {
        phrases.push("no external wrench on the main body".to_owned());
    }
    let fixed = assumptions.iter().flatten().count();
    if fixed == assumptions.len() {
        phrases.push(format!("all {fixed} parameters"));
        return phrases;
    }
    let mut said = vec![false; assumptions.len()];
    let bodies = Layout::parameters(topology);
    if assumptions[..bodies].iter().all(Option::is_some) {
        said[..bodies].fill(true);
        phrases.push(format!("all {bodies} numbers of the bodies"));
    } else {
        of_bodies(request, &mut said, &mut phrases);
    }
    if request.output == Output::RightSide {
        let external = RightSideLayout::external(topology);
        if !request.external {
            external.clone().for_each(|at| said[at] = true);
        }
        let spin = RightSideLayout::spin(topology);
        if assumptions[spin.clone()].iter().all(|assumed| *assumed == Some(0.0)) {
            said[spin].fill(true);
            phrases.push("no rotor that turns".to_owned());
        }
        of_lines(request, &mut said, &mut phrases);
        of_couplings(request, &mut said, &mut phrases);
    }
    phrases.extend(rest(request, &said));
    phrases
}

/// Which lines are assumed not to push.
fn of_lines(request: &Request, said: &mut [bool], phrases: &mut Vec<String>) {
    let topology = &request.topology;
    let lines = RightSideLayout::lines(topology);
    let absent: Vec<usize> = (0..lines).filter(|&place| !request.may_push(place)).collect();
    absent.iter().for_each(|&place| said[RightSideLayout::line(topology, place)].fill(true));
    match absent.len() {
        0 => {}
        count if count == lines => phrases.push("no force along a line".to_owned()),
        count => phrases.push(format!("no force along {count} of {lines} lines")),
    }
}

/// Which hinges are assumed not to be coupled with the one inboard of them, of those that have one.
fn of_couplings(request: &Request, said: &mut [bool], phrases: &mut Vec<String>) {
    let topology = &request.topology;
    let inboard = topology.inboard_hinges();
    let absent: Vec<usize> =
        (0..inboard.len()).filter(|&hinge| !request.may_couple(hinge)).collect();
    absent.iter().for_each(|&hinge| said[RightSideLayout::coupling(topology, hinge)].fill(true));
    let count = absent.iter().filter(|&&hinge| inboard[hinge].is_some()).count();
    let pairs = inboard.iter().flatten().count();
    match count {
        0 => {}
        _ if count == pairs => phrases.push("no coupling of hinges".to_owned()),
        _ => phrases.push(format!("no coupling of {count} of {pairs} pairs of hinges")),
    }
}

/// What is assumed of mass properties and places.
fn of_bodies(request: &Request, said: &mut [bool], phrases: &mut Vec<String>) {
    let Request { topology, assumptions, .. } = request;
    let zero = |at: usize| assumptions[at] == Some(0.0);
    let all_zero = |first: usize, places: &[usize]| places.iter().all(|at| zero(first + at));
    let mut say = |firsts: &[usize], places: &[usize], phrase: String| {
        let all = firsts.iter().flat_map(|first| places.iter().map(move |at| first + at));
        all.for_each(|at| said[at] = true);
        phrases.push(phrase);
    };
    let is_held = request.holds_main_body();
    for (is_so, places, phrase) in [
        (is_held, &WHOLE[..], "main body held"),
        (!is_held && all_zero(0, &CENTER), &CENTER, "O at the main body's mass centre"),
        (!is_held && all_zero(0, &PRODUCTS), &PRODUCTS, "main body along its principal axes"),
    ] {
        if is_so {
            say(&[0], places, phrase.to_owned());
        }
    }
    let links = Layout::links(topology);
    for (places, phrase) in [
        (&CENTER_ACROSS[..], "mass centre in the plane square to the hinge axis"),
        (&CENTER_OUT[..], "no first moment along ζ"),
        (&PRODUCTS[..], "inertia along the segment axes"),
        (&PRODUCTS_ACROSS[..], "inertia mirrored by the plane square to the hinge axis"),
        (&WAY_ACROSS[..], "next hinge on the η axis"),
    ] {
        // Inertia along the segment axes is mirrored, too.
        let is_said = |link: usize| places == PRODUCTS_ACROSS && all_zero(link, &PRODUCTS);
        let is_so = |&link: &usize| all_zero(link, places) && !is_said(link);
        let found: Vec<usize> = links.iter().copied().filter(is_so).collect();
        if !found.is_empty() {
            let (count, of) = (found.len(), links.len());
            say(&found, places, format!("{phrase} of {count} of {of} links"));
        }
    }
}

/// What no phrase says: each number by its name, owners with the same ones together.
fn rest(request: &Request, said: &[bool]) -> Vec<String> {
    let Request { topology, assumptions, output, .. } = request;
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    let mut at = 0;
    let mut owners = owners(topology);
    if *output == Output::RightSide {
        owners.extend(owners_of_forces(topology));
    }
    for (owner, names) in owners {
        let range = at..at + names.len();
        at = range.end;
        let named = range.zip(names).filter(|&(at, _)| !said[at]);
        let values: Vec<(f64, &str)> =
            named.filter_map(|(at, name)| Some((assumptions[at]?, *name))).collect();
        if values.is_empty() {
            continue;
        }
        let equations = equations(&values);
        match found.iter_mut().find(|(of_others, _)| *of_others == equations) {
            Some((_, owners)) => owners.push(owner),
            None => found.push((equations, vec![owner])),
        }
    }
    let phrase = |(equations, owners): (String, Vec<String>)| {
        format!("{equations} of {}", owners.join(", "))
    };
    found.into_iter().map(phrase).collect()
}

/// `a = b = 0, c = 1`.
fn equations(values: &[(f64, &str)]) -> String {
    let mut groups: Vec<(f64, Vec<&str>)> = Vec::new();
    for &(value, name) in values {
        match groups.iter_mut().find(|(other, _)| *other == value) {
            Some((_, names)) => names.push(name),
            None => groups.push((value, vec![name])),
        }
    }
    let group = |(value, names): (f64, Vec<&str>)| format!("{} = {value}", names.join(" = "));
    groups.into_iter().map(group).collect::<Vec<_>>().join(", ")
}

/// Whose the parameters are, one owner after the other as in [`Layout`], and what theirs are called.
fn owners(topology: &Topology) -> Vec<(String, &'static [&'static str])> {
    let mut owners = vec![("the main body".to_owned(), &MAIN[..])];
    for (appendage, shape) in topology.shapes().iter().enumerate() {
        let appendage = appendage + 1;
        owners.push((format!("appendage {appendage}"), &BRANCH));
        for link in 0..shape.hinges() {
            let owner = format!("link {appendage},{}", link + 1);
            let Shape::Limb(limb) = shape else {
                owners.push((owner, &LINK));
                continue;
            };
            let mount = match Layout::mount(limb, link) {
                Layout::WAY => &LINK[Layout::BODY..],
                count => &BRANCH[..count],
            };
            owners.push((format!("the mount of {owner}"), mount));
            owners.push((owner, &LINK[..Layout::BODY]));
        }
    }
    owners
}

/// Whose the numbers of [`Forces`](nboom_formulation::Forces) are, and what theirs are called.
fn owners_of_forces(topology: &Topology) -> Vec<(String, &'static [&'static str])> {
    let shapes = topology.shapes().iter().enumerate();
    let hinges: Vec<String> = shapes
        .flat_map(|(i, shape)| (1..=shape.hinges()).map(move |link| format!("{},{link}", i + 1)))
        .collect();
    let of =
        |what: &str, names: &'static [&'static str]| -> Vec<(String, &'static [&'static str])> {
            hinges.iter().map(|hinge| (format!("{what} {hinge}"), names)).collect()
        };
    let external = ("the external wrench".to_owned(), &WRENCH[..]);
    let spin = ("the rotors".to_owned(), &SPIN[..]);
    let lines = [of("line", &LINE), of("second line", &LINE)].concat();
    [of("hinge", &LAW), vec![external, spin], lines, of("coupling", &COUPLING)].concat()
}

/// Torque about a hinge.
const LAW: [&str; RightSideLayout::LAW] = ["q₁", "q₂", "A₃", "A₂", "A₁", "A₀", "β₀"];
/// Moment and force.
const WRENCH: [&str; RightSideLayout::EXTERNAL] = ["M_x", "M_y", "M_z", "F_x", "F_y", "F_z"];
/// Ends of a line on the link and on the main body, force by powers of its length.
const LINE: [&str; RightSideLayout::LINE] =
    ["p_ξ", "p_η", "p_ζ", "o_x", "o_y", "o_z", "a₀", "a₁", "a₂", "a₃"];
/// Angular momentum.
const SPIN: [&str; RightSideLayout::SPIN] = ["h_x", "h_y", "h_z"];
/// Weights of the hinge and of the one inboard of it, stiffness, rest, damping.
const COUPLING: [&str; RightSideLayout::COUPLING] = ["ρ₁", "ρ₂", "k", "θ", "c"];

/// Mass, first moment and inertia about O.
const MAIN: [&str; Layout::MAIN] =
    ["m", "c_x", "c_y", "c_z", "J_xx", "J_yy", "J_zz", "J_xy", "J_xz", "J_yz"];
/// Rotation from appendage axes to main-body axes, and the first hinge from O in appendage axes.
const BRANCH: [&str; Layout::BRANCH] =
    ["R_11", "R_12", "R_13", "R_21", "R_22", "R_23", "R_31", "R_32", "R_33", "d_ξ", "d_η", "d_ζ"];
/// Mass, first moment and inertia about the hinge, and the way to the next hinge.
const LINK: [&str; Layout::LINK] =
    ["m", "c_ξ", "c_η", "c_ζ", "J_ξξ", "J_ηη", "J_ζζ", "J_ξη", "J_ξζ", "J_ηζ", "l_η", "l_ζ"];

/// A body, all of it.
const WHOLE: [usize; Layout::BODY] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];
/// First moment, all of it.
const CENTER: [usize; 3] = [1, 2, 3];
/// First moment along ê₁.
const CENTER_ACROSS: [usize; 1] = [1];
/// First moment along ζ.
const CENTER_OUT: [usize; 1] = [3];
/// Products of inertia.
const PRODUCTS: [usize; 3] = [7, 8, 9];
/// Products of inertia with ξ.
const PRODUCTS_ACROSS: [usize; 2] = [7, 8];
/// The way to the next hinge along ζ.
const WAY_ACROSS: [usize; 1] = [11];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Level;
    use nboom_formulation::Symmetry;

    fn phrases(request: &Request) -> Vec<String> {
        request.assumptions_in_words()
    }

    #[test]
    fn each_assumption_has_its_phrase() {
        let topology = Topology::new([Shape::Chain(2), Shape::Paddle]);
        let general = Request::new("S2P", topology.clone(), Level::Fast);
        assert_eq!(phrases(&general), ["no external wrench on the main body"]);
        assert_eq!(phrases(&general.clone().with_external_wrench()), [""; 0]);
        let principal = general.clone().with_symmetry(Symmetry::Principal).with_external_wrench();
        assert_eq!(
            phrases(&principal),
            [
                "O at the main body's mass centre",
                "main body along its principal axes",
                "mass centre in the plane square to the hinge axis of 4 of 4 links",
                "no first moment along ζ of 4 of 4 links",
                "inertia along the segment axes of 4 of 4 links",
                "next hinge on the η axis of 4 of 4 links",
            ]
        );
        let mirrored = general.clone().with_symmetry(Symmetry::Mirrored).with_external_wrench();
        assert_eq!(
            phrases(&mirrored),
            [
                "mass centre in the plane square to the hinge axis of 4 of 4 links",
                "inertia mirrored by the plane square to the hinge axis of 4 of 4 links",
            ]
        );
        let held = general.clone().with_held_main_body().with_external_wrench();
        assert_eq!(phrases(&held), ["main body held"]);
        let mut partly = principal;
        // Rows of a rotation first, then the hinge's place; the second link of the paddle is 2,2.
        for first in [Layout::MAIN, Layout::MAIN + Layout::BRANCH + 2 * Layout::LINK] {
            (partly.assumptions[first], partly.assumptions[first + 10]) = (Some(1.0), Some(0.0));
        }
        *partly.assumptions.last_mut().expect("a link") = None;
        partly.assumptions[7] = None;
        let rest =
            ["J_xz = J_yz = 0 of the main body", "R_11 = 1, d_η = 0 of appendage 1, appendage 2"];
        let found = phrases(&partly);
        assert!(found.contains(&"next hinge on the η axis of 3 of 4 links".to_owned()));
        assert_eq!(found[found.len() - 2..], rest);
        let mut right_side = general.clone().for_right_side();
        let expected = [
            "no external wrench on the main body",
            "no rotor that turns",
            "no force along a line",
            "no coupling of hinges",
        ];
        assert_eq!(phrases(&right_side), expected);
        right_side.assumptions[RightSideLayout::law(&topology, 1).start] = Some(0.0);
        assert_eq!(phrases(&right_side)[4..], ["q₁ = 0 of hinge 1,2"]);
        let coupling = RightSideLayout::coupling(&topology, 1);
        right_side.assumptions[coupling.clone()].fill(None);
        right_side.assumptions[coupling.start + 3] = Some(0.0);
        let of_coupling = [
            "no coupling of 1 of 2 pairs of hinges",
            "q₁ = 0 of hinge 1,2",
            "θ = 0 of coupling 1,2",
        ];
        let right_side = right_side.with_rotors();
        assert_eq!(phrases(&right_side.with_lines(2))[1..], of_coupling);
        let parameters = vec![2.0; general.assumptions.len()];
        assert_eq!(phrases(&general.baked(&parameters))[1..], ["all 82 parameters"]);
    }
}
