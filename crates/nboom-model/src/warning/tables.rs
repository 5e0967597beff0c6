//! Finds torque tables beyond whose ends a hinge is driven on and on.

use super::ModelWarning;
use super::forces::{AngleTorque, NO_TORQUE, is_endless};
use crate::{Scene, TorqueTable};

/// Parts of the way between two points of a table in which its work is summed up.
const PARTS: u32 = 32;

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    scene.torque_tables.iter().filter_map(|table| of_table(scene, table)).collect()
}

fn of_table(scene: &Scene, table: &TorqueTable) -> Option<ModelWarning> {
    let (i, hinge) = (table.hinge, &scene.bodies[table.hinge].hinge);
    let is_coupled = scene.couplings.iter().any(|coupling| coupling.hinges.contains(&i));
    if is_coupled || !hinge.can_turn() {
        return None;
    }
    let (spring, slopes, start) = (AngleTorque::of(hinge), table.slopes(), hinge.start.angle);
    let law = Law { spring, table, slopes };
    let sides = [(-1.0, 0), (1.0, table.points.len() - 1)].into_iter();
    let mut open = sides.filter(|(side, _)| is_endless(hinge, *side));
    open.find_map(|(side, last)| {
        let (end, beyond) = (table.points[last][0], law.beyond(last));
        let hinge = scene.label(i);
        law.drives_on(start, end, &beyond, side).then_some(match beyond.a2 {
            0.0 => ModelWarning::TableDrivesOn { hinge, start, end, stiffness: beyond.a1 },
            // Far out the square is more than any table.
            _ => ModelWarning::SpringDrivesOn { hinge, start },
        })
    })
}

/// The torque of spring, dashpot and table of a hinge at rest.
struct Law<'t> {
    spring: AngleTorque,
    table: &'t TorqueTable,
    slopes: Vec<f64>,
}

impl Law<'_> {
    /// The torque beyond an end of the table.
    fn beyond(&self, last: usize) -> AngleTorque {
        let (AngleTorque { a2, a1, a0 }, slope) = (self.spring, self.slopes[last]);
        let [end, torque] = self.table.points[last];
        AngleTorque { a2, a1: a1 + slope, a0: a0 + torque - slope * end }
    }

    fn at(&self, beta: f64) -> f64 {
        self.spring.at(beta) + self.table.at(&self.slopes, beta)
    }

    /// Whether the hinge comes from rest at `start` over all hills on one side, up or down, where the torque is that
    /// `beyond` from `end` on.
    fn drives_on(&self, start: f64, end: f64, beyond: &AngleTorque, side: f64) -> bool {
        let outer = if (start - end) * side > 0.0 { start } else { end };
        let Some(hill) = beyond.hill(outer, side) else { return false };
        let on_the_way = self.table.points.iter().map(|point| point[0]);
        let mut stops: Vec<f64> = on_the_way
            .filter(|at| (at - start) * side > 0.0 && (outer - at) * side > 0.0)
            .chain([start, outer])
            .collect();
        stops.sort_by(f64::total_cmp);
        if side < 0.0 {
            stops.reverse();
        }
        let (mut work, mut scale) = (0.0, 0.0);
        for pair in stops.windows(2) {
            let step = (pair[1] - pair[0]) / f64::from(PARTS);
            for part in 0..PARTS {
                let from = pair[0] + f64::from(part) * step;
                let [m0, m, m1] = [0.0, 0.5, 1.0].map(|share| self.at(from + share * step));
                work += step / 6.0 * (m0 + 4.0 * m + m1);
                scale += step.abs() * m.abs();
                if work < -NO_TORQUE * scale {
                    return false;
                }
            }
        }
        work >= hill - NO_TORQUE * scale
    }
}
