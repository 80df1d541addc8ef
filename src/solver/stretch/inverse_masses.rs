//! What the ends of each woven link weigh, side by side with the link for kernels to read.
//!
//! Where links give way these are inverse masses. For rigid ones only their ratio counts, so each is
//! taken over the mean of the two: 1 and 1 if both ends weigh the same, as nearly everywhere, and then
//! kernels need not read nor multiply by either.

use crate::math::are_same;
use crate::math::column::Column;
use crate::model::grid_rows::GridRows;
use crate::model::links::{LinkKind, Links};
use crate::solver::stretch::distance::{is_rigid, over_mean};
use crate::solver::world::World;
use core::ops::Range;

/// The weights at the ends of links.
#[derive(Clone, Debug, Default)]
pub(crate) struct Weights {
    /// The inverse masses of particles that they come from, …
    w: Vec<f32>,
    /// … and which kinds were rigid then.
    rigid: [bool; 3],
    pub ends: [Column; 2],
    /// Whether both ends of a link weigh the same, and not nothing.
    pub is_even: Vec<bool>,
}

impl Weights {
    /// Makes room for `particles` and `links` in all.
    pub fn reserve(&mut self, particles: usize, links: usize) {
        self.w.reserve_exact(particles.saturating_sub(self.w.len()));
        for list in &mut self.ends {
            list.reserve(links);
        }
        self.is_even.reserve_exact(links.saturating_sub(self.is_even.len()));
    }
}

/// Weighs all ends anew if any particle's inverse mass changed, or loose links were gathered.
pub(crate) fn weigh(world: &mut World) {
    let kinds = [LinkKind::Stretch, LinkKind::Shear, LinkKind::Bend];
    let rigid = kinds.map(|kind| is_rigid(world, kind));
    let (constraints, weights) = (&mut world.constraints, &mut world.scratch.end_weights);
    let w = &world.particles.w;
    let rows_are_weighed = constraints.rows.as_ref().is_none_or(|rows| rows.loose.is_weighed());
    let are_weighed = constraints.loose.is_weighed() && rows_are_weighed;
    if are_same(&weights.w, w) && weights.rigid == rigid && are_weighed {
        return;
    }
    weights.w.clear();
    weights.w.extend_from_slice(w);
    weights.rigid = rigid;
    let count = constraints.links.len();
    weights.ends.iter_mut().for_each(|list| list.resize(count));
    weights.is_even.resize(count, false);
    for batch in &constraints.batches {
        let range = batch.first..batch.first + batch.count;
        weights.fill(&constraints.links, range, rigid[batch.kind as usize]);
    }
    if let Some(rows) = &mut constraints.rows {
        find_even(rows, &weights.is_even);
        rows.loose.weigh(|kind, ends| weights.of(ends, rigid[kind]));
    }
    constraints.loose.weigh(|kind, ends| weights.of(ends, rigid[kind]));
}

impl Weights {
    fn fill(&mut self, links: &Links, range: Range<usize>, is_rigid: bool) {
        for link in range {
            let [a, b] = self.of([links.a[link], links.b[link]], is_rigid);
            (self.ends[0][link], self.ends[1][link]) = (a, b);
            self.is_even[link] = a == b && a > 0.0;
        }
    }

    fn of(&self, ends: [u32; 2], is_rigid: bool) -> [f32; 2] {
        let ends = ends.map(|end| self.w[end as usize]);
        if is_rigid { over_mean(ends) } else { ends }
    }
}

/// Notes the longest stretch of each row in which both ends of every link weigh the same.
fn find_even(rows: &mut GridRows, is_even: &[bool]) {
    for row in &mut rows.rows {
        row.even = [row.first; 2];
        let mut from = row.first;
        for link in row.first..row.first + row.count {
            if !is_even[link as usize] {
                from = link + 1;
            } else if link + 1 - from > row.even[1] - row.even[0] {
                row.even = [from, link + 1];
            }
        }
    }
    rows.find_alike();
}
