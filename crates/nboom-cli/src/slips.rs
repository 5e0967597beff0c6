//! What the command line says about slips of the original program.

use clap::Args;
use nboom_model::SectionShape;
use nboom_strength::{Loads, Slip, Slips, WantedLoads};

use crate::choice::ChoiceError;

/// Options of `nboom run` that concern slips of the original program.
#[derive(Args, Clone, Copy, Debug)]
pub struct SlipArgs {
    /// Repeat slips of the original program, to follow its printout: all, or names separated by
    /// commas, from chain-kick-off, paddle-kick-off, paddle-inertia, load-transfer, tube-inertia,
    /// tube-shear, product-of-inertia, bending-signs, torsion-arm, closing-wall, level-shear and
    /// vertex-before. docs/the-1970-program.md explains each. The results are wrong on purpose.
    #[arg(long = "as-1970", value_name = "SLIPS", num_args = 0..=1, require_equals = true,
          default_missing_value = ALL, value_parser = slips)]
    pub as_1970: Option<Slips>,
}

impl SlipArgs {
    /// What the results repeat, for all who read them: slips that something in a scene and what is computed of it shows.
    pub(crate) fn warning(self, computed: &WantedLoads<'_>) -> Option<String> {
        let shown = self.as_1970?.iter().filter(|&slip| shows(slip, computed));
        let names: Vec<&str> = shown.map(Slip::name).collect();
        (!names.is_empty()).then(|| format!("wrong on purpose, as in 1970: {}", names.join(", ")))
    }

    /// Slips by name that nothing in a scene and what is computed of it shows; of all slips, all if none
    /// does.
    pub(crate) fn idle(self, computed: &WantedLoads<'_>) -> Vec<&'static str> {
        let slips = self.as_1970.unwrap_or_default();
        let shows = |slip: &Slip| shows(*slip, computed);
        if slips == Slips::all() {
            return if slips.iter().any(|slip| shows(&slip)) { Vec::new() } else { vec![ALL] };
        }
        slips.iter().filter(|slip| !shows(slip)).map(Slip::name).collect()
    }
}

/// Whether there is what a slip acts on.
fn shows(slip: Slip, computed: &WantedLoads<'_>) -> bool {
    let scene = computed.scene;
    let mut bodies = 0..scene.bodies.len();
    let has_spring = |i: usize| scene.bodies[i].hinge.kick_off.is_some();
    let is_of_paddle = |i: usize| {
        let of_same = |&j: &usize| scene.label(j).appendage == scene.label(i).appendage;
        (0..scene.bodies.len()).filter(of_same).any(|j| scene.arm_of_paddle(j).is_some())
    };
    let in_chain = |i: usize| {
        std::iter::successors(Some(i), |&i| scene.bodies[i].inboard)
            .any(|i| scene.adds_to_inboard_angle(i))
    };
    let segments = computed.stressed().into_iter().flat_map(|structure| structure.segments());
    let mut sections = segments.flat_map(|segment| &segment.stations).map(|at| &at.section);
    match slip {
        Slip::ChainKickOff => bodies.any(|i| has_spring(i) && in_chain(i)),
        Slip::PaddleKickOff => bodies.any(|i| has_spring(i) && is_of_paddle(i)),
        Slip::PaddleInertia => bodies.any(is_of_paddle),
        Slip::LoadTransfer => {
            computed.loads() > Loads::None && bodies.any(|i| scene.bodies[i].inboard.is_some())
        }
        Slip::TubeInertia | Slip::TubeShear => {
            sections.any(|section| matches!(section, SectionShape::Tube { .. }))
        }
        Slip::ProductOfInertia
        | Slip::BendingSigns
        | Slip::TorsionArm
        | Slip::ClosingWall
        | Slip::LevelShear
        | Slip::VertexBefore => sections.any(|section| matches!(section, SectionShape::Polygon(_))),
    }
}

/// What stands for all slips.
const ALL: &str = "all";

fn slips(names: &str) -> Result<Slips, ChoiceError> {
    if names == ALL {
        return Ok(Slips::all());
    }
    let available = || Slip::ALL.map(Slip::name).into_iter().chain([ALL]).collect();
    let named =
        |name| Slip::named(name).ok_or_else(|| ChoiceError::Unknown { available: available() });
    names.split(',').map(named).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cli, Command, StressArgs};
    use clap::{CommandFactory, Parser};
    use nboom_io::ReadOptions;

    fn parsed(extra: &[&str]) -> Result<Option<Slips>, i32> {
        let words = ["nboom", "run", "scene.nml"].iter().chain(extra);
        match Cli::try_parse_from(words).map_err(|error| error.exit_code())?.command {
            Command::Run(args) => Ok(args.slips.as_1970),
            _ => unreachable!("the words say run"),
        }
    }

    #[test]
    fn slips_are_none_or_all_or_named() {
        assert_eq!(parsed(&[]), Ok(None));
        assert_eq!(parsed(&["--as-1970"]), Ok(Some(Slips::all())));
        let two = [Slip::TubeInertia, Slip::LoadTransfer].into_iter().collect();
        assert_eq!(parsed(&["--as-1970=load-transfer,tube-inertia"]), Ok(Some(two)));
        for wrong in ["--as-1970=", "--as-1970=tube", "--as-1970=tube-inertia,"] {
            assert_eq!(parsed(&[wrong]), Err(2));
        }
    }

    #[test]
    fn slips_that_nothing_shows_are_named_or_all_together() {
        let deck = include_str!("../tests/decks/boom.nml");
        let file = nboom_io::parse_deck("boom.nml", deck, "boom").expect("a deck");
        let idle = |slips: &[Slip]| {
            let args = SlipArgs { as_1970: Some(slips.iter().copied().collect()) };
            args.idle(&StressArgs::default().wanted((&file, &file.scene), Slips::default()))
        };
        // One boom without a spring.
        for slip in Slip::ALL {
            assert_eq!(idle(&[slip]), [slip.name()]);
        }
        assert_eq!(idle(&Slip::ALL), ["all"]);
        let args = SlipArgs { as_1970: Some(Slips::all()) };
        let computed = StressArgs::default().wanted((&file, &file.scene), Slips::default());
        assert_eq!(args.warning(&computed), None);
        assert!(idle(&[]).is_empty());
    }

    #[test]
    fn loads_of_hinges_show_how_they_are_handed_on() {
        let wing = include_str!("../../../examples/wing.toml");
        let file = nboom_io::parse_scene("wing.toml", wing, "wing", None, &ReadOptions::default())
            .expect("a scene");
        let args = SlipArgs { as_1970: Some([Slip::LoadTransfer].into_iter().collect()) };
        let idle = |hinge_loads| {
            let stresses = StressArgs { no_stresses: true, hinge_loads, ..StressArgs::default() };
            args.idle(&stresses.wanted((&file, &file.scene), Slips::default()))
        };
        assert!(idle(true).is_empty());
        let args = SlipArgs { as_1970: Some(Slips::all()) };
        let stresses = StressArgs { no_stresses: true, hinge_loads: true, ..StressArgs::default() };
        let warning = args.warning(&stresses.wanted((&file, &file.scene), Slips::default()));
        assert_eq!(warning.as_deref(), Some("wrong on purpose, as in 1970: load-transfer"));
        assert_eq!(idle(false), ["load-transfer"]);
    }

    #[test]
    fn help_names_every_slip() {
        let command = Cli::command();
        let run = command.find_subcommand("run").expect("a command");
        let option = run.get_arguments().find(|arg| arg.get_id() == "as_1970").expect("an option");
        let help = option.get_help().expect("documented").to_string();
        assert!(Slip::ALL.iter().all(|slip| help.contains(slip.name())), "{help}");
    }
}
