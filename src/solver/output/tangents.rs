//! Stage `Outputs`: vertex tangents, the direction in which the texture coordinate u grows.
//!
//! ```text
//! triangle   T = (p dv₂ − q dv₁) sign(d),  d = du₁ dv₂ − du₂ dv₁     p, q: its edges from corner a
//! vertex     t = ΣT − n (n · ΣT), normalised;  handedness w = sign(Σd)
//! ```
//! Method: the direction of increasing u on each triangle, summed per vertex. T grows with the area
//! of the triangle in the texture, so large triangles weigh more. The handedness w gives the
//! direction in which v grows: along w (n × t). If the texture defines no direction, t is a unit
//! vector normal to n and w is 1.
//!
//! Reads triangles, texture coordinates and positions; writes `Tangents`.
//! Invariant: the sums are cached until positions or triangles change. `vertex_transform` makes
//! them orthogonal to the normals.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::simd::{Simd, vectored};
use crate::solver::vertex_sums::contribution::{
    LaneVector, RowBand, SumInput, TriangleContribution,
};
use crate::solver::vertex_sums::triangles;
use crate::solver::vertex_sums::triangles::sum_in_bands;
use crate::solver::world::World;
use glam::{Vec2, Vec3};

/// Sums of triangle tangents per render vertex, not yet orthogonal to the vertex normals.
#[derive(Debug)]
pub(crate) struct Tangents {
    capacity: usize,
    uvs: Columns,
    /// Position of each render vertex, if vertices share particles.
    x: Columns,
    sums: Columns,
    /// Handedness of each vertex: 1 or −1.
    handedness: Vec<f32>,
    /// Whether `uvs` and `handedness` match the current triangles.
    is_texture_current: bool,
    /// Share between two ticks for which `sums` were computed.
    share: Option<f32>,
}

heap_bytes!(Tangents { uvs, x, sums, handedness } plain { capacity, is_texture_current, share });

impl Tangents {
    /// Allocates buffers for `capacity` render vertices.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            capacity,
            uvs: Columns::with_capacity(capacity),
            x: Columns::default(),
            sums: Columns::with_capacity(capacity),
            handedness: Vec::with_capacity(capacity),
            is_texture_current: false,
            share: None,
        }
    }

    /// Allocates for `capacity` render vertices in all.
    pub fn reserve(&mut self, capacity: usize) {
        self.capacity = capacity;
        self.uvs.reserve(capacity);
        self.sums.reserve(capacity);
        self.handedness.reserve_total(capacity);
        if !self.x.x.is_empty() {
            self.x.reserve(capacity);
        }
    }

    /// Marks the sums as outdated, after positions changed.
    pub fn invalidate_positions(&mut self) {
        self.share = None;
    }

    /// Marks texture data and sums as outdated, after triangles changed.
    pub fn invalidate_triangles(&mut self) {
        self.is_texture_current = false;
        self.share = None;
    }

    /// Whether the sums are those at `share` between two ticks.
    pub fn is_current(&self, share: f32) -> bool {
        self.share == Some(share)
    }

    /// Computes the sums for particles at positions `x`, which are those at `share` between two
    /// ticks.
    pub fn update(&mut self, world: &World, uvs: &[Vec2], x: &Columns, share: f32) {
        if !self.is_texture_current {
            self.load_texture(world.render_triangles(), uvs);
            self.is_texture_current = true;
        }
        self.share = Some(share);
        // Vertices that share a particle differ in the texture, so the sums are per vertex.
        let (x, cells) = match &world.seams {
            Some(seams) => {
                self.x.reserve(self.capacity);
                self.x.set_all(seams.particles.iter().map(|particle| x.get(*particle as usize)));
                (&self.x, None)
            }
            None => (x, world.grid_cells.as_ref()),
        };
        self.sums.copy_from(x);
        self.sums.fill(Vec3::ZERO);
        let input = SumInput {
            triangles: world.render_triangles(),
            areas: &world.corner_area,
            cells,
            x,
            attribute: &self.uvs,
        };
        let level = world.level;
        sum_in_bands(world.threads, input, &mut self.sums, |band, sums| {
            sum_tangents(level, input, TextureTangent, band, sums);
        });
    }

    /// Loads the texture coordinates and computes the handedness of each vertex.
    fn load_texture(&mut self, triangles: &[[u32; 3]], uvs: &[Vec2]) {
        self.uvs.set_all(uvs.iter().map(|uv| uv.extend(0.0)));
        self.handedness.clear();
        self.handedness.resize(uvs.len(), 0.0);
        for corners in triangles {
            let [a, b, c] = corners.map(|v| uvs[v as usize]);
            let area = (b - a).perp_dot(c - a);
            corners.iter().for_each(|v| self.handedness[*v as usize] += area);
        }
        for sign in &mut self.handedness {
            *sign = if *sign < 0.0 { -1.0 } else { 1.0 };
        }
    }

    /// Columns of the sums, and the handedness.
    pub fn columns(&self) -> ([&[f32]; 3], &[f32]) {
        (self.sums.slices(), &self.handedness)
    }
}

vectored! {
    fn sum_tangents(
        input: SumInput<'_>,
        contribution: TextureTangent,
        band: RowBand,
        sums: [&mut [f32]; 3],
    ) = triangles::sum, triangles::sum_scalar
}

/// Direction in which u grows on a triangle, scaled by its area in the texture.
/// `SumInput::attribute` holds the texture coordinates.
#[derive(Clone, Copy)]
struct TextureTangent;

impl TriangleContribution for TextureTangent {
    const WEIGHTED_BY_AREA: bool = false;

    #[inline(always)]
    fn evaluate<S: Simd>(
        self,
        s: S,
        [a, b, c]: [LaneVector<S>; 3],
        [ua, ub, uc]: [LaneVector<S>; 3],
        _: S::F,
    ) -> LaneVector<S> {
        let (zero, minus) = (s.splat(0.0), s.splat(-0.0));
        let (du1, dv1) = (ub[0] - ua[0], ub[1] - ua[1]);
        let (du2, dv2) = (uc[0] - ua[0], uc[1] - ua[1]);
        let is_mirrored = zero - (du1 * dv2 - du2 * dv1);
        let dv1 = s.select(is_mirrored, minus - dv1, dv1);
        let dv2 = s.select(is_mirrored, minus - dv2, dv2);
        let mut along = [zero; 3];
        for (axis, along) in along.iter_mut().enumerate() {
            *along = (b[axis] - a[axis]) * dv2 - (c[axis] - a[axis]) * dv1;
        }
        along
    }
}
