use crate::load_set::LoadSet;
use crate::loads::Loads;
use crate::segment::Segment;

impl Loads {
    /// Puts what the program of 1970 handed from segment to segment in place of what it should have,
    /// eq. (14.13): the load of the last station, turned by the angle of the inboard segment's own
    /// hinge about the axis of that hinge, note 28. A slide turns nothing, neither here nor there.
    ///
    /// `loads` holds right loads, of a motion, a lock-up or an impact, in the posture `beta`. A segment
    /// without stations hands on the load of its hinge.
    pub fn hand_on_as_in_1970(&self, beta: &[f64], loads: &mut LoadSet) {
        let right = loads.hinges.clone();
        for (i, segment) in self.equations().segments.iter().enumerate().rev() {
            let Some(inboard) = segment.inboard else { continue };
            let turned_as = |other: usize| {
                let Segment { joint, axis, .. } = self.equations().segments[other];
                segment.rot_inboard_at_zero * joint.turn(axis, beta[other])
            };
            let (own, of_1970) = (turned_as(i), turned_as(inboard));
            let handed_on = loads.stations(i).last().copied().unwrap_or(loads.hinges[i]);
            let mut change = handed_on.rotated(&of_1970);
            change.subtract(right[i].rotated(&own));
            let change = change.seen_from(segment.offset(beta[i]));
            loads.hinges[inboard].add(change);
            let cuts = &self.equations().segments[inboard].stations;
            let carriers = loads.stations_mut(inboard).iter_mut().zip(cuts);
            for (load, cut) in carriers.skip(segment.carried_from) {
                load.add(change.seen_from(-cut.point));
            }
        }
        self.equations().describe_stresses(loads);
    }
}
