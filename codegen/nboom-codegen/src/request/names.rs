//! What the numbers of a satellite are called in generated code.

use nboom_formulation::Layout;
use nboom_formulation::stages::{
    ATTITUDE, ATTITUDE_RATE, BRANCH, COUPLING, EXTERNAL, LAW, LINE, LINK, MAIN, MAIN_RATES, OMEGA,
    POWER, SPIN,
};
use nboom_loads::MotionSize;
use nboom_model::{Shape, Topology};

use crate::hash;
use crate::request::Output;

/// The longest identifier of a topology: files are named by it, too.
const LONGEST: usize = 160;

/// A topology's name without what cannot stand in an identifier; where that is too long, its hinges and a number
/// that follows from its name.
pub(crate) fn identifier(topology: &Topology) -> String {
    let name = topology.to_string().replace('_', "").replace('(', "I").replace(')', "O");
    if name.len() <= LONGEST {
        return name;
    }
    format!("{}Hinges{:016x}", topology.hinges(), hash(name.as_bytes()))
}

/// Names of all numbers that a routine reads and writes, in the order of its layout.
pub(crate) struct Names {
    pub parameters: Vec<String>,
    pub coordinates: Vec<String>,
    pub outputs: Vec<String>,
}

impl Names {
    /// For example `mass_main`, `dx_1` of the first appendage, `beta_1_2` of its second link;
    /// equations have no names.
    pub fn of(topology: &Topology, output: Output) -> Self {
        let (mut parameters, mut hinges) = (of_owner(MAIN.numbers, "main"), Vec::new());
        for (appendage, shape) in topology.shapes().iter().enumerate() {
            let appendage = appendage + 1;
            parameters.extend(of_owner(BRANCH.numbers, &appendage.to_string()));
            for link in 1..=Shape::hinges(shape) {
                let owner = format!("{appendage}_{link}");
                parameters.extend(of_link(shape, link - 1, &owner));
                hinges.push(owner);
            }
        }
        match output {
            Output::Accelerations => Self::of_accelerations(topology, parameters, &hinges),
            Output::Equations => {
                let names = Self::of_accelerations(topology, parameters, &hinges);
                Self { outputs: Vec::new(), ..names }
            }
            Output::InverseDynamics => {
                let names = Self::of_accelerations(topology, parameters, &hinges);
                names.exchanged(topology)
            }
            Output::RightSide => Self::of_right_side(parameters, &hinges),
        }
    }

    fn of_accelerations(topology: &Topology, parameters: Vec<String>, hinges: &[String]) -> Self {
        let mut coordinates = owned(&[OMEGA.numbers, EXTERNAL.numbers]);
        let mut outputs = owned(&[MAIN_RATES.numbers]);
        coordinates.resize(Layout::coordinates(topology), String::new());
        outputs.resize(Layout::outputs(topology), String::new());
        for (owner, place) in hinges.iter().zip(Layout::places(topology)) {
            let [beta, tau, torque] = Layout::hinge_in_state(topology, place);
            coordinates[beta] = format!("beta_{owner}");
            coordinates[tau] = format!("tau_{owner}");
            coordinates[torque] = format!("torque_{owner}");
            outputs[Layout::OUTPUT + place] = format!("tau_dot_{owner}");
        }
        Self { parameters, coordinates, outputs }
    }

    /// Accelerations are handed in, and what causes them comes out.
    fn exchanged(mut self, topology: &Topology) -> Self {
        let main = Layout::STATE - Layout::OUTPUT..Layout::STATE;
        self.coordinates[main].swap_with_slice(&mut self.outputs[..Layout::OUTPUT]);
        for place in Layout::places(topology) {
            let [_, _, torque] = Layout::hinge_in_state(topology, place);
            let tau_dot = &mut self.outputs[Layout::OUTPUT + place];
            std::mem::swap(&mut self.coordinates[torque], tau_dot);
        }
        self
    }

    fn of_right_side(mut parameters: Vec<String>, hinges: &[String]) -> Self {
        let of_hinges =
            |name: &'static str| hinges.iter().map(move |hinge| format!("{name}_{hinge}"));
        parameters.extend(hinges.iter().flat_map(|hinge| of_owner(LAW.numbers, hinge)));
        parameters.extend(owned(&[EXTERNAL.numbers, SPIN.numbers]));
        parameters.extend(hinges.iter().flat_map(|hinge| of_owner(LINE.numbers, hinge)));
        let second = |hinge: &String| of_owner(LINE.numbers, &format!("{hinge}_second"));
        parameters.extend(hinges.iter().flat_map(second));
        parameters.extend(hinges.iter().flat_map(|hinge| of_owner(COUPLING.numbers, hinge)));
        let mut coordinates = owned(&[ATTITUDE.numbers, OMEGA.numbers]);
        coordinates.extend(of_hinges("beta").chain(of_hinges("tau")));
        let mut outputs = owned(&[ATTITUDE_RATE.numbers, &MAIN_RATES.numbers[..3]]);
        outputs.extend(of_hinges("beta_dot").chain(of_hinges("tau_dot")));
        outputs.extend(owned(&[POWER.numbers]));
        Self { parameters, coordinates, outputs }
    }

    /// Those of a routine for loads and stresses of motions of this size, in the order of
    /// `nboom_loads::SceneMotion`; numbers of the scene and results have none.
    pub fn of_motion(MotionSize { hinges, externals, rotors }: MotionSize) -> Self {
        let (omega_dot, origin) = MAIN_RATES.numbers.split_at(3);
        let mut coordinates = owned(&[OMEGA.numbers, origin, omega_dot]);
        for quantity in ["beta", "tau", "tau_dot", "density"] {
            coordinates.extend((1..=hinges).map(|hinge| format!("{quantity}_{hinge}")));
        }
        for external in 1..=externals {
            coordinates.extend(["x", "y", "z"].map(|axis| format!("outside_{external}_{axis}")));
        }
        for rotor in 1..=rotors {
            coordinates.extend(["speed", "acceleration"].map(|of| format!("rotor_{of}_{rotor}")));
        }
        Self { parameters: Vec::new(), coordinates, outputs: Vec::new() }
    }
}

/// Those of a link of an appendage.
fn of_link(shape: &Shape, link: usize, owner: &str) -> Vec<String> {
    let Shape::Limb(limb) = shape else { return of_owner(LINK.numbers, owner) };
    let mount = match Layout::mount(limb, link) {
        0 => Vec::new(),
        Layout::WAY => of_owner(&LINK.numbers[Layout::BODY..], owner),
        _ => of_owner(BRANCH.numbers, owner),
    };
    [mount, of_owner(&LINK.numbers[..Layout::BODY], owner)].concat()
}

fn of_owner(names: &[&str], owner: &str) -> Vec<String> {
    names.iter().map(|name| format!("{name}_{owner}")).collect()
}

fn owned(names: &[&[&str]]) -> Vec<String> {
    names.concat().into_iter().map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_topologies_have_short_names_of_their_own() {
        let of = |name: String| identifier(&name.parse().expect("a topology"));
        assert_eq!(of("Tr(rp)(s)_2xP".to_owned()), "2xPTrIrpOIsO");
        let [long, other] = ["r", "s"].map(|last| of(format!("T{}{last}", "r".repeat(999))));
        assert!(long.len() < 40 && long.starts_with("1000Hinges"), "{long}");
        assert!(other.starts_with("1000Hinges") && other != long, "{other}");
    }
}
