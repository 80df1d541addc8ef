//! The links of any mesh, as many at a time as there are lanes.
//!
//! While links are solved, the position of a particle is one load, wherever it is, and a link has the
//! inverse masses of its ends beside it. The arithmetic is `links::correct`, the very one that goes
//! link by link, so the bits are the same too. Links of one colour share no particle, so that several
//! threads may each have some of them, and the points at their ends, to themselves.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::shared::Points;
use crate::math::simd::{Between, Level, vectored};
use crate::math::threads::Threads;
use crate::model::links::Links;
use crate::solver::particle_stage::access::Spots;
use crate::solver::stretch::distance::{BOUND, RIGID, SOFT, correct, pull};
use crate::solver::stretch::inverse_masses::Weights;
use crate::solver::world::World;
use core::ops::Range;
use glam::Vec3;

/// Particles and links as the kernels want them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packed {
    /// x, y, z and 0.
    pub points: Vec<[f32; 4]>,
    /// Whether positions are here and not in their columns.
    pub is_current: bool,
    /// Inverse masses of the particles.
    pub w: Vec<f32>,
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
    /// Makes room for `particles` in all.
    pub fn reserve(&mut self, particles: usize) {
        self.points.reserve_exact(particles.saturating_sub(self.points.len()));
        self.w.reserve_exact(particles.saturating_sub(self.w.len()));
    }
}

/// Packs the particles, unless links lie in rows.
pub(crate) fn pack(world: &mut World) {
    if world.constraints.rows.is_some() {
        return;
    }
    let (p, packed) = (&world.particles, &mut world.scratch.interleaved);
    packed.points.clear();
    let particles = p.x.x.iter().zip(&*p.x.y).zip(&*p.x.z);
    packed.points.extend(particles.map(|((x, y), z)| [*x, *y, *z, 0.0]));
    packed.w.clone_from(&p.w);
    packed.is_current = true;
}

/// Puts positions back into their columns.
pub(crate) fn unpack(world: &mut World) {
    if !core::mem::take(&mut world.scratch.interleaved.is_current) {
        return;
    }
    let x = &mut world.particles.x;
    let particles = x.x.iter_mut().zip(&mut *x.y).zip(&mut *x.z);
    for (((x, y), z), point) in particles.zip(&world.scratch.interleaved.points) {
        [*x, *y, *z, _] = *point;
    }
}

/// Links that one thread solves at least.
const LINKS: usize = 8192;

/// Solves the links `range`, which are of one colour.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    threads: Threads,
    range: Range<usize>,
    links: &mut Links,
    weights: &Weights,
    packed: &mut Packed,
    scale: f32,
) {
    let Packed { points, w, .. } = packed;
    let [wa, wb] = &weights.ends;
    let most = links.a.most().max(links.b.most());
    assert!((most as usize) < points.len(), "links end at particles");
    let (points, w) = (Points::new(points), &w[..]);
    let joins = ((&links.a[range.clone()], &links.b[range.clone()]), &links.active[range.clone()]);
    let weights = ((&wa[range.clone()], &wb[range.clone()]), &weights.is_even[range.clone()]);
    let lengths = (&links.rest[range.clone()], &links.compliance[range.clone()]);
    let all = (joins, weights, lengths, &mut links.lambda[range]);
    threads.over(all, LINKS, |(((a, b), active), (weights, is_even), lengths, lambda)| {
        let ((wa, wb), (rest, compliance)) = (weights, lengths);
        let color = Color { a, b, active, wa, wb, is_even, rest, compliance, lambda, points, w };
        match LAW {
            SOFT => solve_soft(level, color, scale),
            RIGID => solve_rigid(level, color, scale),
            _ => solve_bound(level, color, scale),
        }
    });
}

/// Links of one colour, and the particles at their ends, which there are: of no other link at the same
/// time. Only `solve` makes them, which looks at that.
struct Color<'a> {
    a: &'a [u32],
    b: &'a [u32],
    active: &'a [bool],
    wa: &'a [f32],
    wb: &'a [f32],
    is_even: &'a [bool],
    rest: &'a [f32],
    compliance: &'a [f32],
    lambda: &'a mut [f32],
    points: Points<'a>,
    w: &'a [f32],
}

vectored! {
    fn solve_soft(color: Color<'_>, scale: f32)
        = solve_color::<_, SOFT>, Avx2, solve_apart::<SOFT>
}

vectored! {
    fn solve_rigid(color: Color<'_>, scale: f32)
        = solve_color::<_, RIGID>, Avx2, solve_apart::<RIGID>
}

vectored! {
    fn solve_bound(color: Color<'_>, scale: f32)
        = solve_color::<_, BOUND>, Avx2, solve_apart::<BOUND>
}

/// Links one by one.
#[inline(always)]
fn solve_apart<const LAW: u8>(mut color: Color<'_>, scale: f32) {
    (0..color.a.len()).for_each(|link| color.solve::<LAW>(link, scale));
}

#[inline(always)]
fn solve_color<S: Between, const LAW: u8>(s: S, color: Color<'_>, scale: f32) {
    // One length for all columns, so that one check does for all.
    let count = color.a.len();
    let mut color = Color {
        b: &color.b[..count],
        active: &color.active[..count],
        wa: &color.wa[..count],
        wb: &color.wb[..count],
        is_even: &color.is_even[..count],
        rest: &color.rest[..count],
        compliance: &color.compliance[..count],
        lambda: &mut color.lambda[..count],
        ..color
    };
    let mut is_whole = true;
    for is_active in color.active {
        is_whole &= is_active;
    }
    let is_even = |color: &Color<'_>, link: usize| {
        LAW != BOUND && color.is_even[link..link + S::LANES] == EVEN[..S::LANES]
    };
    let mut link = 0;
    // SAFETY: all ends are particles, as `solve` found, and this thread has them to itself.
    unsafe {
        while is_whole && link + S::LANES <= count {
            // Loops of their own, which need less room.
            while link + S::LANES <= count && is_even(&color, link) {
                solve_chunk::<S, LAW, false, true>(s, link, &mut color, scale);
                link += S::LANES;
            }
            while link + S::LANES <= count && !is_even(&color, link) {
                solve_chunk::<S, LAW, false, false>(s, link, &mut color, scale);
                link += S::LANES;
            }
        }
        while link + S::LANES <= count {
            solve_chunk::<S, LAW, true, false>(s, link, &mut color, scale);
            link += S::LANES;
        }
    }
    (link..count).for_each(|link| color.solve::<LAW>(link, scale));
}

impl Color<'_> {
    /// Those of the particles at the ends of as many links as there are lanes.
    #[inline(always)]
    fn inverse_masses(&self, at: [&[u32]; 2]) -> [[f32; 8]; 2] {
        let mut found = [[0.0; 8]; 2];
        for (found, at) in found.iter_mut().zip(at) {
            for (found, at) in found.iter_mut().zip(at) {
                *found = self.w[*at as usize];
            }
        }
        found
    }

    /// One link by itself.
    #[inline(always)]
    fn solve<const LAW: u8>(&mut self, link: usize, scale: f32) {
        if !self.active[link] {
            return;
        }
        let ends = (self.a[link] as usize, self.b[link] as usize);
        let (rest, compliance) = (self.rest[link], self.compliance[link]);
        let lambda = pull::<LAW, _>(ends, rest, compliance, self.lambda[link], self, scale);
        if LAW == SOFT {
            self.lambda[link] = lambda;
        }
    }
}

impl Spots for Color<'_> {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        assert!(i < self.points.len(), "links end at particles");
        // SAFETY: there is such a point, and this thread has it to itself.
        let [x, y, z, _] = unsafe { *self.points.at(i as u32).cast::<[f32; 4]>() };
        (Vec3::new(x, y, z), self.w[i])
    }

    #[inline(always)]
    fn put(&mut self, i: usize, x: Vec3) {
        assert!(i < self.points.len(), "links end at particles");
        // SAFETY: as above.
        unsafe { *self.points.at(i as u32).cast::<[f32; 3]>() = x.to_array() };
    }
}

/// Where both ends of all links weigh the same.
const EVEN: [bool; 8] = [true; 8];

/// As many links as there are lanes; with `CHOOSY` set, only those that hold; with `IS_EVEN` set,
/// their two ends weigh the same.
///
/// # Safety
/// Both ends of each are below the number of points, and no other thread reaches those.
#[inline(always)]
unsafe fn solve_chunk<S: Between, const LAW: u8, const CHOOSY: bool, const IS_EVEN: bool>(
    s: S,
    first: usize,
    color: &mut Color<'_>,
    scale: f32,
) {
    let all = first..first + S::LANES;
    let at = [&color.a[all.clone()], &color.b[all.clone()]];
    let active = &color.active[all];
    let rest = s.load(color.rest, first);
    let zero = s.splat(0.0);
    let (mut compliance, mut lambda) = (zero, zero);
    if LAW == SOFT {
        compliance = s.load(color.compliance, first);
        lambda = s.load(color.lambda, first);
    }
    let weights = if IS_EVEN {
        // Those of rigid links are 1 then.
        [if LAW == RIGID { s.splat(1.0) } else { s.load(color.wa, first) }; 2]
    } else if LAW == BOUND {
        let inverse_masses = color.inverse_masses(at);
        inverse_masses.each_ref().map(|w| s.load(w, 0))
    } else {
        [s.load(color.wa, first), s.load(color.wb, first)]
    };
    // SAFETY: the caller's promise.
    let (pairs, span) = unsafe { s.fetch(color.points, at) };
    let (shares, mut multiplier) =
        correct::<LAW, S>(s, span, weights, rest, compliance, lambda, scale);
    // SAFETY: the caller's promise, and `active` has an entry for each lane.
    unsafe { s.put::<CHOOSY>(color.points, at, pairs, shares, active) };
    if LAW == SOFT {
        if CHOOSY {
            let mut keep = [0.0; 16];
            for (keep, is_active) in keep.iter_mut().zip(active) {
                *keep = f32::from(u8::from(*is_active));
            }
            multiplier = s.pick(s.load(&keep, 0), multiplier, lambda);
        }
        s.store(color.lambda, first, multiplier);
    }
}
