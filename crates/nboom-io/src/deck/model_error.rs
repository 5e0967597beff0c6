use nboom_model::{
    BodyName, ExternalPart, Finding, HingeLabel, HingeQuantity, MassDefect, ModelError,
    SceneQuantity, UnitQuantity,
};

use super::assignment::MOST_STATIONS;
use super::builder::Builder;
use super::values::plain;

/// Finds the assignment of the deck that is responsible for an error of the scene.
pub(crate) fn report(errors: &[ModelError], builder: &mut Builder<'_, '_, '_>) {
    for error in errors {
        let (name, index) = responsible(error, builder);
        let Finding { found, expected } = match error {
            // Slices without mass are no wheel.
            ModelError::Mass {
                defect: MassDefect::WheelInertia | MassDefect::WheelCarries,
                ..
            } if name == "DELM" => MassDefect::Mass(0.0).finding(),
            ModelError::Mass { defect, .. } => defect.finding(),
            other => other.finding_at_place(),
        };
        builder.error(plain(name), index, found, &expected);
    }
}

impl Builder<'_, '_, '_> {
    /// Number of the first segment of each appendage.
    fn first_segments(&self) -> Vec<usize> {
        let counts = (0..self.sizes.appendages).map(|k| self.values.real("NK", k) as usize);
        counts
            .scan(0_usize, |next, count| {
                let first = *next;
                *next = next.saturating_add(count);
                Some(first)
            })
            .collect()
    }

    /// Number of a segment, from 0, by appendage and segment.
    pub fn number_of_segment(&self, label: &HingeLabel) -> usize {
        let starts = self.first_segments();
        starts.get(label.appendage).copied().unwrap_or_default() + label.segment
    }

    /// Appendage and segment of segment number `i`, from 0.
    pub fn label_of_segment(&self, i: usize) -> HingeLabel {
        let starts = self.first_segments();
        let appendage = starts.iter().rposition(|&start| start <= i).unwrap_or_default();
        HingeLabel::new(appendage, i - starts.get(appendage).copied().unwrap_or_default())
    }

    fn initial_angle_name(&self) -> &'static str {
        if self.values.real("IAB", 0) == 0.0 { "BETAIK" } else { "ALIK" }
    }

    fn initial_rate_name(&self) -> &'static str {
        if self.values.real("IAB", 0) == 0.0 { "TAUIK" } else { "SIGIK" }
    }

    fn orientation_name(&self) -> &'static str {
        if self.values.real("IXYZ", 0) == 0.0 { "FTSM" } else { "EMO" }
    }
}

/// The symbol and the element in storage order.
fn responsible(error: &ModelError, builder: &Builder<'_, '_, '_>) -> (&'static str, usize) {
    let number = |label: &HingeLabel| builder.number_of_segment(label);
    match error {
        ModelError::Mass { body: BodyName::MainBody, .. } => {
            if builder.values.get("EMM", 0).is_none_or(|mass| mass > 0.0) {
                ("HM", 0)
            } else {
                ("EMM", 0)
            }
        }
        ModelError::Mass { body: BodyName::Segment(label), .. } => {
            let i = number(label);
            if builder.values.is_by_slices(i) {
                ("DELM", MOST_STATIONS * i)
            } else if builder.values.get("EMIK", i).is_none_or(|mass| mass > 0.0) {
                ("HIIK", 9 * i)
            } else {
                ("EMIK", i)
            }
        }
        // Numbers of a deck are finite; these are overflows in numbers computed from them.
        ModelError::NotFinite { quantity } => match quantity {
            SceneQuantity::InitialTime => ("TZO", 0),
            SceneQuantity::InitialPosition => ("RHO", 0),
            SceneQuantity::InitialVelocity => ("VBAR", 0),
            SceneQuantity::InitialRate => ("OMEG", 0),
            SceneQuantity::EndTime | SceneQuantity::Duration => ("TF", 0),
            SceneQuantity::Gravity => ("G", 0),
        },
        ModelError::NotFiniteInHinge { label, quantity } => {
            let i = number(label);
            match quantity {
                HingeQuantity::Points => ("ELIK", i),
                HingeQuantity::Spring => ("EKNIK", i),
                // Decks have no friction.
                HingeQuantity::Dashpot | HingeQuantity::Friction => ("QNIK", i),
                HingeQuantity::Start => (builder.initial_angle_name(), i),
                HingeQuantity::LockAngle => ("BSIK", i),
                HingeQuantity::Release => ("RELTB", i),
                HingeQuantity::KickOff => ("AES", 4 * i),
            }
        }
        ModelError::Order { label, .. } => ("NK", label.appendage),
        ModelError::Axis { label, .. } | ModelError::MountRotation { label, .. } => {
            ("FTSIK", 3 * label.appendage)
        }
        ModelError::Trigger { label, .. } => ("IREL", number(label)),
        ModelError::KickOffLimit { label, .. } => ("XIKF", number(label)),
        ModelError::HeldRate { label, .. } => (builder.initial_rate_name(), number(label)),
        ModelError::NotUnit { quantity, .. } => match quantity {
            UnitQuantity::InitialAttitude => (builder.orientation_name(), 0),
            UnitQuantity::GravityDirection => ("GHAT", 0),
        },
        ModelError::External { part: ExternalPart::Course, .. } => ("TFIN", 0),
        ModelError::External { .. } => ("FT", 0),
        // Errors of the end of the run, and of the whole scene in later versions of the model.
        _ => ("TF", 0),
    }
}
