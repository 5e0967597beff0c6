/// A spring and a damper between the coordinates of two hinges, wherever they are in the tree: on the first the
/// torque −k (β₁ − ρ β₂ − θ) − c (τ₁ − ρ τ₂), on the second −ρ times that. One that is not mutual follows the
/// second hinge and acts on the first alone, with −k (ρ β₂ − θ) − c ρ τ₂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Indices of both hinges, from 0.
    pub hinges: [usize; 2],
    /// ρ: how far the first goes for each unit of the second where nothing pushes.
    pub ratio: f64,
    /// k, positive if it drives towards θ.
    pub stiffness: f64,
    /// θ: β₁ − ρ β₂, or ρ β₂, without torque, in units of the first.
    pub rest: f64,
    /// c, positive if it brakes.
    pub damping: f64,
    /// Whether it acts on the second hinge as well. One that does not is no spring between bodies but what a
    /// controller does; it has no potential.
    pub is_mutual: bool,
}

impl Coupling {
    /// Whether it never exerts a torque.
    pub fn is_nothing(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0
    }
}
