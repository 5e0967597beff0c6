//! Forces of kick-off springs, which no table has: they follow from the motion and the events.

use nboom_elements::KickOffLaw;
use nboom_model::Posture;

use crate::Run;
use crate::table::Table;

/// Forces in columns like `force_1_2`, in the rows of the motion; nothing without springs. A spring lets go and takes
/// hold at its events: at its limit length only they say on which side the motion is.
pub(crate) fn of(run: &Run) -> Option<Table> {
    let (scene, motion) = (run.scene()?, run.motion()?);
    let hinges = run.hinges();
    let sprung = scene.bodies.iter().enumerate();
    let sprung = sprung.filter_map(|(i, body)| Some((i, body.hinge.kick_off?)));
    let sprung: Vec<_> = sprung.collect();
    if sprung.is_empty() {
        return None;
    }
    let columns = hinges.iter().map(|hinge| motion.column(&format!("beta_{}", hinge.key)));
    let columns: Vec<&[f64]> = columns.collect::<Option<_>>()?;
    let names = sprung.iter().map(|(i, _)| format!("force_{}", hinges[*i].key));
    let mut table = Table::new(["t".to_owned()].into_iter().chain(names).collect());
    let mut acts: Vec<Option<bool>> = vec![None; sprung.len()];
    let mut events = run.events().iter().peekable();
    let times = motion.times();
    let mut numbers = Vec::with_capacity(sprung.len() + 1);
    for (row, &time) in times.iter().enumerate() {
        // Of rows at one time the last is after what happens then.
        let is_after = times.get(row + 1) != Some(&time);
        while let Some(event) =
            events.next_if(|event| event.t < time || is_after && event.t == time)
        {
            let place = sprung.iter().position(|(i, _)| {
                let hinge = &hinges[*i];
                (Some(hinge.appendage), Some(hinge.segment)) == (event.appendage, event.segment)
            });
            match (place, event.kind.as_str()) {
                (Some(place), "kick_off_engage") => acts[place] = Some(true),
                (Some(place), "kick_off_disengage") => acts[place] = Some(false),
                _ => {}
            }
        }
        let angles: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        let posture = Posture::new(scene, &angles);
        numbers.clear();
        numbers.push(time);
        for ((i, spring), acts) in sprung.iter().zip(&mut acts) {
            let length = (posture.hinges[*i].kick_off - spring.main_body_point).norm();
            let acts = *acts.get_or_insert(length <= spring.limit_length);
            let force = KickOffLaw::new(spring.coefficients).force(length);
            numbers.push(if acts { force } else { 0.0 });
        }
        table.push(&numbers);
    }
    Some(table)
}
