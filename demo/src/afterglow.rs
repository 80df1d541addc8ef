//! AFTERGLOW DOC

use glam::Vec2;

use crate::render::trail::TrailPoint;

/// How long the path of the blade glows [s].
const AFTERGLOW: f32 = 0.7;

/// The paths that still glow.
#[derive(Clone, Debug, Default)]
pub struct Afterglow {
    /// With the seconds that each has left.
    trail_points: Vec<(TrailPoint, f32)>,
}

impl Afterglow {
    /// The blade is at a point of the screen, x and y from -1 to 1; `first` begins a path.
    pub fn add(&mut self, at: Vec2, first: bool) {
        self.trail_points.push((TrailPoint { at, glow: 1.0, first }, AFTERGLOW));
    }

    /// Lets `seconds` pass.
    pub fn fade(&mut self, seconds: f32) {
        for (spark, left) in &mut self.trail_points {
            *left -= seconds;
            spark.glow = (*left / AFTERGLOW).max(0.0);
        }
        let out = self.trail_points.iter().take_while(|(_, left)| *left <= 0.0).count();
        self.trail_points.drain(..out);
        if let Some((spark, _)) = self.trail_points.first_mut() {
            spark.first = true;
        }
    }

    /// What there is to draw.
    pub fn trail_points(&self) -> impl Iterator<Item = TrailPoint> + '_ {
        self.trail_points.iter().map(|(spark, _)| *spark)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_goes_out_from_its_beginning_and_stays_one_path() {
        let mut glow = Afterglow::default();
        for i in 0..10 {
            glow.add(Vec2::X * i as f32, i == 0);
            glow.fade(0.1);
        }
        let left: Vec<_> = glow.trail_points().collect();
        assert_eq!(left.len(), 6);
        assert!(left[0].first && left[1..].iter().all(|spark| !spark.first));
        assert!(left.windows(2).all(|two| two[0].glow < two[1].glow));
        glow.fade(1.0);
        assert_eq!(glow.trail_points().count(), 0);
    }
}
