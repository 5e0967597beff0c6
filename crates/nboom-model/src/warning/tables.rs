//! Finds torque tables beyond whose ends a hinge is driven on and on.

use super::ModelWarning;
use super::forces::{AngleTorque, NO_TORQUE};
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
    let mut open =
        sides.filter(|(side, _)| hinge.lock_angle.is_none_or(|lock| (lock - start) * side <= 0.0));
    open.find_map(|(side, last)| {
        let (end, stiffness) = (table.points[last][0], law.stiffness_beyond(last)?);
        let hinge = scene.label(i);
        law.drives_on(start, end, stiffness, side).then_some(ModelWarning::TableDrivesOn {
            hinge,
            start,
            end,
            stiffness,
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
    /// By how much the torque grows for each unit of the angle beyond an end of the table, if it does.
    fn stiffness_beyond(&self, last: usize) -> Option<f64> {
        let stiffness = self.spring.a1 + self.slopes[last];
        (self.spring.a2 == 0.0 && stiffness > 0.0).then_some(stiffness)
    }

    fn at(&self, beta: f64) -> f64 {
        let points = &self.table.points;
        let after = points.partition_point(|point| point[0] < beta);
        let tangent = |k: usize| points[k][1] + self.slopes[k] * (beta - points[k][0]);
        let of_table = match after {
            0 => tangent(0),
            after if after == points.len() => tangent(after - 1),
            after => {
                let (from, [c0, c1, c2, c3]) = self.table.cubic(&self.slopes, after - 1);
                let x = beta - from;
                ((c3 * x + c2) * x + c1) * x + c0
            }
        };
        self.spring.at(beta) + of_table
    }

    /// Whether the hinge comes from rest at `start` over all hills on one side, up or down, where the torque is straight
    /// beyond `end`.
    fn drives_on(&self, start: f64, end: f64, stiffness: f64, side: f64) -> bool {
        let straight = if (start - end) * side > 0.0 { start } else { end };
        let on_the_way = self.table.points.iter().map(|point| point[0]);
        let mut stops: Vec<f64> = on_the_way
            .filter(|at| (at - start) * side > 0.0 && (straight - at) * side > 0.0)
            .chain([start, straight])
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
        let inward = (-self.at(straight) * side).max(0.0);
        work >= inward * inward / (2.0 * stiffness) - NO_TORQUE * scale
    }
}
