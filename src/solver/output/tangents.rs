//! Stage `Outputs`: tangents, along which the texture coordinate u grows.
//!
//! ```text
//! triangle   T = (p dv₂ - q dv₁) sign(d),  d = du₁ dv₂ - du₂ dv₁     p, q: its edges from corner a
//! vertex     t = ΣT - n (n · ΣT), at unit length;  w = sign(Σd)
//! ```
//! T is as long as the triangle is large in the texture, so large ones count for more. w says on which
//! side of the surface v grows: along w (n × t). Where a texture says nothing, t is any unit vector square
//! to n, and w is 1.

use crate::solver::vertex_sums::triangles;
use crate::solver::world::World;

use crate::math::columns::Columns;
use crate::math::simd::{Simd, vectored};
use crate::solver::vertex_sums::triangles::{Band, Give, Surface, V, in_bands};
use glam::{Vec2, Vec3};

/// The sums over triangles, each vertex's direction still to be made square to its normal.
#[derive(Debug)]
pub(crate) struct Tangents {
    capacity: usize,
    uvs: Columns,
    /// Where the vertices are, if there are seams.
    x: Columns,
    sums: Columns,
    /// Of each vertex, 1 or -1.
    hands: Vec<f32>,
    /// Whether `uvs` and `hands` are those of the triangles as they are.
    follows: bool,
    /// The share between ticks that `sums` are of.
    share: Option<f32>,
}

impl Tangents {
    /// Room for `capacity` vertices.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            capacity,
            uvs: Columns::with_capacity(capacity),
            x: Columns::default(),
            sums: Columns::with_capacity(capacity),
            hands: Vec::with_capacity(capacity),
            follows: false,
            share: None,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let of_seams = if self.x.x.capacity() == 0 { 0 } else { size_of::<[f32; 3]>() };
        self.capacity * (size_of::<[f32; 7]>() + of_seams)
    }

    /// Tells of a change of positions.
    pub fn moved(&mut self) {
        self.share = None;
    }

    /// Tells of a change of triangles.
    pub fn retied(&mut self) {
        self.follows = false;
        self.share = None;
    }

    /// Whether the sums are those at a share between two ticks.
    pub fn is_of(&self, share: f32) -> bool {
        self.share == Some(share)
    }

    /// Sums up the surface whose particles are at `x`, which is at a share between two ticks.
    pub fn follow(&mut self, world: &World, uvs: &[Vec2], x: &Columns, share: f32) {
        if !self.follows {
            self.take(world.render_triangles(), uvs);
            self.follows = true;
        }
        self.share = Some(share);
        // Vertices that share a particle lie elsewhere in the texture, so they are summed up by themselves.
        let (x, cells) = match &world.seams {
            Some(seams) => {
                self.x.reserve(self.capacity);
                self.x.set_all(seams.particles.iter().map(|particle| x.at(*particle as usize)));
                (&self.x, None)
            }
            None => (x, world.grid_cells.as_ref()),
        };
        self.sums.copy_from(x);
        self.sums.fill(Vec3::ZERO);
        let surface = Surface {
            triangles: world.render_triangles(),
            areas: &world.corner_area,
            cells,
            x,
            air: &self.uvs,
        };
        let level = world.level;
        in_bands(world.threads, surface, &mut self.sums, |band, sums| {
            sum_tangents(level, surface, Along, band, sums);
        });
    }

    /// Takes on the texture, and finds which way it lies.
    fn take(&mut self, triangles: &[[u32; 3]], uvs: &[Vec2]) {
        self.uvs.set_all(uvs.iter().map(|uv| uv.extend(0.0)));
        self.hands.clear();
        self.hands.resize(uvs.len(), 0.0);
        for corners in triangles {
            let [a, b, c] = corners.map(|v| uvs[v as usize]);
            let area = (b - a).perp_dot(c - a);
            corners.iter().for_each(|v| self.hands[*v as usize] += area);
        }
        for hand in &mut self.hands {
            *hand = if *hand < 0.0 { -1.0 } else { 1.0 };
        }
    }

    /// The sums, and on which side v grows.
    pub fn lists(&self) -> ([&[f32]; 3], &[f32]) {
        (self.sums.all(), &self.hands)
    }
}

vectored! {
    fn sum_tangents(surface: Surface<'_>, give: Along, band: Band, sums: [&mut [f32]; 3])
        = triangles::sum, Avx2, triangles::sum_apart
}

/// The direction in which u grows on a triangle, as long as it is large in the texture. What is `air` of
/// others is here where its corners lie in the texture.
#[derive(Clone, Copy)]
struct Along;

impl Give for Along {
    const BY_AREA: bool = false;

    #[inline(always)]
    fn give<S: Simd>(self, s: S, [a, b, c]: [V<S>; 3], [ua, ub, uc]: [V<S>; 3], _: S::F) -> V<S> {
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
