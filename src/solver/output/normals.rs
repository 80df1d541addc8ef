//! Stage `Outputs`: what a renderer reads, from what the solver keeps.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::solver::vertex_sums::triangles;

use crate::math::columns::Columns;
use crate::math::max;
use crate::math::simd::{Float, Scalar, Simd, leveled, vectored};
use crate::model::links::LinkKind;
use crate::solver::vertex_sums::triangles::{Band, Give, Surface, V, in_bands};
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use glam::Vec3;

/// Positions, one a vertex.
pub(crate) fn positions(world: &World, out: &mut Vec<Vec3>) {
    hand_out(world, &world.particles.x, out);
}

/// What particles have, for each vertex.
pub(crate) fn hand_out(world: &World, of_particles: &Columns, out: &mut Vec<Vec3>) {
    out.clear();
    match &world.seams {
        Some(seams) => {
            out.extend(seams.particles.iter().map(|particle| of_particles.at(*particle as usize)));
        }
        None => out.extend(of_particles.iter()),
    }
}

/// Normals of the surface at `x`, one a particle, so that no seam shows: the mean of the triangles around,
/// weighted by area. Zero where there is none.
pub(crate) fn normals(world: &World, x: &Columns, sums: &mut Columns) {
    sums.resize(x.x.len());
    sums.fill(Vec3::ZERO);
    let surface = Surface {
        triangles: &world.mesh.triangles,
        areas: &world.corner_area,
        cells: world.grid_cells.as_ref(),
        x,
        air: x,
    };
    let level = world.level;
    in_bands(world.threads, surface, sums, |band, sums| {
        sum_normals(level, surface, Doubled, band, sums);
    });
    world
        .threads
        .parallel_for(sums.all_mut(), MIN_PARTICLES_PER_THREAD, |sums| normalize(level, sums));
}

/// Where the particles are at a share of the way from the last tick to this one.
pub(crate) fn between(world: &World, share: f32, out: &mut Columns) {
    out.copy_from(&world.particles.x);
    let lists = out.all_mut().into_iter().zip(world.particles.x_last.all());
    lists.for_each(|(x, last)| blend(world.level, x, last, share));
}

leveled! {
    /// Moves numbers back to a share of the way from `last`; a share of 1 leaves their very bits.
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
    fn sum_normals(surface: Surface<'_>, give: Doubled, band: Band, sums: [&mut [f32]; 3])
        = triangles::sum, Avx2, triangles::sum_apart
}

vectored! {
    fn normalize(sums: [&mut [f32]; 3]) = normalize_lanes, Avx512, normalize_apart
}

#[inline(always)]
fn normalize_lanes<S: Simd>(s: S, [x, y, z]: [&mut [f32]; 3]) {
    let count = x.len();
    let (y, z) = (&mut y[..count], &mut z[..count]);
    let mut at = 0;
    while at + S::LANES <= count {
        let sum = [s.load(x, at), s.load(y, at), s.load(z, at)];
        let one = normalized(s, sum);
        s.store(x, at, one[0]);
        s.store(y, at, one[1]);
        s.store(z, at, one[2]);
        at += S::LANES;
    }
    normalize_apart([&mut x[at..], &mut y[at..], &mut z[at..]]);
}

fn normalize_apart([x, y, z]: [&mut [f32]; 3]) {
    for ((x, y), z) in x.iter_mut().zip(y).zip(z) {
        [*x, *y, *z] = normalized(Scalar, [*x, *y, *z]);
    }
}

#[inline(always)]
fn normalized<S: Simd>(s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    let length = (x * x + y * y + z * z).sqrt();
    let inverse = s.splat(1.0) / length;
    // Where numbers end there is no normal either.
    let is_one = length.min(s.splat(f32::INFINITY) - length);
    [
        s.select_or_zero(is_one, x * inverse),
        s.select_or_zero(is_one, y * inverse),
        s.select_or_zero(is_one, z * inverse),
    ]
}

/// A triangle's normal, as long as twice its area.
#[derive(Clone, Copy)]
struct Doubled;

impl Give for Doubled {
    const FEELS_AIR: bool = false;
    const BY_AREA: bool = false;

    #[inline(always)]
    fn give<S: Simd>(self, _: S, [a, b, c]: [V<S>; 3], _: [V<S>; 3], _: S::F) -> V<S> {
        let (px, py, pz) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        let (qx, qy, qz) = (c[0] - a[0], c[1] - a[1], c[2] - a[2]);
        [py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx]
    }
}

/// The greatest and the mean stretch of the stretch links: 0.01 is 1 % longer than at rest.
pub(crate) fn stretch(world: &World) -> (f32, f32) {
    let x = &world.particles.x;
    let (mut most, mut sum, mut count) = (0.0_f32, 0.0_f64, 0_u32);
    for links in [&world.constraints.links, &world.constraints.extra] {
        for link in 0..links.len() {
            if links.active[link] && links.kind(link) == LinkKind::Stretch {
                let span = x.at(links.b[link] as usize) - x.at(links.a[link] as usize);
                let stretch = span.length() / links.rest[link] - 1.0;
                most = if stretch > most { stretch } else { most };
                sum += f64::from(stretch);
                count += 1;
            }
        }
    }
    (most, if count == 0 { 0.0 } else { (sum / f64::from(count)) as f32 })
}

/// The speed of the fastest particle [m/s].
pub(crate) fn max_speed(world: &World) -> f32 {
    world.particles.v.iter().fold(0.0, |most, v| max(most, v.length_squared())).sqrt()
}

/// Energy of motion [J].
pub(crate) fn kinetic_energy(world: &World) -> f32 {
    let p = &world.particles;
    let of = |i: usize| 0.5 * f64::from(p.mass[i]) * f64::from(p.v.at(i).length_squared());
    (0..p.len()).map(of).sum::<f64>() as f32
}
