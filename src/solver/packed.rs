//! The links of any mesh, as many at a time as there are lanes.
//!
//! While links are solved, the position of a particle is one load, wherever it is, and a link has the
//! inverse masses of its ends beside it. The arithmetic is `links::correct`, the very one that goes
//! link by link, so the bits are the same too.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::World;
use super::links::{BOUND, RIGID, SOFT, Spots, correct, project};
use crate::fabric::links::Links;
use crate::math::simd::{Between, Level, vectored};
use core::ops::Range;
use glam::Vec3;

/// Particles and links as the kernels want them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packed {
    /// x, y, z and 0.
    pub points: Vec<[f32; 4]>,
    /// Whether positions are here and not in their columns.
    pub is_current: bool,
    /// Inverse masses of the particles, …
    pub w: Vec<f32>,
    /// … and from them those of each woven link's ends.
    ends: [Vec<f32>; 2],
}

impl Spots for Packed {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        let [x, y, z, _] = self.points[i];
        (Vec3::new(x, y, z), self.w[i])
    }

    #[inline(always)]
    fn put(&mut self, i: usize, x: Vec3) {
        self.points[i][..3].copy_from_slice(&x.to_array());
    }
}

impl Packed {
    /// Makes room for `particles` and `links` in all.
    pub fn reserve(&mut self, particles: usize, links: usize) {
        self.points.reserve_exact(particles.saturating_sub(self.points.len()));
        self.w.reserve_exact(particles.saturating_sub(self.w.len()));
        for list in &mut self.ends {
            list.reserve_exact(links.saturating_sub(list.len()));
        }
    }

    /// Looks up the inverse masses of links' ends, if any changed or a vertex split.
    fn weigh(&mut self, w: &[f32], links: &Links) {
        if self.w == w {
            return;
        }
        self.w.clear();
        self.w.extend_from_slice(w);
        for (list, ends) in self.ends.iter_mut().zip([&links.a, &links.b]) {
            list.clear();
            list.extend(ends.iter().map(|end| w[*end as usize]));
        }
    }
}

/// Packs the particles, unless links lie in rows.
pub(crate) fn pack(world: &mut World) {
    if world.weave.rows.is_some() {
        return;
    }
    let (p, packed) = (&world.particles, &mut world.scratch.packed);
    packed.points.clear();
    let particles = p.x.x.iter().zip(&p.x.y).zip(&p.x.z);
    packed.points.extend(particles.map(|((x, y), z)| [*x, *y, *z, 0.0]));
    packed.weigh(&p.w, &world.weave.links);
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
    packed: &mut Packed,
    scale: f32,
) {
    match LAW {
        SOFT => solve_soft(level, range, links, packed, scale),
        RIGID => solve_rigid(level, range, links, packed, scale),
        _ => solve_bound(level, range, links, packed, scale),
    }
}

vectored! {
    fn solve_soft(range: Range<usize>, links: &mut Links, packed: &mut Packed, scale: f32)
        = solve_color::<_, SOFT>, Avx2, solve_apart::<SOFT>
}

vectored! {
    fn solve_rigid(range: Range<usize>, links: &mut Links, packed: &mut Packed, scale: f32)
        = solve_color::<_, RIGID>, Avx2, solve_apart::<RIGID>
}

vectored! {
    fn solve_bound(range: Range<usize>, links: &mut Links, packed: &mut Packed, scale: f32)
        = solve_color::<_, BOUND>, Avx2, solve_apart::<BOUND>
}

/// Links one by one.
#[inline(always)]
fn solve_apart<const LAW: u8>(
    range: Range<usize>,
    links: &mut Links,
    packed: &mut Packed,
    scale: f32,
) {
    range.for_each(|link| project::<LAW, _>(links, link, packed, scale));
}

#[inline(always)]
fn solve_color<S: Between, const LAW: u8>(
    s: S,
    range: Range<usize>,
    links: &mut Links,
    packed: &mut Packed,
    scale: f32,
) {
    let mut most = 0;
    for ends in [&links.a[range.clone()], &links.b[range.clone()]] {
        for end in ends {
            most = if *end > most { *end } else { most };
        }
    }
    assert!((most as usize) < packed.points.len(), "links end at particles");
    let mut is_whole = true;
    for is_active in &links.active[range.clone()] {
        is_whole &= is_active;
    }
    let mut link = range.start;
    while link + S::LANES <= range.end {
        // SAFETY: all ends of the range were just found to be particles.
        unsafe {
            if is_whole {
                solve_chunk::<S, LAW, false>(s, link, links, packed, scale);
            } else {
                solve_chunk::<S, LAW, true>(s, link, links, packed, scale);
            }
        }
        link += S::LANES;
    }
    solve_apart::<LAW>(link..range.end, links, packed, scale);
}

/// As many links as there are lanes; with `CHOOSY` set, only those that hold.
///
/// # Safety
/// Both ends of each are below the number of points.
#[inline(always)]
unsafe fn solve_chunk<S: Between, const LAW: u8, const CHOOSY: bool>(
    s: S,
    first: usize,
    links: &mut Links,
    packed: &mut Packed,
    scale: f32,
) {
    let all = first..first + S::LANES;
    let at = [&links.a[all.clone()], &links.b[all.clone()]];
    let active = &links.active[all];
    let rest = s.load(&links.rest, first);
    let zero = s.splat(0.0);
    let (mut compliance, mut lambda) = (zero, zero);
    if LAW == SOFT {
        compliance = s.load(&links.compliance, first);
        lambda = s.load(&links.lambda, first);
    }
    let [wa, wb] = [s.load(&packed.ends[0], first), s.load(&packed.ends[1], first)];
    // SAFETY: the caller's promise.
    let (pairs, span) = unsafe { s.fetch(&packed.points, at) };
    let (share, mut multiplier) =
        correct::<LAW, S>(s, span, wa + wb, rest, compliance, lambda, scale);
    let shares = [share * wa, share * wb];
    // SAFETY: the caller's promise, and `active` has an entry for each lane.
    unsafe { s.put::<CHOOSY>(&mut packed.points, at, pairs, shares, active) };
    if LAW == SOFT {
        if CHOOSY {
            let mut keep = [0.0; 16];
            for (keep, is_active) in keep.iter_mut().zip(active) {
                *keep = f32::from(u8::from(*is_active));
            }
            multiplier = s.pick(s.load(&keep, 0), multiplier, lambda);
        }
        s.store(&mut links.lambda, first, multiplier);
    }
}
