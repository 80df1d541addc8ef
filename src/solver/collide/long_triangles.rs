//! Triangles that are long enough to dip into a collider between their corners.
//!
//! Particles keep a margin to smooth shapes (see `contact_distance`), which keeps triangles outside
//! up to some length of their edges: the longest free edge of the collider. Cloth that is stretched
//! beyond it, and the longest edges of an irregular mesh, are tested as triangles.
//!
//! Beside a particle that two colliders leave less than its gap (see `squeezed`), a triangle counts as
//! long whatever its edges: its corner does not keep the margin.
//!
//! Edges are measured in the first substep of a tick, in each substep of a tick with added substeps
//! or long triangles, and whenever a collider has pushed a particle far.
//!
//! Reads positions and the mesh; writes the list.
//! Invariant: the list depends only on the positions at these times and on the colliders.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::max;
use crate::math::reserve::ReserveTotal;
use crate::math::simd::Level;
use crate::solver::collide::any_moved::any_moved;
use crate::solver::collide::collider_contact::ColliderContact;
use glam::Vec3;

/// The fraction of a bound that counts; the rest covers rounding.
const SAFETY: f32 = 0.99;

/// Edges are measured again if a collider has pushed a particle farther than this, in mean edge
/// lengths.
const FAR_PUSH: f32 = 0.2;

/// What long triangles are found from.
#[derive(Clone, Copy)]
pub(super) struct MeasuredSurface<'a> {
    pub x: &'a Columns,
    /// The predicted positions and the displacements of the prediction [m]: their differences are the
    /// positions at the start of the substep.
    pub predicted: [&'a Columns; 2],
    pub triangles: &'a [[u32; 3]],
    /// The share of their gaps that there is room for, if any particle has less than all of it.
    pub room: Option<&'a [f32]>,
    pub level: Level,
}

/// The triangles with an edge longer than a limit, or with a corner that has less room than its gap.
#[derive(Clone, Debug, Default)]
pub(crate) struct LongTriangles {
    list: Vec<u32>,
    /// The longest edge of each of these triangles, when measured or at the start of the substep,
    /// whichever is longer [m].
    edges: Vec<f32>,
    /// The least longest free edge of the colliders near the cloth in this tick [m]; infinity if
    /// there is none.
    limit: f32,
    /// Whether the edges need no measuring at the next refresh.
    is_current: bool,
    /// The positions when the edges were last measured [m], and the longest edge then [m].
    measured: Columns,
    longest: f32,
    /// The number of triangles then.
    triangles: usize,
}

heap_bytes!(
    LongTriangles { list, edges, measured } plain { limit, is_current, longest, triangles }
);

impl LongTriangles {
    /// Allocates for `particles` particles and `triangles` triangles.
    pub fn reserve(&mut self, particles: usize, triangles: usize) {
        self.list.reserve_total(triangles);
        self.edges.reserve_total(triangles);
        self.measured.reserve(particles);
    }

    /// Lets the next refresh measure the edges: at the start of a tick, and after other stages moved
    /// particles far.
    pub fn invalidate(&mut self) {
        self.is_current = false;
    }

    /// Returns whether the list needs no refresh.
    pub fn is_current(&self) -> bool {
        self.is_current
    }

    /// Lists the triangles with an edge above `limit` [m].
    pub fn refresh(&mut self, limit: f32, surface: MeasuredSurface<'_>) {
        self.is_current = true;
        self.limit = limit;
        if limit < f32::INFINITY {
            self.measure(surface);
        } else {
            self.clear();
        }
    }

    fn clear(&mut self) {
        self.list.clear();
        self.edges.clear();
    }

    /// Returns the indices of the triangles, in ascending order.
    pub fn list(&self) -> &[u32] {
        &self.list
    }

    /// Returns each triangle with an upper bound of the lengths of its edges in this substep [m].
    pub fn with_longest_edges(&self, x: &Columns) -> impl Iterator<Item = (u32, f32)> + '_ {
        let count = if self.list.is_empty() { 0 } else { x.x.len() };
        let move2 = |i: usize| x.get(i).distance_squared(self.measured.get(i));
        let farthest2 = (0..count).fold(0.0, |farthest2, i| max(move2(i), farthest2));
        // An edge grows by no more than what its two ends move.
        let growth = 2.0 * farthest2.sqrt();
        let list = self.list.iter().zip(&self.edges);
        list.map(move |(triangle, edge)| (*triangle, (edge + growth) * (1.0 / SAFETY)))
    }

    /// Measures the edges again if one of these contacts has pushed a particle far.
    pub fn measure_after_pushes(
        &mut self,
        contacts: &[ColliderContact],
        mean_edge: f32,
        surface: MeasuredSurface<'_>,
    ) {
        let far = FAR_PUSH * mean_edge;
        let is_far = |contact: &ColliderContact| contact.correction.length_squared() > far * far;
        if self.limit < f32::INFINITY && contacts.iter().any(is_far) {
            self.measure(surface);
        }
    }

    /// Measures the edges again if rounds of pushes moved triangles far, `pushed` [m] in all, and
    /// returns whether they did.
    pub fn measure_after_rounds(
        &mut self,
        pushed: f32,
        mean_edge: f32,
        surface: MeasuredSurface<'_>,
    ) -> bool {
        let is_far = self.limit < f32::INFINITY && pushed > FAR_PUSH * mean_edge;
        if is_far {
            self.measure(surface);
        }
        is_far
    }

    /// Measures the edges again after particles between two colliders were left less room.
    pub fn measure_after_narrowing(&mut self, surface: MeasuredSurface<'_>) {
        if self.limit < f32::INFINITY {
            self.measure(surface);
        }
    }

    /// Lists the triangles with an edge above the limit, or with a corner that has less room.
    #[inline(never)]
    fn measure(&mut self, surface: MeasuredSurface<'_>) {
        let MeasuredSurface { x, predicted, triangles, room, level } = surface;
        let is_known = self.triangles == triangles.len() && self.measured.x.len() == x.x.len();
        // An edge grows by no more than what its two ends move.
        let slack = (self.limit * SAFETY - self.longest) * 0.5;
        if is_known && slack > 0.0 && room.is_none() {
            let mut has_moved = false;
            let (now, then) = (x.slices(), self.measured.slices());
            any_moved(level, now, then, slack * slack, &mut has_moved);
            if !has_moved {
                self.clear();
                return;
            }
        }
        self.measured.copy_from(x);
        self.triangles = triangles.len();
        self.clear();
        let start = |i: u32| predicted[0].get(i as usize) - predicted[1].get(i as usize);
        let (limit2, mut longest2) = (self.limit * self.limit, 0.0);
        for (at, corners) in triangles.iter().enumerate() {
            let edge2 = longest_edge_squared(corners.map(|i| x.get(i as usize)));
            longest2 = max(edge2, longest2);
            // NaN is not listed: there is no contact with it.
            if edge2 > limit2 || has_less_room(room, corners) {
                self.list.push(at as u32);
                self.edges.push(max(edge2, longest_edge_squared(corners.map(start))).sqrt());
            }
        }
        self.longest = longest2.sqrt();
    }
}

/// Returns whether a corner of a triangle has less room than its gap.
fn has_less_room(room: Option<&[f32]>, corners: &[u32; 3]) -> bool {
    room.is_some_and(|shares| corners.iter().any(|i| shares[*i as usize] < 1.0))
}

/// Returns the squared length of the longest edge of a triangle [m²].
pub(super) fn longest_edge_squared([a, b, c]: [Vec3; 3]) -> f32 {
    max(max((b - a).length_squared(), (c - b).length_squared()), (a - c).length_squared())
}
