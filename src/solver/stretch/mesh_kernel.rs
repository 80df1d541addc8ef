//! SIMD kernel for the links of meshes that are not grids.
//!
//! While links are solved, positions are interleaved (see `interleaved_particles`), so that the
//! position of a particle is one load whatever its index is, and each link has the weights of its
//! ends beside it (see `end_weights`). The links of a colour share no particle, so that threads may
//! split them; each thread then owns the points at the ends of its links.
//!
//! Reads the links of a batch and their weights; writes the interleaved positions and λ.
//! Invariant: all arithmetic is `link_projection::compute_correction`, so the bits are those of the
//! scalar code.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::shared_points::SharedPoints;
use crate::math::simd::{GatherPairs, Level, vectored};
use crate::math::threads::Threads;
use crate::model::links::Links;
use crate::solver::particle_stage::access::ParticleAccess;
use crate::solver::particle_stage::interleaved_particles::InterleavedParticles;
use crate::solver::stretch::end_weights::EndWeights;
use crate::solver::stretch::link_projection::{
    BOUND, RIGID, SOFT, compute_correction, project_pair,
};
use crate::solver::world::World;
use core::ops::Range;
use glam::Vec3;

/// Switches to interleaved positions, unless links lie in the rows of a grid.
pub(crate) fn gather(world: &mut World) {
    if world.constraints.rows.is_none() {
        world.scratch.interleaved.gather(&world.particles);
    }
}

/// Switches back to columns, if positions are interleaved.
pub(crate) fn scatter(world: &mut World) {
    world.scratch.interleaved.scatter(&mut world.particles.x);
}

/// The least number of links that is worth a thread.
const MIN_LINKS_PER_THREAD: usize = 8192;

/// Solves the links `range`, which are of one colour. For `scale` see
/// `link_projection::compute_correction`.
///
/// # Panics
/// If a link ends at a particle that does not exist.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    threads: Threads,
    range: Range<usize>,
    (links, lambda): (&Links, &mut [f32]),
    weights: &EndWeights,
    particles: &mut InterleavedParticles,
    scale: f32,
) {
    let InterleavedParticles { points, w, .. } = particles;
    let [wa, wb] = &weights.ends;
    let most = links.a.max_particle().max(links.b.max_particle());
    assert!((most as usize) < points.len(), "every link ends at a particle");
    let (points, w) = (SharedPoints::new(points), &w[..]);
    let joins = ((&links.a[range.clone()], &links.b[range.clone()]), &links.active[range.clone()]);
    let weights = ((&wa[range.clone()], &wb[range.clone()]), &weights.is_even[range.clone()]);
    let lengths = (&links.rest[range.clone()], &links.compliance[range.clone()]);
    let all = (joins, weights, lengths, &mut lambda[range]);
    threads.parallel_for(
        all,
        MIN_LINKS_PER_THREAD,
        |(((a, b), active), (weights, is_even), lengths, lambda)| {
            let ((wa, wb), (rest, compliance)) = (weights, lengths);
            let color =
                MeshColor { a, b, active, wa, wb, is_even, rest, compliance, lambda, points, w };
            match LAW {
                SOFT => solve_soft(level, color, scale),
                RIGID => solve_rigid(level, color, scale),
                _ => solve_bound(level, color, scale),
            }
        },
    );
}

/// The links of one colour that one thread solves, and all particles.
///
/// Only `solve` makes one, after it checked that every end is a particle; no other thread accesses
/// the particles at these ends at the same time.
struct MeshColor<'a> {
    a: &'a [u32],
    b: &'a [u32],
    active: &'a [bool],
    wa: &'a [f32],
    wb: &'a [f32],
    is_even: &'a [bool],
    rest: &'a [f32],
    compliance: &'a [f32],
    lambda: &'a mut [f32],
    points: SharedPoints<'a>,
    w: &'a [f32],
}

vectored! {
    fn solve_soft(color: MeshColor<'_>, scale: f32)
        = solve_color::<_, SOFT>, solve_scalar::<SOFT>
}

vectored! {
    fn solve_rigid(color: MeshColor<'_>, scale: f32)
        = solve_color::<_, RIGID>, solve_scalar::<RIGID>
}

vectored! {
    fn solve_bound(color: MeshColor<'_>, scale: f32)
        = solve_color::<_, BOUND>, solve_scalar::<BOUND>
}

/// Solves the links one by one.
#[inline(always)]
fn solve_scalar<const LAW: u8>(mut color: MeshColor<'_>, scale: f32) {
    (0..color.a.len()).for_each(|link| color.solve::<LAW>(link, scale));
}

#[inline(always)]
fn solve_color<S: GatherPairs, const LAW: u8>(s: S, color: MeshColor<'_>, scale: f32) {
    // Equal lengths let the compiler drop all bounds checks but one.
    let count = color.a.len();
    let mut color = MeshColor {
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
    let is_even = |color: &MeshColor<'_>, link: usize| {
        LAW != BOUND && color.is_even[link..link + S::LANES] == EVEN[..S::LANES]
    };
    let mut link = 0;
    // SAFETY: `solve` checked that all ends are particles, and only this thread accesses them.
    unsafe {
        while is_whole && link + S::LANES <= count {
            // Two separate loops need fewer registers than one with a branch.
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

impl MeshColor<'_> {
    /// Gathers the inverse masses at the two ends of up to eight links.
    #[inline(always)]
    fn inverse_masses(&self, at: [&[u32]; 2]) -> [[f32; 8]; 2] {
        let mut gathered = [[0.0; 8]; 2];
        for (gathered, at) in gathered.iter_mut().zip(at) {
            for (gathered, at) in gathered.iter_mut().zip(at) {
                *gathered = self.w[*at as usize];
            }
        }
        gathered
    }

    /// Solves one link, if it is active.
    #[inline(always)]
    fn solve<const LAW: u8>(&mut self, link: usize, scale: f32) {
        if !self.active[link] {
            return;
        }
        let ends = (self.a[link] as usize, self.b[link] as usize);
        let (rest, compliance) = (self.rest[link], self.compliance[link]);
        let lambda = project_pair::<LAW, _>(ends, rest, compliance, self.lambda[link], self, scale);
        if LAW == SOFT {
            self.lambda[link] = lambda;
        }
    }
}

impl ParticleAccess for MeshColor<'_> {
    #[inline(always)]
    fn particle(&self, i: usize) -> (Vec3, f32) {
        assert!(i < self.points.len(), "every link ends at a particle");
        // SAFETY: the point exists, and only this thread accesses it.
        let [x, y, z, _] = unsafe { *self.points.ptr(i as u32).cast::<[f32; 4]>() };
        (Vec3::new(x, y, z), self.w[i])
    }

    #[inline(always)]
    fn set_position(&mut self, i: usize, x: Vec3) {
        assert!(i < self.points.len(), "every link ends at a particle");
        // SAFETY: as in `particle`.
        unsafe { *self.points.ptr(i as u32).cast::<[f32; 3]>() = x.to_array() };
    }
}

/// The `is_even` of eight links whose ends all have equal weights.
const EVEN: [bool; 8] = [true; 8];

/// Solves `S::LANES` links from `first` on: with `MASKED`, the active ones only; with `IS_EVEN`,
/// the two ends of each have the same weight.
///
/// # Safety
/// Both ends of each link are below the number of points, and no other thread accesses these
/// points.
#[inline(always)]
unsafe fn solve_chunk<S: GatherPairs, const LAW: u8, const MASKED: bool, const IS_EVEN: bool>(
    s: S,
    first: usize,
    color: &mut MeshColor<'_>,
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
        // Equal weights of rigid links are 1.
        [if LAW == RIGID { s.splat(1.0) } else { s.load(color.wa, first) }; 2]
    } else if LAW == BOUND {
        let inverse_masses = color.inverse_masses(at);
        inverse_masses.each_ref().map(|w| s.load(w, 0))
    } else {
        [s.load(color.wa, first), s.load(color.wb, first)]
    };
    // SAFETY: the caller guarantees it.
    let (pairs, span) = unsafe { s.gather_pairs(color.points, at) };
    let (shares, mut multiplier) =
        compute_correction::<LAW, S>(s, span, weights, rest, compliance, lambda, scale);
    // SAFETY: the caller guarantees it, and `active` has an entry for each lane.
    unsafe { s.scatter_pairs::<MASKED>(color.points, at, pairs, shares, active) };
    if LAW == SOFT {
        if MASKED {
            let mut mask = [0.0; 16];
            for (mask, is_active) in mask.iter_mut().zip(active) {
                *mask = f32::from(u8::from(*is_active));
            }
            multiplier = s.select(s.load(&mask, 0), multiplier, lambda);
        }
        s.store(color.lambda, first, multiplier);
    }
}
