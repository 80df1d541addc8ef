//! Blade: cuts the cloth along the swipe of a pointer.
//!
//! Method: a swipe arrives in pieces. The cutting surface of a piece is a parallelogram through the
//! piece, with the depth of the cloth at both of its ends. [`muslin::Cloth::cut`] ends a cut at the
//! last edge before the end of the piece, so the next piece starts at the end of the real cut, even
//! if the cloth has moved since.
//!
//! Reads pointer positions and the camera view; writes the topology of the cloths.
//!
//! Invariant: consecutive pieces of a swipe over cloth make one connected cut.

use glam::Vec2;
use muslin::{Error, EventKind, Result};

use crate::picking::PickContext;

/// Extent of the cutting surface in front of the cloth and behind it, in drawn metres.
const DEPTH: f32 = 0.4;
/// Number of intervals along a piece between the rays that measure the depth of the cloth.
const DEPTH_SAMPLES: u32 = 12;
/// Least length of a piece, in edges of the cloth; a shorter piece waits for the next pointer move.
const MIN_EDGES: f32 = 1.6;

/// Particle at the end of a cut.
#[derive(Clone, Copy, Debug)]
struct CutEnd {
    cloth: usize,
    particle: u32,
}

/// The state of a swipe of one pointer.
#[derive(Clone, Copy, Debug)]
pub struct Swipe {
    /// Start of the next piece [px], if it does not continue a cut.
    from: Vec2,
    /// End of the cut so far.
    end: Option<CutEnd>,
}

impl Swipe {
    /// Starts a swipe at a point of the screen [px].
    pub fn new(from: Vec2) -> Self {
        Self { from, end: None }
    }

    /// Cuts up to a point of the screen [px]. A short piece waits until it is longer, unless it is
    /// the `last`.
    ///
    /// # Errors
    /// As [`muslin::Cloth::cut`]. A cloth without free particles is no error: it is not cut any
    /// further.
    pub fn cut_to(&mut self, to: Vec2, last: bool, pick: &mut PickContext<'_>) -> Result<()> {
        let start = self.start(pick);
        let edge = pick.edge_pixels();
        if start.distance(to) < if last { 1.0 } else { MIN_EDGES * edge } {
            return Ok(());
        }
        let direction = (to - start).normalize_or_zero();
        // The piece starts a little earlier, so that it passes through the end of the cut.
        let from = if self.end.is_some() { start - direction * (0.1 * edge) } else { start };
        let end = cut(from, to, pick)?;
        let over_cloth = pick.depth(to)?.is_some();
        if !over_cloth {
            *self = Self::new(to);
        } else if end.is_some() {
            self.end = end;
        }
        Ok(())
    }

    fn start(&self, pick: &PickContext<'_>) -> Vec2 {
        let end = self
            .end
            .and_then(|end| pick.cloths.get(end.cloth)?.positions().get(end.particle as usize));
        end.and_then(|at| pick.pixels(*at)).unwrap_or(self.from)
    }
}

/// Cuts every cloth along a straight piece of a swipe and returns the end of the cut, if there is
/// one.
fn cut(from: Vec2, to: Vec2, pick: &mut PickContext<'_>) -> Result<Option<CutEnd>> {
    let mut samples = Vec::new();
    for i in 0..=DEPTH_SAMPLES {
        let share = i as f32 / DEPTH_SAMPLES as f32;
        samples.extend(pick.depth(from.lerp(to, share))?.map(|depth| (share, depth)));
    }
    let (Some(first), Some(last)) = (samples.first().copied(), samples.last().copied()) else {
        return Ok(None);
    };
    // A plane through the eye, at the depth of the nearest cloth at both ends.
    let (a, b) = (pick.at_depth(from, first.1), pick.at_depth(to, last.1));
    let into = ((a + b) * 0.5 - pick.view.eye).normalize_or_zero();
    let depth = into * (DEPTH * pick.unit);
    let direction = to - from;
    let mut end: Option<(f32, CutEnd)> = None;
    for cloth in 0..pick.cloths.len() {
        let cut = &mut pick.cloths[cloth];
        while cut.next_event().is_some() {}
        match cut.cut(a - depth, b - depth, depth * 2.0) {
            // The piece is too short to have a direction, or the cloth has no free particles.
            Ok(0) | Err(Error::Full { .. } | Error::BadValue { .. }) => continue,
            Ok(_) => {}
            Err(error) => return Err(error),
        }
        while let Some(event) = pick.cloths[cloth].next_event() {
            let touched = match event.kind {
                EventKind::EdgeDivided => [event.vertex; 2],
                EventKind::EdgeTorn => [event.particle_a, event.particle_b],
                _ => continue,
            };
            for particle in touched {
                let at = pick.cloths[cloth].positions().get(particle as usize).copied();
                if let Some(at) = at.and_then(|at| pick.pixels(at)) {
                    let far = (at - from).dot(direction);
                    if end.is_none_or(|(farthest, _)| far > farthest) {
                        end = Some((far, CutEnd { cloth, particle }));
                    }
                }
            }
        }
    }
    Ok(end.map(|(_, cut_end)| cut_end))
}
