//! Tethers (long-range attachments): geodesic distance of each particle to the pins, which limits
//! how far it may move away.
//!
//! Kim, Chentanez and Müller, "Long range attachments", SCA 2012. Distances are measured on the
//! rest surface by unfolding triangles (Kimmel and Sethian, "Computing geodesic paths on
//! manifolds", PNAS 1998), in sweeps over the triangles with alternating direction until nothing
//! changes:
//!
//! ```text
//!         c          length(c) = min( length(a) + |ac|, length(b) + |bc|,
//!        ╱ ╲                          straight line from the pin through edge ab, unfolded )
//!       a───b
//!        ╲ ╱  ← front comes from here
//! ```
//! A tear lengthens only the paths that crossed it. Each particle stores the triangle that its path
//! comes through, so that those paths are found and measured again, and no others.
//!
//! Reads mesh, rest positions and pins; writes `TetherSet`s, which `solver::stretch::tethers`
//! enforces.
//!
//! Invariant: `length` is infinite exactly if no path leads to a pin.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::mesh::{Fan, Mesh, NONE, triangle_of};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Up to this number of pins each particle is tethered to every pin; with more pins to the nearest
/// one.
const MAX_SEPARATE_PINS: usize = 4;

/// One tether per particle. Field order is part of the save format.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct TetherSet {
    /// The pinned particle; the particle itself if no path leads to a pin.
    pub pin: Vec<u32>,
    /// Geodesic distance to it [m]; infinite if no path leads to a pin.
    pub length: Vec<f32>,
    /// The triangle that the path comes through; `NONE` at a pin and where there is no path.
    via_triangle: Vec<u32>,
    /// The pin of the set, if there is only one.
    pub single_pin: Option<u32>,
}

heap_bytes!(TetherSet { pin, length, via_triangle } plain { single_pin });

/// The tethers of a cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tethers {
    sets: [TetherSet; MAX_SEPARATE_PINS],
    used: usize,
    pin_count: usize,
    scratch: TetherScratch,
}

heap_bytes!(Tethers { sets, scratch } plain { used, pin_count });

/// Scratch for updates after tears.
#[derive(Clone, Debug, Default)]
struct TetherScratch {
    fan: Fan,
    /// Particles whose paths crossed a tear.
    invalid: Vec<u32>,
    /// Marks of triangles at such particles, and the list of them.
    is_affected: Vec<bool>,
    affected: Vec<u32>,
}

heap_bytes!(TetherScratch { fan, invalid, is_affected, affected } plain {});

impl Tethers {
    /// Returns whether one set holds the tethers to all of `pins` pins.
    pub fn has_common_set(pins: usize) -> bool {
        pins > MAX_SEPARATE_PINS
    }

    /// Allocates the sets of this number of pins for `capacity` particles in all; `None` stands for
    /// any number.
    pub fn reserve(&mut self, pins: Option<usize>, capacity: usize) {
        let used = match pins {
            Some(pins) if Self::has_common_set(pins) => 1,
            Some(pins) => pins,
            None => MAX_SEPARATE_PINS,
        };
        for set in &mut self.sets[..used] {
            set.pin.reserve_total(capacity);
            set.length.reserve_total(capacity);
            set.via_triangle.reserve_total(capacity);
        }
    }

    /// Allocates for updates after tears in a mesh of at most `capacity` particles and `triangles`
    /// triangles.
    pub fn reserve_for_tears(&mut self, capacity: usize, triangles: usize) {
        let TetherScratch { fan, invalid, is_affected, affected } = &mut self.scratch;
        fan.corners.reserve(64);
        fan.ring.reserve(65);
        invalid.reserve_total(capacity);
        is_affected.reserve_total(triangles);
        affected.reserve_total(triangles);
    }

    /// Number of pins when the paths were measured.
    pub fn pin_count(&self) -> usize {
        self.pin_count
    }

    /// The sets in use: one per pin, or one for all pins.
    pub fn sets(&self) -> &[TetherSet] {
        &self.sets[..self.used]
    }

    /// Measures all paths to the `pinned` particles. `rest` is the rest position of each site [m].
    pub fn rebuild(
        &mut self,
        mesh: &Mesh,
        rest: &[Vec3],
        pinned: impl Iterator<Item = u32> + Clone,
    ) {
        self.pin_count = pinned.clone().count();
        let is_few = !Self::has_common_set(self.pin_count);
        self.used = if is_few { self.pin_count } else { 1 };
        for (at, set) in self.sets[..self.used].iter_mut().enumerate() {
            set.pin.clear();
            set.pin.resize(mesh.vertex_count(), NONE);
            set.length.clear();
            set.length.resize(mesh.vertex_count(), f32::INFINITY);
            set.via_triangle.clear();
            set.via_triangle.resize(mesh.vertex_count(), NONE);
            for (number, pin) in pinned.clone().enumerate() {
                if !is_few || number == at {
                    set.pin[pin as usize] = pin;
                    set.length[pin as usize] = 0.0;
                }
            }
            set.sweep_triangles(mesh, rest, 0..mesh.triangles.len() as u32);
            set.single_pin = if is_few { pinned.clone().nth(at) } else { None };
            set.set_unreached_to_self();
        }
    }

    /// Appends a particle as a copy of `from`; call `update_after_tear` afterwards.
    pub fn push_copy_of(&mut self, from: u32) {
        for set in &mut self.sets[..self.used] {
            let (from, new) = (from as usize, set.pin.len() as u32);
            let is_reached = set.length[from].is_finite();
            set.pin.push(if is_reached { set.pin[from] } else { new });
            set.length.push(set.length[from]);
            set.via_triangle.push(set.via_triangle[from]);
        }
    }

    /// Recomputes the paths that crossed a tear. `touched` are all particles whose triangles
    /// changed; the pins have not changed.
    pub fn update_after_tear(&mut self, mesh: &Mesh, rest: &[Vec3], touched: &[u32]) {
        let scratch = &mut self.scratch;
        for set in &mut self.sets[..self.used] {
            set.invalidate(mesh, touched, scratch);
            if scratch.invalid.is_empty() {
                continue;
            }
            scratch.is_affected.clear();
            scratch.is_affected.resize(mesh.triangles.len(), false);
            for particle in &scratch.invalid {
                mesh.gather_fan(mesh.corner_of[*particle as usize], &mut scratch.fan);
                for corner in &scratch.fan.corners {
                    scratch.is_affected[triangle_of(*corner)] = true;
                }
            }
            scratch.affected.clear();
            let affected = |triangle: &usize| scratch.is_affected[*triangle];
            let affected =
                (0..mesh.triangles.len()).filter(affected).map(|triangle| triangle as u32);
            scratch.affected.extend(affected);
            set.sweep_triangles(mesh, rest, scratch.affected.iter().copied());
            set.set_unreached_to_self();
        }
    }

    /// Returns the sets in use, for a save.
    pub fn save(&self) -> Vec<TetherSet> {
        self.sets().to_vec()
    }

    /// Replaces the measured sets by saved ones. Returns false if they do not fit the pins and the
    /// mesh.
    pub fn restore(&mut self, saved: &[TetherSet], particles: usize, triangles: usize) -> bool {
        let matches = |(set, saved): (&TetherSet, &TetherSet)| {
            let is_within = |list: &[u32], most: usize| {
                list.iter().all(|at| *at == NONE || (*at as usize) < most)
            };
            saved.single_pin == set.single_pin
                && [saved.pin.len(), saved.length.len(), saved.via_triangle.len()] == [particles; 3]
                && saved.pin.iter().all(|pin| (*pin as usize) < particles)
                && is_within(&saved.via_triangle, triangles)
                && saved.length.iter().all(|length| *length >= 0.0)
        };
        let sets = &mut self.sets[..self.used];
        if saved.len() != sets.len()
            || !sets.iter().zip(saved).all(|(set, saved)| matches((set, saved)))
        {
            return false;
        }
        for (set, saved) in sets.iter_mut().zip(saved) {
            set.pin.copy_from_slice(&saved.pin);
            set.length.copy_from_slice(&saved.length);
            set.via_triangle.copy_from_slice(&saved.via_triangle);
        }
        true
    }
}

impl TetherSet {
    /// Relaxes over `triangles` in alternating direction until nothing changes.
    fn sweep_triangles(
        &mut self,
        mesh: &Mesh,
        rest: &[Vec3],
        triangles: impl DoubleEndedIterator<Item = u32> + ExactSizeIterator + Clone,
    ) {
        let at = |v: u32| rest[mesh.source[v as usize] as usize];
        // Every sweep advances the front by at least one triangle, usually over all of them.
        for sweep in 0..triangles.len() + 1 {
            let mut changed = false;
            let mut relax_all = |triangle: u32| {
                let [a, b, c] = mesh.triangles[triangle as usize];
                changed |= self.relax(a, b, c, triangle, at);
                changed |= self.relax(b, c, a, triangle, at);
                changed |= self.relax(c, a, b, triangle, at);
            };
            if sweep % 2 == 0 {
                triangles.clone().for_each(&mut relax_all);
            } else {
                triangles.clone().rev().for_each(&mut relax_all);
            }
            if !changed {
                break;
            }
        }
    }

    /// Sets the pin of each particle without a path to the particle itself.
    fn set_unreached_to_self(&mut self) {
        for (particle, pin) in self.pin.iter_mut().enumerate() {
            if *pin == NONE {
                *pin = particle as u32;
            }
        }
    }

    /// Collects the particles whose paths are invalid after the `touched` particles lost triangles:
    /// those whose path comes through a lost triangle, and in turn those whose path comes through a
    /// triangle of an invalid particle.
    fn invalidate(&mut self, mesh: &Mesh, touched: &[u32], scratch: &mut TetherScratch) {
        scratch.invalid.clear();
        for particle in touched {
            let via_triangle = self.via_triangle[*particle as usize];
            if via_triangle != NONE && !mesh.triangles[via_triangle as usize].contains(particle) {
                self.reset(*particle, &mut scratch.invalid);
            }
        }
        let mut at = 0;
        while let Some(particle) = scratch.invalid.get(at).copied() {
            mesh.gather_fan(mesh.corner_of[particle as usize], &mut scratch.fan);
            for corner in &scratch.fan.corners {
                let triangle = triangle_of(*corner);
                for other in mesh.triangles[triangle] {
                    if self.via_triangle[other as usize] == triangle as u32 {
                        self.reset(other, &mut scratch.invalid);
                    }
                }
            }
            at += 1;
        }
    }

    fn reset(&mut self, particle: u32, invalid: &mut Vec<u32>) {
        let at = particle as usize;
        (self.pin[at], self.length[at], self.via_triangle[at]) = (NONE, f32::INFINITY, NONE);
        invalid.push(particle);
    }

    /// Shortens the path to `c` through the edge a–b of a triangle; returns whether it did.
    fn relax(&mut self, a: u32, b: u32, c: u32, triangle: u32, at: impl Fn(u32) -> Vec3) -> bool {
        let (la, lb) = (self.length[a as usize], self.length[b as usize]);
        let old = self.length[c as usize];
        if !(la < old || lb < old) {
            return false;
        }
        let (pa, pb, pc) = (at(a), at(b), at(c));
        let through_a = la + (pc - pa).length();
        let through_b = lb + (pc - pb).length();
        let (mut best, mut pin) = if through_a <= through_b {
            (through_a, self.pin[a as usize])
        } else {
            (through_b, self.pin[b as usize])
        };
        if self.pin[a as usize] == self.pin[b as usize]
            && let Some(straight) = unfold(pa, pb, pc, la, lb)
            && straight < best
        {
            (best, pin) = (straight, self.pin[a as usize]);
        }
        // A tolerance ends the sweeps; otherwise f32 rounding could shorten paths forever.
        if best < old * (1.0 - 1.0e-5) {
            (self.length[c as usize], self.pin[c as usize]) = (best, pin);
            self.via_triangle[c as usize] = triangle;
            return true;
        }
        false
    }
}

/// Length of the straight path to `c` from a source at distances `la` from `a` and `lb` from `b`,
/// in the unfolded triangle. `None` if it does not cross the edge.
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
    use crate::mesh::grid;
    use crate::mesh::grid::GridFrame;

    #[test]
    fn paths_over_a_flat_sheet_are_straight_lines() {
        let frame =
            GridFrame { origin: Vec3::ZERO, right: Vec3::X, down: Vec3::NEG_Y, spacing: 0.1 };
        let rest = grid::positions(21, 17, &frame);
        let mesh = Mesh::new(grid::triangles(21, 17), rest.len(), rest.len());
        let mut tethers = Tethers::default();
        tethers.rebuild(&mesh, &rest, [0, 20].into_iter());
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

    #[test]
    fn paths_that_a_tear_cuts_lead_around_it() {
        let frame =
            GridFrame { origin: Vec3::ZERO, right: Vec3::X, down: Vec3::NEG_Y, spacing: 0.1 };
        let rest = grid::positions(21, 17, &frame);
        let mut mesh = Mesh::new(grid::triangles(21, 17), rest.len(), rest.len() + 40);
        let mut tethers = Tethers::default();
        tethers.rebuild(&mesh, &rest, 0..21);
        // A slit along a row in the middle, vertex by vertex.
        for column in 5..16 {
            let mut fan = Fan::default();
            let vertex = 8 * 21 + column;
            mesh.gather_fan(mesh.corner_of[vertex], &mut fan);
            let below = |corner: &u32| {
                mesh.triangles[triangle_of(*corner)]
                    .iter()
                    .any(|v| mesh.source[*v as usize] as usize / 21 > 8)
            };
            let moves: Vec<bool> = fan.corners.iter().map(below).collect();
            let Some(arc) = crate::mesh::split_vertex::best_arc(&fan, &moves) else { continue };
            let new = mesh.split_vertex(&fan, arc, &mut Vec::new());
            tethers.push_copy_of(vertex as u32);
            tethers.update_after_tear(&mesh, &rest, &[vertex as u32, new]);
        }
        let mut measured_again = Tethers::default();
        measured_again.rebuild(&mesh, &rest, 0..21);
        let below = 9 * 21 + 10;
        let straight = 0.9;
        assert!(
            measured_again.sets()[0].length[below] > 1.1 * straight,
            "the path leads around the slit"
        );
        let lengths = tethers.sets()[0].length.iter().zip(&measured_again.sets()[0].length);
        for (particle, (updated, measured)) in lengths.enumerate() {
            let off = (updated - measured).abs();
            assert!(off <= 1.0e-3 * measured, "{particle}: {updated}, measured {measured}");
        }
    }
}
