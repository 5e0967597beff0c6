//! What a robot says that no scene takes over.

use std::collections::BTreeMap;

use super::reader::Reader;

/// What is left out of a robot, by kind.
#[derive(Default)]
pub(super) struct LeftOut {
    /// For each kind, and what of it joints have, the byte at which it first stands and these joints.
    of_joints: BTreeMap<(Kind, String), (usize, Vec<String>)>,
    /// For each tag, the byte at which it first stands and how often.
    elements: BTreeMap<String, (usize, usize)>,
}

/// A kind of number or relation of joints.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    Limits,
    Dynamics,
    /// Dynamics of a joint by which the robot floats.
    Drag,
    Mimicry,
}

impl Kind {
    /// Its tag, and how it is taken.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Limits => {
                ("limit", "none: joints move on beyond them; `stops` in a scene end their motion")
            }
            Self::Dynamics => {
                ("dynamics", "`damping` and `friction` alone: joints move without the rest")
            }
            Self::Drag => ("dynamics", "none: nothing brakes a robot that floats"),
            Self::Mimicry => ("mimic", "none: each joint moves by itself"),
        }
    }
}

impl LeftOut {
    /// What a joint has of a kind, in the words of the warning.
    pub fn of_joint(&mut self, kind: Kind, what: &str, at: usize, joint: &str) {
        let of_kind = self.of_joints.entry((kind, what.to_owned()));
        let (_, joints) = of_kind.or_insert((at, Vec::new()));
        joints.push(joint.replace(char::is_control, "\u{fffd}"));
    }

    pub fn element(&mut self, tag: &str, at: usize) {
        self.elements.entry(tag.to_owned()).or_insert((at, 0)).1 += 1;
    }

    /// A warning for each kind and what joints have of it, with all of these, and one with all elements.
    pub fn tell(&self, Reader { lines, report }: &mut Reader<'_, '_, '_>) {
        for ((kind, what), (at, joints)) in &self.of_joints {
            let (tag, taken) = kind.words();
            let joints = joints.join(", ");
            report.warn(lines.position(*at), tag, format!("{what} of {joints}"), taken);
        }
        let Some((first, (at, _))) = self.elements.iter().min_by_key(|(_, (at, _))| *at) else {
            return;
        };
        let counted = |(tag, (_, count)): (&String, &(usize, usize))| match count {
            1 => tag.clone(),
            _ => format!("{tag} ({count})"),
        };
        let all: Vec<String> = self.elements.iter().map(counted).collect();
        report.warn(
            lines.position(*at),
            first,
            all.join(", "),
            "links and joints; no motion depends on the rest",
        );
    }
}
