//! What a routine takes for granted, in words.

use nboom_formulation::Layout;
use nboom_model::{Shape, Topology};

/// One phrase for each thing that a routine of this topology does not compute, given the
/// parameters it takes for granted and whether it takes an external wrench.
pub fn granted(topology: &Topology, pinned: &[Option<f64>], external: bool) -> Vec<String> {
    let mut phrases = Vec::new();
    if !external {
        phrases.push("no external wrench on the main body".to_owned());
    }
    let fixed = pinned.iter().flatten().count();
    if fixed == pinned.len() {
        phrases.push(format!("all {fixed} parameters"));
        return phrases;
    }
    let zero = |at: usize| pinned[at] == Some(0.0);
    let all_zero = |first: usize, places: &[usize]| places.iter().all(|at| zero(first + at));
    let mut said = 0;
    let mut say = |places: usize, phrase: String| {
        said += places;
        phrases.push(phrase);
    };
    if all_zero(0, &CENTER) {
        say(CENTER.len(), "O at the main body's mass centre".to_owned());
    }
    if all_zero(0, &PRODUCTS) {
        say(PRODUCTS.len(), "main body along its principal axes".to_owned());
    }
    let links = links(topology);
    for (places, phrase) in [
        (&CENTER_ACROSS[..], "mass centre in the plane square to the hinge axis"),
        (&CENTER_OUT[..], "no first moment along ζ"),
        (&PRODUCTS[..], "inertia along the segment axes"),
        (&WAY_ACROSS[..], "next hinge on the η axis"),
    ] {
        let count = links.iter().filter(|&&link| all_zero(link, places)).count();
        if count > 0 {
            let of = links.len();
            say(count * places.len(), format!("{phrase} of {count} of {of} links"));
        }
    }
    if fixed > said {
        phrases.push(format!("{} further zeros and ones", fixed - said));
    }
    phrases
}

/// First moment, all of it.
const CENTER: [usize; 3] = [1, 2, 3];
/// First moment along ê₁.
const CENTER_ACROSS: [usize; 1] = [1];
/// First moment along ζ.
const CENTER_OUT: [usize; 1] = [3];
/// Products of inertia.
const PRODUCTS: [usize; 3] = [7, 8, 9];
/// The way to the next hinge along ζ.
const WAY_ACROSS: [usize; 1] = [11];

/// Where the numbers of each link begin.
pub(crate) fn links(topology: &Topology) -> Vec<usize> {
    let mut at = Layout::MAIN;
    let mut links = Vec::new();
    for shape in topology.shapes() {
        at += Layout::BRANCH;
        for _ in 0..Shape::hinges(*shape) {
            links.push(at);
            at += Layout::LINK;
        }
    }
    links
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Level, Request};

    fn phrases(request: &Request) -> Vec<String> {
        granted(&request.topology, &request.pinned, request.external)
    }

    #[test]
    fn each_fact_has_its_phrase() {
        let topology = Topology::new([Shape::Chain(2), Shape::Paddle]);
        let general = Request::new("S2P", topology.clone(), Level::Fast);
        assert_eq!(phrases(&general), ["no external wrench on the main body"]);
        assert_eq!(phrases(&general.clone().with_external_wrench()), [""; 0]);
        let principal = general.clone().with_principal_axes().with_external_wrench();
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
        let mut partly = principal;
        partly.pinned[Layout::MAIN] = Some(1.0);
        assert_eq!(phrases(&partly).last().map(String::as_str), Some("1 further zeros and ones"));
        let parameters = vec![2.0; general.pinned.len()];
        assert_eq!(phrases(&general.baked(&parameters))[1..], ["all 82 parameters"]);
    }
}
