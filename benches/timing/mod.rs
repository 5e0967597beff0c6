//! States to evaluate at, and what a call takes.

use std::time::Instant;

use nboom::scalar::Vec3;

/// Different states, so that nothing can be learnt from one.
pub const STATES: usize = 64;
const SAMPLES: usize = 1000;

pub struct State {
    pub omega: Vec3<f64>,
    pub beta: Vec<f64>,
    pub tau: Vec<f64>,
}

pub fn state(i: usize, hinges: usize) -> State {
    let all = numbers(i, 3 + 2 * hinges);
    State {
        omega: Vec3::new(all[0], all[1], all[2]),
        beta: all[3..3 + hinges].to_vec(),
        tau: all[3 + hinges..].to_vec(),
    }
}

/// Numbers between −2 and 2, different for each `i`.
pub fn numbers(i: usize, count: usize) -> Vec<f64> {
    (0..count).map(|j| 2.0 * (1.7 * j as f64 + 0.9 * i as f64 + 0.3).sin()).collect()
}

/// Shortest and median time of a call \[ns\].
pub fn time(mut call: impl FnMut(usize)) -> (f64, f64) {
    (0..2000).for_each(|i| call(i % STATES));
    let mut samples: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            let start = Instant::now();
            (0..STATES).for_each(&mut call);
            start.elapsed().as_secs_f64() * 1e9 / STATES as f64
        })
        .collect();
    samples.sort_by(f64::total_cmp);
    (samples[0], samples[SAMPLES / 2])
}
