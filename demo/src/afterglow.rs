//! Afterglow: the fading trail that the blade leaves on the screen.
//!
//! Method: each point of the trail starts with a glow of one, which falls linearly to zero in
//! [`AFTERGLOW`] seconds.
//!
//! Reads positions in normalised device coordinates and frame times; writes the [`TrailPoint`]s
//! that `render::trail` draws.
//!
//! Invariant: points are in the order of their age, and the oldest one always begins a path.

use glam::Vec2;

use crate::render::trail::TrailPoint;

/// Time after which a point of the trail is dark [s].
const AFTERGLOW: f32 = 0.7;

/// The points of all trails that still glow.
#[derive(Clone, Debug, Default)]
pub struct Afterglow {
    /// Each point with the time until it is dark [s].
    trail_points: Vec<(TrailPoint, f32)>,
}

impl Afterglow {
    /// Appends a point in normalised device coordinates (x and y from -1 to 1); `first` begins a
    /// new path.
    pub fn add(&mut self, at: Vec2, first: bool) {
        self.trail_points.push((TrailPoint { at, glow: 1.0, first }, AFTERGLOW));
    }

    /// Fades all points by `seconds` [s] and removes the dark ones.
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

    /// Returns the points to draw, oldest first.
    pub fn trail_points(&self) -> impl Iterator<Item = TrailPoint> + '_ {
        self.trail_points.iter().map(|(spark, _)| *spark)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trail_fades_from_its_oldest_point_and_stays_one_path() {
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
