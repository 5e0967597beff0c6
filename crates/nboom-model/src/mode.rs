use crate::{HingeState, Scene};

/// Everything discontinuous about a scene at one moment.
///
/// Equations of motion are smooth within a mode; only events change it.
#[derive(Clone, Debug, Eq)]
pub struct Mode {
    /// State of each hinge.
    pub hinges: Vec<HingeState>,
    /// The piece that holds of each force law that has several, counted from 0, in the order of
    /// [`SceneDescription::pieces_at_rest`](crate::SceneDescription::pieces_at_rest).
    pub pieces: Vec<usize>,
    /// The piece that holds of the [`Course`](crate::Course) of each force and torque from outside,
    /// as the scene lists them.
    pub externals: Vec<usize>,
    /// The piece that holds of the prescribed motion of the main body.
    pub drive: usize,
    /// The piece that holds of the [speed](crate::RotorSpeed) of each rotor.
    pub rotors: Vec<usize>,
}

impl PartialEq for Mode {
    fn eq(&self, other: &Self) -> bool {
        // Most lists are empty. Compared as memory, an empty one may cost hundreds of cycles: a masked load
        // from where nothing is.
        let are_same = |a: &[usize], b: &[usize]| a.iter().eq(b);
        let Self { hinges, pieces, externals, drive, rotors } = self;
        *drive == other.drive
            && *hinges == other.hinges
            && are_same(pieces, &other.pieces)
            && are_same(externals, &other.externals)
            && are_same(rotors, &other.rotors)
    }
}

impl Mode {
    /// Hinge states as the scene starts, no kick-off spring acting and nothing from outside.
    pub fn at_start(scene: &Scene) -> Self {
        Self {
            hinges: scene.bodies.iter().map(|body| body.hinge.start.state).collect(),
            pieces: scene.pieces_at_rest(),
            externals: vec![0; scene.externals.len()],
            drive: 0,
            rotors: vec![0; scene.rotors.len()],
        }
    }

    /// The mode with all kick-off springs pushing, whatever their lengths, or none of them.
    pub fn with_kick_offs(mut self, scene: &Scene, push: bool) -> Self {
        let springs = scene.bodies.iter().filter(|body| body.hinge.kick_off.is_some()).count();
        self.pieces[..springs].fill(usize::from(!push));
        self
    }

    /// Whether hinge `i` turns.
    pub fn is_free(&self, i: usize) -> bool {
        self.hinges[i] == HingeState::Free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_that_differ_in_one_thing_differ() {
        let mode = Mode {
            hinges: vec![HingeState::Free, HingeState::Locked],
            pieces: vec![0, 1],
            externals: vec![2],
            drive: 1,
            rotors: vec![3],
        };
        assert_eq!(mode, mode.clone());
        let others = [
            Mode { hinges: vec![HingeState::Locked; 2], ..mode.clone() },
            Mode { pieces: vec![0, 2], ..mode.clone() },
            Mode { externals: vec![2, 0], ..mode.clone() },
            Mode { drive: 0, ..mode.clone() },
            Mode { rotors: Vec::new(), ..mode.clone() },
        ];
        assert!(others.iter().all(|other| *other != mode));
    }
}
