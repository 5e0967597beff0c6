use nboom_scalar::Wrench;

/// Loads of every hinge and station at one time: force and moment on what is outboard of it,
/// segment axes \[F, FL\]; of impulses, \[FT, FLT\].
#[derive(Clone, Debug, PartialEq)]
pub struct LoadSet {
    pub(crate) hinges: Vec<Wrench<f64>>,
    pub(crate) stations: Vec<Wrench<f64>>,
    /// Where the stations of each segment start, and the end.
    starts: Vec<usize>,
    /// For each hinge, the sum of the magnitudes of what its load is made of.
    pub(crate) sizes: Vec<Size>,
}

/// Magnitudes of a moment and a force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Size {
    pub moment: f64,
    pub force: f64,
}

impl Size {
    pub fn add(&mut self, other: Self) {
        self.moment += other.moment;
        self.force += other.force;
    }
}

impl LoadSet {
    /// Zero loads for segments with these numbers of stations.
    pub(crate) fn new(counts: impl Iterator<Item = usize>) -> Self {
        let mut starts = vec![0];
        starts.extend(counts.scan(0, |end, count| {
            *end += count;
            Some(*end)
        }));
        let hinges = starts.len() - 1;
        Self {
            hinges: vec![Wrench::zero(); hinges],
            stations: vec![Wrench::zero(); starts[hinges]],
            starts,
            sizes: vec![Size::default(); hinges],
        }
    }

    /// P and Q that hinge `i` exerts on its outboard body, Q about the hinge point.
    pub fn hinge(&self, i: usize) -> Wrench<f64> {
        self.hinges[i]
    }

    /// P and Q at every station of segment `i`, outboard ones first, on what is outboard of the
    /// station; Q about the station's point on the η axis.
    pub fn stations(&self, i: usize) -> &[Wrench<f64>] {
        &self.stations[self.starts[i]..self.starts[i + 1]]
    }

    pub(crate) fn stations_mut(&mut self, i: usize) -> &mut [Wrench<f64>] {
        &mut self.stations[self.starts[i]..self.starts[i + 1]]
    }

    /// Adds `factor` times the loads of `other`, which must be of the same scene.
    pub fn add_scaled(&mut self, other: &Self, factor: f64) {
        let of_self = self.hinges.iter_mut().chain(&mut self.stations);
        for (sum, part) in of_self.zip(other.hinges.iter().chain(&other.stations)) {
            sum.add(Wrench { moment: part.moment * factor, force: part.force * factor });
        }
        for (sum, part) in self.sizes.iter_mut().zip(&other.sizes) {
            let factor = factor.abs();
            sum.add(Size { moment: part.moment * factor, force: part.force * factor });
        }
    }
}
