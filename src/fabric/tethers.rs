//! Tethers: how far along the cloth each particle is from the pins, and so how far it may get.
//!
//! Distances are measured on the surface at rest by unfolding triangles (Kimmel and Sethian,
//! "Computing geodesic paths on manifolds", PNAS 1998), swept to and fro until nothing changes.
//! Kim, Chentanez, Müller, "Long range attachments", SCA 2012, for what they are good for.

use crate::mesh::{Mesh, NONE};
use glam::Vec3;

/// With this many pins or fewer each particle is tethered to every one, else to the nearest.
const FEW_PINS: usize = 4;

/// Each particle's attachment to one pin.
#[derive(Clone, Debug)]
pub(crate) struct TetherSet {
    /// The pinned particle; itself where no way leads to a pin.
    pub anchor: Vec<u32>,
    /// Length of the way [m]; infinite where there is none.
    pub length: Vec<f32>,
    /// The only pin of the set, if there is but one.
    pub only: Option<u32>,
}

/// The tethers of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Tethers {
    sets: Vec<TetherSet>,
    used: usize,
}

impl Tethers {
    /// No tethers, with room for those of `capacity` particles.
    pub fn with_capacity(capacity: usize) -> Self {
        let list = || TetherSet {
            anchor: Vec::with_capacity(capacity),
            length: Vec::with_capacity(capacity),
            only: None,
        };
        Self { sets: (0..FEW_PINS).map(|_| list()).collect(), used: 0 }
    }

    /// Makes room for `capacity` particles in all.
    pub fn reserve(&mut self, capacity: usize) {
        for set in &mut self.sets {
            set.anchor.reserve_exact(capacity.saturating_sub(set.anchor.len()));
            set.length.reserve_exact(capacity.saturating_sub(set.length.len()));
        }
    }

    /// Bytes that they hold.
    pub fn bytes(&self) -> usize {
        self.sets.iter().map(|set| 4 * (set.anchor.capacity() + set.length.capacity())).sum()
    }

    pub fn sets(&self) -> &[TetherSet] {
        &self.sets[..self.used]
    }

    /// Measures all ways to the `pinned` particles anew. `rest` is the rest position of each original
    /// vertex.
    pub fn measure(
        &mut self,
        mesh: &Mesh,
        rest: &[Vec3],
        pinned: impl ExactSizeIterator<Item = u32> + Clone,
    ) {
        let few = pinned.len() <= FEW_PINS;
        self.used = if few { pinned.len() } else { 1 };
        for (at, set) in self.sets[..self.used].iter_mut().enumerate() {
            set.anchor.clear();
            set.anchor.resize(mesh.vertex_count(), NONE);
            set.length.clear();
            set.length.resize(mesh.vertex_count(), f32::INFINITY);
            for (number, pin) in pinned.clone().enumerate() {
                if !few || number == at {
                    set.anchor[pin as usize] = pin;
                    set.length[pin as usize] = 0.0;
                }
            }
            set.spread(mesh, rest);
            set.only = if few { pinned.clone().nth(at) } else { None };
            for (particle, anchor) in set.anchor.iter_mut().enumerate() {
                if *anchor == NONE {
                    *anchor = particle as u32;
                }
            }
        }
    }
}

impl TetherSet {
    fn spread(&mut self, mesh: &Mesh, rest: &[Vec3]) {
        let at = |v: u32| rest[mesh.source[v as usize] as usize];
        // Every sweep carries the front over at least one more triangle, mostly over all of them.
        for sweep in 0..mesh.triangles.len() + 1 {
            let mut changed = false;
            let count = mesh.triangles.len();
            for step in 0..count {
                let index = if sweep % 2 == 0 { step } else { count - 1 - step };
                let [a, b, c] = mesh.triangles[index];
                changed |= self.relax(a, b, c, at);
                changed |= self.relax(b, c, a, at);
                changed |= self.relax(c, a, b, at);
            }
            if !changed {
                break;
            }
        }
    }

    /// Shortens the way to `c` through the edge a–b; true if it did.
    fn relax(&mut self, a: u32, b: u32, c: u32, at: impl Fn(u32) -> Vec3) -> bool {
        let (la, lb) = (self.length[a as usize], self.length[b as usize]);
        let old = self.length[c as usize];
        if !(la < old || lb < old) {
            return false;
        }
        let (pa, pb, pc) = (at(a), at(b), at(c));
        let through_a = la + (pc - pa).length();
        let through_b = lb + (pc - pb).length();
        let (mut best, mut anchor) = if through_a <= through_b {
            (through_a, self.anchor[a as usize])
        } else {
            (through_b, self.anchor[b as usize])
        };
        if self.anchor[a as usize] == self.anchor[b as usize]
            && let Some(straight) = unfold(pa, pb, pc, la, lb)
            && straight < best
        {
            (best, anchor) = (straight, self.anchor[a as usize]);
        }
        // A hair of slack ends the sweeps: f32 could go on shaving bits off.
        if best < old * (1.0 - 1.0e-5) {
            (self.length[c as usize], self.anchor[c as usize]) = (best, anchor);
            return true;
        }
        false
    }
}

/// The straight way from a source, `la` from `a` and `lb` from `b`, to `c`, if it crosses the edge.
fn unfold(a: Vec3, b: Vec3, c: Vec3, la: f32, lb: f32) -> Option<f32> {
    let edge = b - a;
    let width = edge.length();
    let source_x = (la * la - lb * lb + width * width) / (2.0 * width);
    let source_y2 = la * la - source_x * source_x;
    let to_c = c - a;
    let c_x = to_c.dot(edge) / width;
    let c_y2 = to_c.length_squared() - c_x * c_x;
    if !(source_y2 >= 0.0 && c_y2 > 0.0) {
        return None;
    }
    let (below, above) = (source_y2.sqrt(), c_y2.sqrt());
    let crossing = source_x + (c_x - source_x) * below / (below + above);
    let (dx, dy) = (c_x - source_x, below + above);
    (crossing >= 0.0 && crossing <= width).then(|| (dx * dx + dy * dy).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::grid::{self, Frame};

    #[test]
    fn ways_over_a_flat_sheet_are_straight_lines() {
        let frame = Frame { origin: Vec3::ZERO, right: Vec3::X, down: Vec3::NEG_Y, spacing: 0.1 };
        let rest = grid::positions(21, 17, &frame);
        let mesh = Mesh::new(grid::triangles(21, 17), rest.len(), rest.len());
        let mut tethers = Tethers::with_capacity(rest.len());
        tethers.measure(&mesh, &rest, [0, 20].into_iter());
        assert_eq!(tethers.sets().len(), 2);
        for (set, corner) in tethers.sets().iter().zip([0usize, 20]) {
            for (particle, length) in set.length.iter().enumerate() {
                let exact = (rest[particle] - rest[corner]).length();
                assert!(
                    (length - exact).abs() <= 0.002 * exact + 1.0e-6,
                    "{particle}: {length} {exact}"
                );
            }
        }
    }
}
