//! Stage `Outputs`: positions and normals for the renderer, also blended between two ticks.
//!
//! ```text
//! normal of a particle   n = Σ (b − a) × (c − a), normalised      sum over its triangles (a, b, c)
//! blend                  x(share) = x · share + x_last · (1 − share)
//! ```
//! Method: area-weighted vertex normals. They are per particle, so a texture seam does not show, and
//! the particles of a weld share theirs.
//!
//! Reads the mesh, seams and particles; writes the buffers that the caller passes.
//! Invariant: a share of 1 gives the positions of the last tick bit for bit. A particle without a
//! normal (no area, or numbers that overflow) gets zero.

// Without SIMD only the scalar fallbacks run.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::columns::Columns;
use crate::math::simd::{Float, Scalar, Simd, leveled, vectored};
use crate::solver::vertex_sums::contribution::{
    LaneVector, RowBand, SumInput, TriangleContribution,
};
use crate::solver::vertex_sums::triangles;
use crate::solver::vertex_sums::triangles::sum_in_bands;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::sewing::Sewing;
use glam::Vec3;

/// Length of the sum of the normals across a weld, over the sum of their lengths, from which on they
/// share it.
const MIN_SHARED_NORMAL: f32 = 0.01;

/// Writes the absolute position of each render vertex [m].
pub(crate) fn positions(world: &World, out: &mut Vec<Vec3>) {
    scatter_to_vertices(world, &world.particles.x, out);
    if world.origin != Vec3::ZERO {
        out.iter_mut().for_each(|x| *x += world.origin);
    }
}

/// Copies a vector per particle to each render vertex of that particle.
pub(crate) fn scatter_to_vertices(world: &World, per_particle: &Columns, out: &mut Vec<Vec3>) {
    out.clear();
    match &world.seams {
        Some(seams) => {
            out.extend(seams.particles.iter().map(|particle| per_particle.get(*particle as usize)));
        }
        None => out.extend(per_particle.iter()),
    }
}

/// Computes the unit normal of each particle for the surface at positions `x`; zero where there is
/// none. `sums` receives the normals.
pub(crate) fn compute(world: &World, x: &Columns, sums: &mut Columns) {
    sums.resize(x.x.len());
    sums.fill(Vec3::ZERO);
    let input = SumInput {
        triangles: &world.mesh.triangles,
        areas: &world.corner_area,
        cells: world.grid_cells.as_ref(),
        x,
        attribute: x,
    };
    let level = world.level;
    sum_in_bands(world.threads, input, sums, |band, sums| {
        sum_normals(level, input, AreaNormal, band, sums);
    });
    if !world.sewing.is_empty() {
        share_across_welds(&world.sewing, sums);
    }
    world
        .threads
        .parallel_for(sums.slices_mut(), MIN_PARTICLES_PER_THREAD, |sums| normalize(level, sums));
}

/// Computes the positions of all particles at `share` between the previous tick (0) and the last
/// (1).
pub(crate) fn blend_positions(world: &World, share: f32, out: &mut Columns) {
    out.copy_from(&world.particles.x);
    let lists = out.slices_mut().into_iter().zip(world.particles.x_prev_tick.slices());
    lists.for_each(|(x, last)| blend(world.level, x, last, share));
}

/// Gives all members of a welded group the sum of their normals. Where sides face opposite ways, so
/// that the sum has no direction, each keeps its own.
#[inline(never)]
fn share_across_welds(sewing: &Sewing, sums: &mut Columns) {
    for weld in sewing.welds() {
        let normals = weld.clone().map(|i| sums.get(i));
        let (total, size) = normals.fold((Vec3::ZERO, 0.0), |(total, size), normal| {
            (total + normal, size + normal.length())
        });
        if total.length() > MIN_SHARED_NORMAL * size {
            weld.for_each(|i| sums.set(i, total));
        }
    }
}

leveled! {
    /// Blends `x` towards `last`: x · share + last · (1 − share). A share of 1 keeps the bits of
    /// `x`.
    pub(crate) fn blend(x: &mut [f32], last: &[f32], share: f32) = blend_lanes
}

#[inline(always)]
fn blend_lanes(x: &mut [f32], last: &[f32], share: f32) {
    let rest = 1.0 - share;
    for (x, last) in x.iter_mut().zip(last) {
        *x = *x * share + *last * rest;
    }
}

vectored! {
    fn sum_normals(
        input: SumInput<'_>,
        contribution: AreaNormal,
        band: RowBand,
        sums: [&mut [f32]; 3],
    ) = triangles::sum, triangles::sum_scalar
}

vectored! {
    fn normalize(sums: [&mut [f32]; 3]) = normalize_lanes, normalize_scalar
}

#[inline(always)]
fn normalize_lanes<S: Simd>(s: S, [x, y, z]: [&mut [f32]; 3]) {
    let count = x.len();
    let (y, z) = (&mut y[..count], &mut z[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let sum = [s.load(x, at), s.load(y, at), s.load(z, at)];
        let one = normalized_lanes(s, sum);
        s.store(x, at, one[0]);
        s.store(y, at, one[1]);
        s.store(z, at, one[2]);
        at += S::LANES;
    }
    normalize_scalar([&mut x[at..], &mut y[at..], &mut z[at..]]);
}

fn normalize_scalar([x, y, z]: [&mut [f32]; 3]) {
    for ((x, y), z) in x.iter_mut().zip(y).zip(z) {
        [*x, *y, *z] = normalized_lanes(Scalar, [*x, *y, *z]);
    }
}

#[inline(always)]
fn normalized_lanes<S: Simd>(s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    let length = (x * x + y * y + z * z).sqrt();
    let inverse = s.splat(1.0) / length;
    // An infinite length gives no normal.
    let is_one = length.min(s.splat(f32::INFINITY) - length);
    [
        s.select_or_zero(is_one, x * inverse),
        s.select_or_zero(is_one, y * inverse),
        s.select_or_zero(is_one, z * inverse),
    ]
}

/// Normal of a triangle with twice its area as length.
#[derive(Clone, Copy)]
struct AreaNormal;

impl TriangleContribution for AreaNormal {
    const USES_ATTRIBUTE: bool = false;
    const WEIGHTED_BY_AREA: bool = false;

    #[inline(always)]
    fn evaluate<S: Simd>(
        self,
        _: S,
        [a, b, c]: [LaneVector<S>; 3],
        _: [LaneVector<S>; 3],
        _: S::F,
    ) -> LaneVector<S> {
        let (px, py, pz) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        let (qx, qy, qz) = (c[0] - a[0], c[1] - a[1], c[2] - a[2]);
        [py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx]
    }
}
