/// What a scene repeats of the slips of the program of 1970 in the motion; by default nothing.
/// `docs/the-1970-program.md` has the evidence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MotionSlips {
    /// Kick-off springs of chains turn hinges with the forces that belong to α, eq. (6.17) as
    /// printed, not with those that belong to β.
    pub chain_kick_off: bool,
    /// Kick-off springs do not act on appendages that have a paddle.
    pub paddle_kick_off: bool,
    /// The inertia of paddles is turned by the angles of paddle and arm in the wrong order.
    pub paddle_inertia: bool,
}

impl MotionSlips {
    /// Whether forces and accelerations still obey Newton and Euler, as they do without a spring.
    pub fn obey_newton(self) -> bool {
        !(self.chain_kick_off || self.paddle_inertia)
    }
}
