use nboom_scalar::{Real, Vec3, Wrench};

/// Loads of every hinge and station at one time: force and moment on what is outboard of it,
/// segment axes \[F, FL\]; of impulses, \[FT, FLT\].
#[derive(Clone, Debug, PartialEq)]
pub struct LoadSet<R = f64> {
    pub(crate) hinges: Vec<Wrench<R>>,
    pub(crate) stations: Vec<Wrench<R>>,
    /// Where the stations of each segment start, and the end.
    starts: Vec<usize>,
    /// What describes the stresses of each station.
    pub(crate) stresses: Vec<[R; 6]>,
    /// For each hinge, the sum of the magnitudes of what its load about the axis is made of; along the
    /// axis where it slides.
    pub(crate) sizes: Vec<R>,
}

impl<R: Real> LoadSet<R> {
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
            stresses: vec![[R::zero(); 6]; starts[hinges]],
            starts,
            sizes: vec![R::zero(); hinges],
        }
    }

    /// P and Q that hinge `i` exerts on its outboard body, Q about the hinge point.
    pub fn hinge(&self, i: usize) -> Wrench<R> {
        self.hinges[i]
    }

    /// P and Q at every station of segment `i`, outboard ones first, on what is outboard of the
    /// station; Q about the station's point on the η axis.
    pub fn stations(&self, i: usize) -> &[Wrench<R>] {
        &self.stations[self.starts[i]..self.starts[i + 1]]
    }

    /// The six numbers that describe the stresses of each station of segment `i`, by the
    /// [`Influence`](crate::Influence) of its section; zeros without one.
    pub fn stresses(&self, i: usize) -> &[[R; 6]] {
        &self.stresses[self.starts[i]..self.starts[i + 1]]
    }

    pub(crate) fn stations_mut(&mut self, i: usize) -> &mut [Wrench<R>] {
        &mut self.stations[self.starts[i]..self.starts[i + 1]]
    }

    /// All numbers in one row: P and Q of each hinge, P and Q of each station, six numbers for the
    /// stresses of each station, and for each hinge the magnitude by which
    /// [`Loads::largest_torque_residual`](crate::Loads::largest_torque_residual) judges.
    pub fn numbers(&self) -> Vec<R> {
        let mut row = vec![R::zero(); self.count()];
        self.write(&mut row);
        row
    }

    /// Writes [`numbers`](Self::numbers) into a row.
    ///
    /// # Panics
    /// When the row has not [`count`](Self::count) places.
    pub fn write(&self, row: &mut [R]) {
        let (of_wrenches, rest) = row.split_at_mut(self.stress_at(0));
        let (of_stresses, of_sizes) = rest.split_at_mut(6 * self.stresses.len());
        let wrenches = self.hinges.iter().chain(&self.stations);
        for (place, load) in of_wrenches.chunks_exact_mut(6).zip(wrenches) {
            place[..3].copy_from_slice(&load.force.to_array());
            place[3..].copy_from_slice(&load.moment.to_array());
        }
        of_stresses.copy_from_slice(self.stresses.as_flattened());
        of_sizes.copy_from_slice(&self.sizes);
    }

    /// Where P and Q of hinge `i` start among the numbers.
    pub fn hinge_at(&self, i: usize) -> usize {
        6 * i
    }

    /// Where P and Q of a station, as counted over all segments, start among the numbers.
    pub fn station_at(&self, station: usize) -> usize {
        6 * (self.hinges.len() + station)
    }

    /// Where the numbers for the stresses of a station, as counted over all segments, start among the
    /// numbers.
    pub fn stress_at(&self, station: usize) -> usize {
        6 * (self.hinges.len() + self.stations.len() + station)
    }

    /// How many [`numbers`](Self::numbers) there are.
    pub fn count(&self) -> usize {
        7 * self.hinges.len() + 12 * self.stations.len()
    }

    /// Takes over [`numbers`](Self::numbers) of the same scene.
    ///
    /// # Panics
    /// When there are not [`count`](Self::count) of them.
    pub(crate) fn set_numbers(&mut self, numbers: &[R]) {
        let (of_hinges, rest) = numbers.split_at(6 * self.hinges.len());
        let (of_stations, rest) = rest.split_at(6 * self.stations.len());
        let (of_stresses, of_sizes) = rest.split_at(6 * self.stresses.len());
        let wrenches = [(&mut self.hinges, of_hinges), (&mut self.stations, of_stations)];
        for (wrenches, numbers) in wrenches {
            for (wrench, &[px, py, pz, qx, qy, qz]) in
                wrenches.iter_mut().zip(numbers.as_chunks().0)
            {
                let (force, moment) = (Vec3::new(px, py, pz), Vec3::new(qx, qy, qz));
                *wrench = Wrench { moment, force };
            }
        }
        self.stresses.copy_from_slice(of_stresses.as_chunks().0);
        self.sizes.copy_from_slice(of_sizes);
    }
}

impl LoadSet {
    /// Adds `factor` times the loads of `other`, which must be of the same scene.
    pub fn add_scaled(&mut self, other: &Self, factor: f64) {
        let of_self = self.hinges.iter_mut().chain(&mut self.stations);
        for (sum, part) in of_self.zip(other.hinges.iter().chain(&other.stations)) {
            sum.add(Wrench { moment: part.moment * factor, force: part.force * factor });
        }
        let stresses = self.stresses.as_flattened_mut().iter_mut();
        for (sum, part) in stresses.zip(other.stresses.as_flattened()) {
            *sum += part * factor;
        }
        for (sum, part) in self.sizes.iter_mut().zip(&other.sizes) {
            *sum += part * factor.abs();
        }
    }
}
