//! Smoothed figures of how fast it runs.

/// How quickly a figure follows: the share that one frame has in it.
const FOLLOW: f64 = 0.06;

/// Frame time and simulation time, smoothed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter {
    frame: f64,
    simulation: f64,
}

impl Meter {
    /// A frame took so long [s].
    pub fn frame(&mut self, seconds: f32) {
        if seconds > 0.0 {
            blend(&mut self.frame, f64::from(seconds));
        }
    }

    /// The simulation of a frame took so long [s].
    pub fn simulated(&mut self, seconds: f64) {
        blend(&mut self.simulation, seconds.max(0.0));
    }

    /// Frames a second.
    pub fn fps(&self) -> f32 {
        if self.frame > 0.0 { (1.0 / self.frame) as f32 } else { 0.0 }
    }

    /// Simulation in a frame [ms].
    pub fn milliseconds(&self) -> f32 {
        (1000.0 * self.simulation) as f32
    }
}

fn blend(figure: &mut f64, value: f64) {
    *figure = if *figure == 0.0 { value } else { *figure + (value - *figure) * FOLLOW };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steady_frames_read_as_their_rate() {
        let mut meter = Meter::default();
        assert_eq!(meter.fps(), 0.0);
        meter.frame(0.5);
        for _ in 0..200 {
            meter.frame(1.0 / 60.0);
            meter.simulated(0.0015);
        }
        assert!((meter.fps() - 60.0).abs() < 0.5, "{} fps", meter.fps());
        assert!((meter.milliseconds() - 1.5).abs() < 0.01);
    }
}
