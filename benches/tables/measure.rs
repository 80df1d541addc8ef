//! Time measurement: rounds of several contenders are interleaved, so that the noise of a busy
//! machine affects all of them alike.

use cpu_time::ThreadTime;
use std::sync::OnceLock;
use std::time::Instant;

/// Returns the seconds since the first call. It is the clock for the stages of a cloth.
pub fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// Returns the processor time of this thread that `work` takes [s]; time of other threads is not
/// counted.
pub fn cpu_time(work: impl FnOnce()) -> f64 {
    let start = ThreadTime::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Returns the wall time that `work` takes [s], on any number of threads.
#[cfg(feature = "parallel")]
pub fn wall_time(work: impl FnOnce()) -> f64 {
    let start = clock();
    work();
    clock() - start
}

/// Measurements of one contender, one per round.
#[derive(Clone, Debug, Default)]
pub struct Samples(Vec<f64>);

impl Samples {
    /// Returns the minimum: the time without disturbance by other processes.
    pub fn min(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub fn median(&self) -> f64 {
        median(self.0.clone())
    }

    /// Returns by how many times this is faster than `slow`: the median of the ratios of the
    /// rounds.
    pub fn speedup_over(&self, slow: &Self) -> f64 {
        median(self.0.iter().zip(&slow.0).map(|(fast, slow)| slow / fast).collect())
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Measures each contender in turn, `rounds` times, after one round of warm-up.
pub fn measure_interleaved<const N: usize>(
    rounds: u32,
    mut contenders: [&mut dyn FnMut() -> f64; N],
) -> [Samples; N] {
    let mut samples = [(); N].map(|()| Samples::default());
    for contender in &mut contenders {
        contender();
    }
    for _ in 0..rounds {
        for (contender, samples) in contenders.iter_mut().zip(&mut samples) {
            samples.0.push(contender());
        }
    }
    samples
}
