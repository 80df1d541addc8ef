//! The links of any mesh, as many at a time as there are lanes.
//!
//! While links are solved, position and inverse mass of a particle lie next to each other, so that an
//! end of a link is one load wherever it is; the ends are turned into lanes. The arithmetic is
//! `links::correct`, the very one that goes link by link, so the bits are the same too.

use super::World;
use super::links::{BOUND, RIGID, SOFT, Spots, correct, project};
use crate::fabric::links::Links;
use crate::math::simd::{Level, Simd, vectored};
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

vectored! {
    fn solve_soft(range: Range<usize>, links: &mut Links, points: &mut Vec<[f32; 4]>, scale: f32)
        = solve_color::<_, SOFT>, Avx2, solve_apart::<SOFT>
}

vectored! {
    fn solve_rigid(range: Range<usize>, links: &mut Links, points: &mut Vec<[f32; 4]>, scale: f32)
        = solve_color::<_, RIGID>, Avx2, solve_apart::<RIGID>
}

vectored! {
    fn solve_bound(range: Range<usize>, links: &mut Links, points: &mut Vec<[f32; 4]>, scale: f32)
        = solve_color::<_, BOUND>, Avx2, solve_apart::<BOUND>
}

/// Links one by one.
#[inline(always)]
fn solve_apart<const LAW: u8>(
    range: Range<usize>,
    links: &mut Links,
    points: &mut Vec<[f32; 4]>,
    scale: f32,
) {
    range.for_each(|link| project::<LAW, _>(links, link, points, scale));
}

#[inline(always)]
fn solve_color<S: Simd, const LAW: u8>(
    s: S,
    range: Range<usize>,
    links: &mut Links,
    points: &mut Vec<[f32; 4]>,
    scale: f32,
) {
    let most =
        |ends: &[u32]| ends.iter().fold(0, |most, end| if *end > most { *end } else { most });
    let (most_a, most_b) = (most(&links.a[range.clone()]), most(&links.b[range.clone()]));
    assert!((most_a.max(most_b) as usize) < points.len(), "links end at particles");
    let mut link = range.start;
    while link + S::LANES <= range.end {
        // SAFETY: all ends of the range were just found to be particles.
        unsafe { solve_chunk::<S, LAW>(s, link, links, points, scale) };
        link += S::LANES;
    }
    solve_apart::<LAW>(link..range.end, links, points, scale);
}

/// As many links as there are lanes.
///
/// # Safety
/// Both ends of each are below the number of points.
#[inline(always)]
unsafe fn solve_chunk<S: Simd, const LAW: u8>(
    s: S,
    first: usize,
    links: &mut Links,
    points: &mut [[f32; 4]],
    scale: f32,
) {
    let all = first..first + S::LANES;
    let (at_a, at_b) = (&links.a[all.clone()], &links.b[all.clone()]);
    let active = &links.active[all];
    let rest = s.load(&links.rest, first);
    let zero = s.splat(0.0);
    let (mut compliance, mut lambda) = (zero, zero);
    if LAW == SOFT {
        compliance = s.load(&links.compliance, first);
        lambda = s.load(&links.lambda, first);
    }
    // SAFETY: the caller's promise.
    let ([xa, ya, za, wa], [xb, yb, zb, wb]) =
        unsafe { (s.fetch(points, at_a), s.fetch(points, at_b)) };
    let (dx, dy, dz) = (xb - xa, yb - ya, zb - za);
    let (share, mut multiplier) =
        correct::<LAW, S>(s, [dx, dy, dz], wa + wb, rest, compliance, lambda, scale);
    let (to_a, to_b) = (share * wa, share * wb);
    let mut a = [xa + dx * to_a, ya + dy * to_a, za + dz * to_a, wa];
    let mut b = [xb - dx * to_b, yb - dy * to_b, zb - dz * to_b, wb];
    if !active.iter().fold(true, |all, active| all & active) {
        let mut keep = [0.0; 16];
        for (keep, is_active) in keep.iter_mut().zip(active) {
            *keep = f32::from(u8::from(*is_active));
        }
        let keep = s.load(&keep, 0);
        a = [s.pick(keep, a[0], xa), s.pick(keep, a[1], ya), s.pick(keep, a[2], za), wa];
        b = [s.pick(keep, b[0], xb), s.pick(keep, b[1], yb), s.pick(keep, b[2], zb), wb];
        multiplier = s.pick(keep, multiplier, lambda);
    }
    // SAFETY: the caller's promise.
    unsafe {
        s.put(points, at_a, a);
        s.put(points, at_b, b);
    }
    if LAW == SOFT {
        s.store(&mut links.lambda, first, multiplier);
    }
}
