use nboom_formulation::Layout;
use nboom_model::{Shape, Topology};

/// How freely generated code may rearrange arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// Every value is that of the closed form on the same scalar.
    Exact,
    /// Products and sums are fused where the scalar can round once.
    Fast,
}

impl Level {
    /// `exact` or `fast`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Fast => "fast",
        }
    }
}

/// What to generate.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Name of the type that implements the routine, a Rust identifier.
    pub name: String,
    /// Path of the crate `nboom_scalar` where the code will stand.
    pub scalar_path: String,
    /// The satellite's appendages.
    pub topology: Topology,
    /// Parameters that the code takes for granted; `None` stays a runtime value.
    pub pinned: Vec<Option<f64>>,
    /// Whether anything acts on the main body from outside.
    pub external: bool,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
}

impl Request {
    /// Code for a topology with all parameters at run time, without external wrench.
    pub fn new(name: &str, topology: Topology, level: Level) -> Self {
        let pinned = vec![None; Layout::parameters(&topology)];
        Self {
            name: name.to_owned(),
            scalar_path: "::nboom_scalar".to_owned(),
            topology,
            pinned,
            external: false,
            level,
        }
    }

    /// Code that also takes an external wrench on the main body.
    pub fn with_external_wrench(mut self) -> Self {
        self.external = true;
        self
    }

    /// Takes every parameter for granted: code for one satellite.
    ///
    /// `parameters` are the numbers that `nboom_formulation::Parameters::write` gives.
    pub fn baked(mut self, parameters: &[f64]) -> Self {
        self.pinned = parameters.iter().copied().map(Some).collect();
        self
    }

    /// Takes for granted what holds of the report's decks: every mass centre on its segment's
    /// η axis, every inertia along the segment axes, O at the main body's mass centre.
    pub fn with_principal_axes(mut self) -> Self {
        const FIRST_MOMENT_X: usize = 1;
        const FIRST_MOMENT_Z: usize = 3;
        const PRODUCTS: [usize; 3] = [7, 8, 9];
        const NEXT_Z: usize = 11;
        for at in [1, 2, 3, 7, 8, 9] {
            self.pinned[at] = Some(0.0);
        }
        for link in links(&self.topology) {
            for at in [FIRST_MOMENT_X, FIRST_MOMENT_Z, NEXT_Z].into_iter().chain(PRODUCTS) {
                self.pinned[link + at] = Some(0.0);
            }
        }
        self
    }
}

/// Where the numbers of each link begin.
fn links(topology: &Topology) -> Vec<usize> {
    let mut at = Layout::MAIN;
    let mut links = Vec::new();
    for shape in topology.shapes() {
        at += Layout::BRANCH;
        for _ in 0..Shape::hinges(*shape) {
            links.push(at);
            at += Layout::LINK;
        }
    }
    links
}
