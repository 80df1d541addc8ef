//! The blade: a swipe over the screen that cuts the cloth behind it, and the path that glows after it.
//!
//! A swipe comes in pieces, and a piece that ends inside a triangle cuts only up to the edge before.
//! So the next piece starts where the slit really ended, wherever the cloth has swung by then.

use glam::Vec2;
use muslin::{Error, EventKind, Result};

use crate::pointer::Scene;
use crate::render::trail::Spark;

/// How far before and behind the cloth that it meets the blade reaches, as it is drawn [m].
const DEPTH: f32 = 0.4;
/// Places along a piece of a swipe where it is felt how far away the cloth is.
const FEELERS: u32 = 12;
/// A piece shorter than so many edges waits for more.
const LEAST: f32 = 1.6;

/// A particle of a cloth.
#[derive(Clone, Copy, Debug)]
struct Tip {
    cloth: usize,
    particle: u32,
}

/// A swipe of one pointer.
#[derive(Clone, Copy, Debug)]
pub struct Swipe {
    /// Where the next piece starts, in pixels, if no slit goes on from there.
    from: Vec2,
    /// The end of the slit so far.
    end: Option<Tip>,
}

impl Swipe {
    /// Begins at a point of the screen.
    pub fn new(from: Vec2) -> Self {
        Self { from, end: None }
    }

    /// Cuts up to a point of the screen; a short piece waits until it is longer, unless it is the
    /// `last`.
    ///
    /// # Errors
    /// As [`muslin::Cloth::cut`], but for a reserve that is used up: then nothing is cut any more.
    pub fn reach(&mut self, to: Vec2, last: bool, scene: &mut Scene<'_>) -> Result<()> {
        let ahead = self.from(scene);
        let edge = scene.edge_pixels();
        if ahead.distance(to) < if last { 1.0 } else { LEAST * edge } {
            return Ok(());
        }
        let way = (to - ahead).normalize_or_zero();
        // A hair back, so that the blade surely goes through the end of the slit.
        let from = if self.end.is_some() { ahead - way * (0.1 * edge) } else { ahead };
        let end = cut(from, to, scene)?;
        let over_cloth = scene.depth(to)?.is_some();
        if !over_cloth {
            *self = Self::new(to);
        } else if end.is_some() {
            self.end = end;
        }
        Ok(())
    }

    fn from(&self, scene: &Scene<'_>) -> Vec2 {
        let end = self
            .end
            .and_then(|end| scene.cloths.get(end.cloth)?.positions().get(end.particle as usize));
        end.and_then(|at| scene.pixels(*at)).unwrap_or(self.from)
    }
}

/// Cuts along a straight piece of a swipe and says where the slit ends, if there is one.
fn cut(from: Vec2, to: Vec2, scene: &mut Scene<'_>) -> Result<Option<Tip>> {
    let mut felt = Vec::new();
    for i in 0..=FEELERS {
        let share = i as f32 / FEELERS as f32;
        felt.extend(scene.depth(from.lerp(to, share))?.map(|depth| (share, depth)));
    }
    let (Some(first), Some(last)) = (felt.first().copied(), felt.last().copied()) else {
        return Ok(None);
    };
    // A plane through the eye, as deep at both ends as the cloth that is nearest to them.
    let (a, b) = (scene.at_depth(from, first.1), scene.at_depth(to, last.1));
    let into = ((a + b) * 0.5 - scene.sight.eye).normalize_or_zero();
    let depth = into * (DEPTH * scene.unit);
    let way = to - from;
    let mut end: Option<(f32, Tip)> = None;
    for cloth in 0..scene.cloths.len() {
        let cut = &mut scene.cloths[cloth];
        while cut.next_event().is_some() {}
        match cut.cut(a - depth, b - depth, depth * 2.0) {
            // A piece too short to have a direction, or no room for more.
            Ok(0) | Err(Error::Full { .. } | Error::BadValue { .. }) => continue,
            Ok(_) => {}
            Err(error) => return Err(error),
        }
        while let Some(event) = scene.cloths[cloth].next_event() {
            let touched = match event.kind {
                EventKind::EdgeDivided => [event.vertex; 2],
                EventKind::EdgeTorn => [event.particle_a, event.particle_b],
                _ => continue,
            };
            for particle in touched {
                let at = scene.cloths[cloth].positions().get(particle as usize).copied();
                if let Some(at) = at.and_then(|at| scene.pixels(at)) {
                    let far = (at - from).dot(way);
                    if end.is_none_or(|(farthest, _)| far > farthest) {
                        end = Some((far, Tip { cloth, particle }));
                    }
                }
            }
        }
    }
    Ok(end.map(|(_, tip)| tip))
}

/// How long the path of the blade glows [s].
const AFTERGLOW: f32 = 0.7;

/// The paths that still glow.
#[derive(Clone, Debug, Default)]
pub struct Afterglow {
    /// With the seconds that each has left.
    sparks: Vec<(Spark, f32)>,
}

impl Afterglow {
    /// The blade is at a point of the screen, x and y from -1 to 1; `first` begins a path.
    pub fn add(&mut self, at: Vec2, first: bool) {
        self.sparks.push((Spark { at, glow: 1.0, first }, AFTERGLOW));
    }

    /// Lets `seconds` pass.
    pub fn fade(&mut self, seconds: f32) {
        for (spark, left) in &mut self.sparks {
            *left -= seconds;
            spark.glow = (*left / AFTERGLOW).max(0.0);
        }
        let out = self.sparks.iter().take_while(|(_, left)| *left <= 0.0).count();
        self.sparks.drain(..out);
        if let Some((spark, _)) = self.sparks.first_mut() {
            spark.first = true;
        }
    }

    /// What there is to draw.
    pub fn sparks(&self) -> impl Iterator<Item = Spark> + '_ {
        self.sparks.iter().map(|(spark, _)| *spark)
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
        let left: Vec<_> = glow.sparks().collect();
        assert_eq!(left.len(), 6);
        assert!(left[0].first && left[1..].iter().all(|spark| !spark.first));
        assert!(left.windows(2).all(|two| two[0].glow < two[1].glow));
        glow.fade(1.0);
        assert_eq!(glow.sparks().count(), 0);
    }
}
