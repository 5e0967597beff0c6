use nboom_sections::Stress;

/// Which sign stresses have in files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StressSigns {
    /// Tension is positive, and shear stress as on a face whose normal points outboard.
    #[default]
    Tension,
    /// All components reversed, so that compression is positive, as in the report.
    Report,
}

impl StressSigns {
    /// The name in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tension => "tension positive",
            Self::Report => "compression positive, as in the report",
        }
    }

    /// σ₂₂, σ₂₁ and σ₂₃.
    pub(crate) fn components(self, stress: Stress) -> [f64; 3] {
        match self {
            Self::Tension => [stress.normal, stress.shear_xi, stress.shear_zeta],
            Self::Report => stress.in_report_signs(),
        }
    }

    /// The largest and the smallest principal stress.
    pub(crate) fn principal(self, stress: Stress) -> [f64; 2] {
        let [normal, shear_xi, shear_zeta] = self.components(stress);
        Stress { normal, shear_xi, shear_zeta }.principal()
    }
}
