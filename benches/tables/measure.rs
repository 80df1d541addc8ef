//! Measuring several things so that the noise of a busy machine hits all of them alike.

use cpu_time::ThreadTime;
use std::sync::OnceLock;
use std::time::Instant;

/// Seconds since the first call: a clock for the stages of a cloth.
pub fn now() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// Seconds of this thread's processor time that `work` takes: what others do meanwhile is not in it.
pub fn seconds(work: impl FnOnce()) -> f64 {
    let start = ThreadTime::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Seconds that `work` takes on whatever threads, with all that others do meanwhile.
#[cfg(feature = "parallel")]
pub fn wall_seconds(work: impl FnOnce()) -> f64 {
    let start = now();
    work();
    now() - start
}

/// What was measured of one contender, a figure a round.
#[derive(Clone, Debug, Default)]
pub struct Figures(Vec<f64>);

impl Figures {
    /// The least: what the machine does when nobody disturbs it.
    pub fn min(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub fn median(&self) -> f64 {
        median(self.0.clone())
    }

    /// How many times less this is than `slow`: the median over the rounds.
    pub fn times_below(&self, slow: &Self) -> f64 {
        median(self.0.iter().zip(&slow.0).map(|(fast, slow)| slow / fast).collect())
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Asks each contender for a figure, in turn, `rounds` times; a first round only warms up.
pub fn in_turn<const N: usize>(
    rounds: u32,
    mut contenders: [&mut dyn FnMut() -> f64; N],
) -> [Figures; N] {
    let mut figures = [(); N].map(|()| Figures::default());
    for contender in &mut contenders {
        contender();
    }
    for _ in 0..rounds {
        for (contender, figures) in contenders.iter_mut().zip(&mut figures) {
            figures.0.push(contender());
        }
    }
    figures
}
