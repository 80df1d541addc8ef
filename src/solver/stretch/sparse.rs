//! SparseLinks links, as many at a time as there are lanes, wherever their particles are.
//!
//! The arithmetic is `links::correct`, the very one that goes link by link, so the bits are the same too.

use crate::math::simd::{LANES, Level, Scalar, Simd, vectored};
use crate::model::links::Links;
use crate::model::sparse_links::SparseLinks;
use crate::solver::particle_stage::access::{Sheet, Spots, fetch, put};
use crate::solver::stretch::distance::{BOUND, Order, RIGID, SOFT, correct};
use crate::solver::stretch::mesh_kernel::Packed;
use crate::state::particles::Particles;

/// Links of a batch, and the list that they are numbers of.
pub(crate) struct Color<'a> {
    a: &'a [u32],
    b: &'a [u32],
    rest: &'a [f32],
    /// What their ends weigh, but for `BOUND`.
    ends: [&'a [f32]; 2],
    link: &'a [u32],
    compliance: &'a [f32],
    lambda: &'a mut [f32],
}

/// Where loose links may find their particles.
pub(crate) trait Field: Spots {
    /// Solves links no two of which share a particle.
    fn solve_abreast(&mut self, level: Level, color: Color<'_>, law: u8, scale: f32);
}

impl Field for Particles {
    fn solve_abreast(&mut self, level: Level, color: Color<'_>, law: u8, scale: f32) {
        in_columns(level, color, self, law, scale);
    }
}

impl Field for Packed {
    fn solve_abreast(&mut self, level: Level, color: Color<'_>, law: u8, scale: f32) {
        in_points(level, color, self, law, scale);
    }
}

/// Solves a batch of loose links.
pub(crate) fn solve<const LAW: u8, P: Field>(
    level: Level,
    loose: &SparseLinks,
    (batch, order): (usize, Order),
    links: &mut Links,
    spots: &mut P,
    scale: f32,
) {
    let (own, is_colored) = loose.of_batch(batch);
    if own.is_empty() {
        return;
    }
    // A bound may come before the ends are weighed anew.
    let ends = if LAW == BOUND { 0..0 } else { own.clone() };
    let mut color = Color {
        a: &loose.a[own.clone()],
        b: &loose.b[own.clone()],
        rest: &loose.rest[own.clone()],
        ends: [&loose.ends[0][ends.clone()], &loose.ends[1][ends]],
        link: &loose.link[own],
        compliance: &links.compliance,
        lambda: &mut links.lambda,
    };
    if is_colored {
        return spots.solve_abreast(level, color, LAW, scale);
    }
    let count = color.a.len();
    for number in 0..count {
        let at = if order == Order::Forward { number } else { count - 1 - number };
        color.some::<_, P, LAW>(Scalar, at, spots, scale);
    }
}

vectored! {
    fn in_columns(color: Color<'_>, p: &mut Particles, law: u8, scale: f32)
        = by_law_in_columns, Avx2, apart_in_columns
}

#[inline(always)]
fn by_law_in_columns<S: Simd>(s: S, color: Color<'_>, p: &mut Particles, law: u8, scale: f32) {
    by_law(s, color, &mut Sheet::new(p), law, scale);
}

fn apart_in_columns(color: Color<'_>, p: &mut Particles, law: u8, scale: f32) {
    by_law_in_columns(Scalar, color, p, law, scale);
}

vectored! {
    fn in_points(color: Color<'_>, packed: &mut Packed, law: u8, scale: f32)
        = by_law, Avx2, apart_in_points
}

fn apart_in_points(color: Color<'_>, packed: &mut Packed, law: u8, scale: f32) {
    by_law(Scalar, color, packed, law, scale);
}

#[inline(always)]
fn by_law<S: Simd, P: Spots>(s: S, color: Color<'_>, spots: &mut P, law: u8, scale: f32) {
    match law {
        SOFT => abreast::<S, P, SOFT>(s, color, spots, scale),
        RIGID => abreast::<S, P, RIGID>(s, color, spots, scale),
        _ => abreast::<S, P, BOUND>(s, color, spots, scale),
    }
}

#[inline(always)]
fn abreast<S: Simd, P: Spots, const LAW: u8>(
    s: S,
    mut color: Color<'_>,
    spots: &mut P,
    scale: f32,
) {
    let count = color.a.len();
    let whole = count / S::LANES * S::LANES;
    for at in (0..whole).step_by(S::LANES) {
        color.some::<S, P, LAW>(s, at, spots, scale);
    }
    for at in whole..count {
        color.some::<_, P, LAW>(Scalar, at, spots, scale);
    }
}

impl Color<'_> {
    /// As many links as there are lanes.
    #[inline(always)]
    fn some<S: Simd, P: Spots, const LAW: u8>(
        &mut self,
        s: S,
        first: usize,
        spots: &mut P,
        scale: f32,
    ) {
        let own = first..first + S::LANES;
        let (a, b) = (&self.a[own.clone()], &self.b[own.clone()]);
        let ((xa, wa), (xb, wb)) = (fetch(s, spots, a), fetch(s, spots, b));
        let weights = if LAW == BOUND {
            [wa, wb]
        } else {
            [s.load(self.ends[0], first), s.load(self.ends[1], first)]
        };
        let link = &self.link[own];
        let (mut compliance, mut lambda) = ([0.0; LANES], [0.0; LANES]);
        if LAW == SOFT {
            for lane in 0..S::LANES {
                compliance[lane] = self.compliance[link[lane] as usize];
                lambda[lane] = self.lambda[link[lane] as usize];
            }
        }
        let (compliance, before) = (s.load(&compliance, 0), s.load(&lambda, 0));
        let span = [xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]];
        let rest = s.load(self.rest, first);
        let ([to_a, to_b], pulled) =
            correct::<LAW, _>(s, span, weights, rest, compliance, before, scale);
        let (mut ya, mut yb) = (xa, xb);
        for axis in 0..3 {
            ya[axis] = xa[axis] + span[axis] * to_a;
            yb[axis] = xb[axis] - span[axis] * to_b;
        }
        put(s, spots, a, ya);
        put(s, spots, b, yb);
        if LAW == SOFT {
            s.store(&mut lambda, 0, pulled);
            for lane in 0..S::LANES {
                self.lambda[link[lane] as usize] = lambda[lane];
            }
        }
    }
}
