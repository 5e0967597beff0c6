/// How the main body is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// It moves freely.
    #[default]
    Free,
    /// It is fixed to the ground, a test rig: it keeps its attitude and position.
    Fixed,
}

impl Base {
    /// Whether something other than the equations of motion says how the main body moves.
    pub fn is_held(self) -> bool {
        self != Self::Free
    }
}
