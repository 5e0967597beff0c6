use nboom_scalar::Real;

/// Products that are summed side by side, so that the compiler makes vector code of them.
pub(crate) const LANES: usize = 4;

/// A number of chunks that the compiler does not know.
pub(crate) const ANY: usize = usize::MAX;

/// Coefficients up to the current power of all operands of products, quotients, roots and sines.
/// They are kept in ascending and in descending order, so that a Cauchy product runs forward
/// through both. The index at which a history begins identifies it.
pub(crate) struct Histories<'a, R> {
    pub power: usize,
    pub order: usize,
    pub ascending: &'a mut [R],
    pub descending: &'a mut [R],
}

impl<R: Real> Histories<'_, R> {
    /// Appends the coefficient of the current power.
    #[inline(always)]
    pub fn keep(&mut self, history: usize, value: R) {
        self.put(history, self.power, value);
    }

    #[inline(always)]
    fn put(&mut self, history: usize, power: usize, value: R) {
        if power.is_multiple_of(LANES) {
            // Sums of whole chunks read beyond the last coefficient.
            self.ascending[history + power..][..LANES].fill(R::zero());
        }
        self.ascending[history + power] = value;
        self.descending[history + self.order - power] = value;
    }

    /// Σ a_j b_(power − j), in chunks of [`LANES`]. After the end of a descending history there are
    /// zeros.
    #[inline(always)]
    pub fn product<const CHUNKS: usize>(&self, a: usize, b: usize, power: usize) -> R {
        let chunks = if CHUNKS == ANY { (power + 1).div_ceil(LANES) } else { CHUNKS };
        let a = &self.ascending[a..][..chunks * LANES];
        let b = &self.descending[b + self.order - power..][..chunks * LANES];
        let mut sums = [R::zero(); LANES];
        for (a, b) in a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0) {
            for lane in 0..LANES {
                sums[lane] += a[lane] * b[lane];
            }
        }
        (sums[0] + sums[2]) + (sums[1] + sums[3])
    }

    /// q = a / b from q b = a; q is kept in `history`.
    #[inline(always)]
    pub fn quotient<const CHUNKS: usize>(&mut self, a: R, b: usize, history: usize) -> R {
        self.keep(history, R::zero());
        let known = self.product::<CHUNKS>(history, b, self.power);
        let quotient = (a - known) / self.ascending[b];
        self.keep(history, quotient);
        quotient
    }

    /// r = √a from r r = a; r is kept in `history`.
    #[inline(always)]
    pub fn root<const CHUNKS: usize>(&mut self, a: R, history: usize) -> R {
        let root = if self.power == 0 {
            a.sqrt()
        } else {
            self.keep(history, R::zero());
            let known = self.product::<CHUNKS>(history, history, self.power);
            let first = self.ascending[history];
            (a - known) / (first + first)
        };
        self.keep(history, root);
        root
    }

    /// s = sin a and c = cos a from ṡ = ȧ c and ċ = −ȧ s. `history` is that of ȧ; those of s and c
    /// follow, each `stride` apart.
    #[inline(always)]
    pub fn sine_and_cosine(&mut self, a: R, history: usize, stride: usize) -> (R, R) {
        let rate = history;
        let (sine, cosine) = (rate + stride, rate + 2 * stride);
        let (s, c) = match self.power.checked_sub(1) {
            None => a.sin_cos(),
            Some(before) => {
                let power = R::constant(self.power as f64);
                self.put(rate, before, a * power);
                let product = |with: usize| self.product::<ANY>(history, with, before);
                (product(cosine) / power, -(product(sine) / power))
            }
        };
        self.put(sine, self.power, s);
        self.put(cosine, self.power, c);
        (s, c)
    }
}
