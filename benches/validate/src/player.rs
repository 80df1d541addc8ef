//! Plays a cloth, measures the processor time of its ticks, and waits for rest.

use cpu_time::ThreadTime;
use muslin::Cloth;
use muslin::glam::{DVec3, Vec3};

/// Damping of cases that are measured at rest [1/s]. It does not change where the cloth rests.
pub const DAMPING: f32 = 4.0;

/// RMS speed below which a cloth is at rest [m/s].
const REST_SPEED: f64 = 1.0e-3;
/// RMS displacement in a window below which a cloth is at rest, as a share of its size.
const REST_DISPLACEMENT: f64 = 1.0e-4;
/// For how long a cloth must be slow to be at rest [s].
const REST_WINDOW: f64 = 0.5;
/// A cloth that is not at rest after this time has not settled [s].
const LONGEST: f64 = 20.0;

/// A cloth that is played.
pub struct Player {
    pub cloth: Cloth,
    /// Whether the last wait for rest ended with rest; true before the first one.
    pub settled: bool,
    /// Greatest RMS speed in the last half second of that wait [m/s].
    pub rest_speed: f64,
    ticks: u32,
    seconds: f64,
}

impl Player {
    pub fn new(cloth: Cloth) -> Self {
        Self { cloth, settled: true, rest_speed: 0.0, ticks: 0, seconds: 0.0 }
    }

    pub fn step(&mut self, ticks: u32) {
        let start = ThreadTime::now();
        self.cloth.step(ticks);
        self.seconds += start.elapsed().as_secs_f64();
        self.ticks += ticks;
    }

    /// Ticks in `seconds` [s].
    pub fn ticks_in(&self, seconds: f64) -> u32 {
        (seconds / f64::from(self.cloth.settings().tick)).round() as u32
    }

    /// Plays for `seconds` [s].
    pub fn play(&mut self, seconds: f64) {
        self.step(self.ticks_in(seconds));
    }

    /// Steps until the cloth, which is `size` [m] large, was slow for a window and hardly moved in
    /// it, for at most 20 s.
    pub fn settle(&mut self, size: f64) {
        let window = self.ticks_in(REST_WINDOW);
        let windows = (LONGEST / REST_WINDOW) as u32;
        self.settled = (0..windows).any(|_| {
            let before = self.cloth.positions().to_vec();
            let mut fastest = 0.0_f64;
            for _ in 0..window {
                self.step(1);
                fastest = fastest.max(self.rms_speed());
            }
            let moved = rms(before.iter().zip(self.cloth.positions()).map(|(a, b)| *b - *a));
            self.rest_speed = fastest;
            fastest < REST_SPEED && moved < REST_DISPLACEMENT * size
        });
    }

    /// RMS speed of all particles [m/s].
    pub fn rms_speed(&self) -> f64 {
        rms(self.cloth.velocities())
    }

    /// Mean position of particles [m].
    pub fn mean(&self, particles: impl IntoIterator<Item = u32>) -> DVec3 {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for particle in particles {
            sum += self.cloth.positions()[particle as usize].as_dvec3();
            count += 1.0;
        }
        sum / count
    }

    /// Kinetic energy plus potential energy in the cloth's gravity [J].
    pub fn energy(&self) -> f64 {
        let gravity = self.cloth.settings().gravity.as_dvec3();
        let mut energy = 0.0;
        for (particle, x) in self.cloth.positions().iter().enumerate() {
            let particle = particle as u32;
            let mass = f64::from(self.cloth.mass(particle).unwrap_or_default());
            let speed = self.cloth.velocity(particle).unwrap_or_default().as_dvec3();
            energy += mass * (0.5 * speed.length_squared() - gravity.dot(x.as_dvec3()));
        }
        energy
    }

    /// Processor time of a tick [ms].
    pub fn ms_of_a_tick(&self) -> f64 {
        1.0e3 * self.seconds / f64::from(self.ticks.max(1))
    }
}

/// Root of the mean of the squared lengths.
fn rms(vectors: impl Iterator<Item = Vec3>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for vector in vectors {
        sum += vector.as_dvec3().length_squared();
        count += 1.0;
    }
    (sum / count).sqrt()
}
