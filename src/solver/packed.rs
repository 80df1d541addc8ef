//! The links of any mesh, eight at a time.
//!
//! While links are solved, position and inverse mass of a particle lie next to each other, so that an
//! end of a link is one load wherever it is; eight ends are turned into lanes. The arithmetic is
//! `links::correct`, the very one that goes link by link, so the bits are the same too.

use super::World;
use super::links::{BOUND, RIGID, SOFT, Spots, correct, project};
use crate::fabric::links::Links;
use crate::math::simd::{LANES, Level, gather, lanes, leveled, scatter};
use core::ops::Range;
use glam::Vec3;

/// Particles as the kernels want them: x, y, z and inverse mass.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packed {
    pub points: Vec<[f32; 4]>,
    /// Whether positions are here and not in their columns.
    pub is_current: bool,
}

impl Spots for Vec<[f32; 4]> {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        let [x, y, z, w] = self[i];
        (Vec3::new(x, y, z), w)
    }

    #[inline(always)]
    fn put(&mut self, i: usize, x: Vec3) {
        self[i][..3].copy_from_slice(&x.to_array());
    }
}

/// Packs the particles, unless links lie in rows.
pub(crate) fn pack(world: &mut World) {
    if world.weave.rows.is_some() {
        return;
    }
    let (p, packed) = (&world.particles, &mut world.scratch.packed);
    packed.points.clear();
    let particles = p.x.x.iter().zip(&p.x.y).zip(&p.x.z).zip(&p.w);
    packed.points.extend(particles.map(|(((x, y), z), w)| [*x, *y, *z, *w]));
    packed.is_current = true;
}

/// Puts positions back into their columns.
pub(crate) fn unpack(world: &mut World) {
    if !core::mem::take(&mut world.scratch.packed.is_current) {
        return;
    }
    let x = &mut world.particles.x;
    let particles = x.x.iter_mut().zip(&mut x.y).zip(&mut x.z);
    for (((x, y), z), point) in particles.zip(&world.scratch.packed.points) {
        [*x, *y, *z, _] = *point;
    }
}

/// Solves the links `range`, which are of one colour.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    range: Range<usize>,
    links: &mut Links,
    points: &mut Vec<[f32; 4]>,
    scale: f32,
) {
    match LAW {
        SOFT => solve_soft(level, range, links, points, scale),
        RIGID => solve_rigid(level, range, links, points, scale),
        _ => solve_bound(level, range, links, points, scale),
    }
}

leveled! {
    fn solve_soft(range: Range<usize>, links: &mut Links, points: &mut Vec<[f32; 4]>, scale: f32)
        = solve_color::<SOFT, false>, solve_color::<SOFT, true>
}

leveled! {
    fn solve_rigid(range: Range<usize>, links: &mut Links, points: &mut Vec<[f32; 4]>, scale: f32)
        = solve_color::<RIGID, false>, solve_color::<RIGID, true>
}

leveled! {
    fn solve_bound(range: Range<usize>, links: &mut Links, points: &mut Vec<[f32; 4]>, scale: f32)
        = solve_color::<BOUND, false>, solve_color::<BOUND, true>
}

#[inline(always)]
fn solve_color<const LAW: u8, const FAST: bool>(
    range: Range<usize>,
    links: &mut Links,
    points: &mut Vec<[f32; 4]>,
    scale: f32,
) {
    let whole = range.len() / LANES * LANES;
    for first in (range.start..range.start + whole).step_by(LANES) {
        solve_chunk::<LAW, FAST>(first, links, points, scale);
    }
    for link in range.start + whole..range.end {
        project::<LAW, _>(links, link, points, scale);
    }
}

#[inline(always)]
fn solve_chunk<const LAW: u8, const FAST: bool>(
    first: usize,
    links: &mut Links,
    points: &mut [[f32; 4]],
    scale: f32,
) {
    let end = first + LANES;
    let mut keep = [true; LANES];
    keep.copy_from_slice(&links.active[first..end]);
    let (mut at_a, mut at_b) = ([0; LANES], [0; LANES]);
    at_a.copy_from_slice(&links.a[first..end]);
    at_b.copy_from_slice(&links.b[first..end]);
    let rest = lanes(&links.rest, first);
    let (mut compliance, mut lambda) = ([0.0; LANES], [0.0; LANES]);
    if LAW == SOFT {
        compliance = lanes(&links.compliance, first);
        lambda = lanes(&links.lambda, first);
    }
    let [mut xa, mut ya, mut za, wa] = gather::<FAST>(points, &at_a);
    let [mut xb, mut yb, mut zb, wb] = gather::<FAST>(points, &at_b);
    for i in 0..LANES {
        let (dx, dy, dz) = (xb[i] - xa[i], yb[i] - ya[i], zb[i] - za[i]);
        let (weight, compliance) = (wa[i] + wb[i], compliance[i]);
        let (share, multiplier) =
            correct::<LAW>([dx, dy, dz], weight, rest[i], compliance, lambda[i], scale);
        let (to_a, to_b) = (share * wa[i], -(share * wb[i]));
        let take = |new: f32, old: f32| if keep[i] { new } else { old };
        xa[i] = take(xa[i] + dx * to_a, xa[i]);
        ya[i] = take(ya[i] + dy * to_a, ya[i]);
        za[i] = take(za[i] + dz * to_a, za[i]);
        xb[i] = take(xb[i] + dx * to_b, xb[i]);
        yb[i] = take(yb[i] + dy * to_b, yb[i]);
        zb[i] = take(zb[i] + dz * to_b, zb[i]);
        lambda[i] = take(multiplier, lambda[i]);
    }
    if LAW == SOFT {
        links.lambda[first..end].copy_from_slice(&lambda);
    }
    scatter::<FAST>(points, &at_a, &[xa, ya, za, wa]);
    scatter::<FAST>(points, &at_b, &[xb, yb, zb, wb]);
}
