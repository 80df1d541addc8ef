//! The blade: a swipe over the screen that cuts the cloth behind it, and the path that glows after it.
//!
//! A swipe comes in pieces, and a piece that ends inside a triangle cuts only up to the edge before.
//! So the next piece starts where the slit really ended, wherever the cloth has swung by then.

use glam::Vec2;
use muslin::{Error, EventKind, Result};

use crate::picking::PickContext;

/// How far before and behind the cloth that it meets the blade reaches, as it is drawn [m].
const DEPTH: f32 = 0.4;
/// Places along a piece of a swipe where it is samples how far away the cloth is.
const DEPTH_SAMPLES: u32 = 12;
/// A piece shorter than so many edges waits for more.
const MIN_EDGES: f32 = 1.6;

/// A particle of a cloth.
#[derive(Clone, Copy, Debug)]
struct CutEnd {
    cloth: usize,
    particle: u32,
}

/// A swipe of one pointer.
#[derive(Clone, Copy, Debug)]
pub struct Swipe {
    /// Where the next piece starts, in pixels, if no slit goes on from there.
    from: Vec2,
    /// The end of the slit so far.
    end: Option<CutEnd>,
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
    pub fn cut_to(&mut self, to: Vec2, last: bool, pick: &mut PickContext<'_>) -> Result<()> {
        let ahead = self.from(pick);
        let edge = pick.edge_pixels();
        if ahead.distance(to) < if last { 1.0 } else { MIN_EDGES * edge } {
            return Ok(());
        }
        let way = (to - ahead).normalize_or_zero();
        // A hair back, so that the blade surely goes through the end of the slit.
        let from = if self.end.is_some() { ahead - way * (0.1 * edge) } else { ahead };
        let end = cut(from, to, pick)?;
        let over_cloth = pick.depth(to)?.is_some();
        if !over_cloth {
            *self = Self::new(to);
        } else if end.is_some() {
            self.end = end;
        }
        Ok(())
    }

    fn from(&self, pick: &PickContext<'_>) -> Vec2 {
        let end = self
            .end
            .and_then(|end| pick.cloths.get(end.cloth)?.positions().get(end.particle as usize));
        end.and_then(|at| pick.pixels(*at)).unwrap_or(self.from)
    }
}

/// Cuts along a straight piece of a swipe and says where the slit ends, if there is one.
fn cut(from: Vec2, to: Vec2, pick: &mut PickContext<'_>) -> Result<Option<CutEnd>> {
    let mut samples = Vec::new();
    for i in 0..=DEPTH_SAMPLES {
        let share = i as f32 / DEPTH_SAMPLES as f32;
        samples.extend(pick.depth(from.lerp(to, share))?.map(|depth| (share, depth)));
    }
    let (Some(first), Some(last)) = (samples.first().copied(), samples.last().copied()) else {
        return Ok(None);
    };
    // A plane through the eye, as deep at both ends as the cloth that is nearest to them.
    let (a, b) = (pick.at_depth(from, first.1), pick.at_depth(to, last.1));
    let into = ((a + b) * 0.5 - pick.view.eye).normalize_or_zero();
    let depth = into * (DEPTH * pick.unit);
    let way = to - from;
    let mut end: Option<(f32, CutEnd)> = None;
    for cloth in 0..pick.cloths.len() {
        let cut = &mut pick.cloths[cloth];
        while cut.next_event().is_some() {}
        match cut.cut(a - depth, b - depth, depth * 2.0) {
            // A piece too short to have a direction, or no room for more.
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
                    let far = (at - from).dot(way);
                    if end.is_none_or(|(farthest, _)| far > farthest) {
                        end = Some((far, CutEnd { cloth, particle }));
                    }
                }
            }
        }
    }
    Ok(end.map(|(_, cut_end)| cut_end))
}
