use std::fmt::Write;

use nboom_formulation::assumptions_in_a_word;
use nboom_io::{Holds, SCENE, TableKind, all_tables};
use nboom_model::Quantity;
use nboom_results::{FILES, PLOTS_FOLDER};
use nboom_sim::{Form, Method};

use crate::Routines;

/// Names of the tables of a scene that describe laws.
const LAWS: [&str; 8] =
    ["spring", "damper", "coupling", "kick_off", "gravity", "thrust", "thruster", "torque"];

/// All that a run can choose from: formulations, integrators, laws, joints, outputs, stock routines.
pub(crate) fn text(routines: &Routines) -> String {
    let mut text = String::new();
    let mut chapter = |title: &str, rows: Vec<(String, String)>| {
        let _ = writeln!(text, "{title}");
        let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
        for (name, about) in rows {
            let _ = writeln!(text, "{}", format!("  {name:width$}  {about}").trim_end());
        }
        text.push('\n');
    };
    let row = |name: &str, about: &str| (name.to_owned(), about.to_owned());
    chapter(
        "formulations (--formulation)",
        Form::all().map(|form| row(form.name(), form.about())).collect(),
    );
    let methods = Method::ALL.into_iter().map(|method| row(method.name(), method.about()));
    chapter("integrators (--integrator)", methods.collect());
    let tables = all_tables(&SCENE);
    let laws = LAWS.iter().filter_map(|law| tables.iter().find(|table| table.name == *law));
    let torque = tables
        .iter()
        .flat_map(|table| table.keys)
        .find(|key| matches!(key.holds, Holds::AnglePairs));
    let laws = laws.map(|kind: &&TableKind| row(kind.name, kind.about));
    chapter("laws", laws.chain(torque.map(|key| row(key.name, key.about))).collect());
    let hinge = "turns about one axis of any direction; bodies may branch";
    let slide = "slides along one axis of any direction, as the stage of a telescopic mast";
    chapter("joints", vec![row("hinge", hinge), row("slide", slide)]);
    let files = FILES.iter().map(|file| row(file, ""));
    let plots = row(&format!("{PLOTS_FOLDER}/"), "figures, with --plots");
    chapter("files of a run", files.chain([plots]).collect());
    let quantities = Quantity::all().map(|quantity| row(quantity.name(), quantity.about()));
    chapter("quantities (columns of [output] in a scene)", quantities.collect());
    let kernels = routines.for_runs.iter();
    let stock = kernels.map(|kernel| {
        let result = kernel.result.replace('_', " ");
        let assumes = assumptions_in_a_word(kernel);
        row(kernel.topology, &format!("{result} by {}, {assumes}", kernel.formulation))
    });
    let mut stock: Vec<_> = stock.collect();
    stock.dedup();
    chapter("stock routines", stock);
    text.trim_end().to_owned() + "\n"
}
