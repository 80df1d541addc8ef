//! Loose links, as many at a time as there are lanes, wherever their particles are.
//!
//! The arithmetic is `links::correct`, the very one that goes link by link, so the bits are the same too.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::links::{BOUND, Order, RIGID, SOFT, Spots, correct, pull};
use super::packed::Packed;
use crate::fabric::links::Links;
use crate::fabric::loose::Loose;
use crate::math::TINY;
use crate::math::columns::Columns;
use crate::math::simd::{LANES, Lanes, Level, Number, Simd, vectored};
use crate::state::particles::Particles;
use glam::Vec3;

/// Links of a colour, and the list that they are numbers of.
struct Color<'a> {
    a: &'a [u32],
    b: &'a [u32],
    rest: &'a [f32],
    link: &'a [u32],
    compliance: &'a [f32],
    lambda: &'a mut [f32],
}

/// Solves a batch of loose links of particles that lie in columns.
pub(crate) fn solve<const LAW: u8>(
    level: Level,
    loose: &Loose,
    (batch, order): (usize, Order),
    links: &mut Links,
    p: &mut Particles,
    scale: f32,
) {
    if loose.is_colored(batch) {
        in_columns(level, Color::new(loose, batch, links), p, LAW, scale);
    } else {
        one_by_one::<LAW, _>(Color::new(loose, batch, links), order, p, scale);
    }
}

/// The same where particles are packed.
pub(crate) fn solve_packed<const LAW: u8>(
    level: Level,
    loose: &Loose,
    (batch, order): (usize, Order),
    links: &mut Links,
    packed: &mut Packed,
    scale: f32,
) {
    if loose.is_colored(batch) {
        in_points(level, Color::new(loose, batch, links), packed, LAW, scale);
    } else {
        one_by_one::<LAW, _>(Color::new(loose, batch, links), order, packed, scale);
    }
}

/// Particles in columns that are all as long as each other, so that one check does for all.
struct Sheet<'a> {
    x: [&'a mut [f32]; 3],
    w: &'a [f32],
}

impl<'a> Sheet<'a> {
    #[inline(always)]
    fn new(p: &'a mut Particles) -> Self {
        let count = p.w.len();
        let Columns { x, y, z } = &mut p.x;
        Self { x: [&mut x[..count], &mut y[..count], &mut z[..count]], w: &p.w[..count] }
    }
}

impl Spots for Sheet<'_> {
    #[inline(always)]
    fn spot(&self, i: usize) -> (Vec3, f32) {
        let [x, y, z] = &self.x;
        (Vec3::new(x[i], y[i], z[i]), self.w[i])
    }

    #[inline(always)]
    fn put(&mut self, i: usize, at: Vec3) {
        let [x, y, z] = &mut self.x;
        (x[i], y[i], z[i]) = (at.x, at.y, at.z);
    }
}

vectored! {
    fn in_columns(color: Color<'_>, p: &mut Particles, law: u8, scale: f32)
        = by_law_in_columns, Avx2, by_law_apart
}

#[inline(always)]
fn by_law_in_columns<S: Simd>(s: S, color: Color<'_>, p: &mut Particles, law: u8, scale: f32) {
    by_law(s, color, &mut Sheet::new(p), law, scale);
}

vectored! {
    fn in_points(color: Color<'_>, packed: &mut Packed, law: u8, scale: f32)
        = by_law, Avx2, by_law_apart
}

#[inline(always)]
fn by_law<S: Simd, P: Spots>(s: S, color: Color<'_>, spots: &mut P, law: u8, scale: f32) {
    match law {
        SOFT => abreast::<S, P, SOFT>(s, color, spots, scale),
        RIGID => abreast::<S, P, RIGID>(s, color, spots, scale),
        _ => abreast::<S, P, BOUND>(s, color, spots, scale),
    }
}

fn by_law_apart<P: Spots>(color: Color<'_>, spots: &mut P, law: u8, scale: f32) {
    match law {
        SOFT => one_by_one::<SOFT, P>(color, Order::Forward, spots, scale),
        RIGID => one_by_one::<RIGID, P>(color, Order::Forward, spots, scale),
        _ => one_by_one::<BOUND, P>(color, Order::Forward, spots, scale),
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
    (0..whole).step_by(S::LANES).for_each(|at| color.some::<S, P, LAW>(s, at, spots, scale));
    (whole..count).for_each(|at| color.one::<LAW, P>(at, spots, scale));
}

fn one_by_one<const LAW: u8, P: Spots>(
    mut color: Color<'_>,
    order: Order,
    spots: &mut P,
    scale: f32,
) {
    let count = color.a.len();
    let one = |at| color.one::<LAW, P>(at, spots, scale);
    match order {
        Order::Forward => (0..count).for_each(one),
        Order::Backward => (0..count).rev().for_each(one),
    }
}

/// What is known of the ends of some links.
struct Ends {
    x: [Lanes; 3],
    w: Lanes,
}

impl Ends {
    #[inline(always)]
    fn of<S: Simd, P: Spots>(_: S, spots: &P, particles: &[u32]) -> Self {
        let mut ends = Self { x: [[0.0; LANES]; 3], w: [0.0; LANES] };
        let particles = &particles[..S::LANES];
        for lane in 0..S::LANES {
            let (x, w) = spots.spot(particles[lane] as usize);
            (ends.x[0][lane], ends.x[1][lane], ends.x[2][lane]) = (x.x, x.y, x.z);
            ends.w[lane] = w;
        }
        ends
    }
}

impl<'a> Color<'a> {
    fn new(loose: &'a Loose, batch: usize, links: &'a mut Links) -> Self {
        let own = loose.of_batch(batch);
        Self {
            a: &loose.a[own.clone()],
            b: &loose.b[own.clone()],
            rest: &loose.rest[own.clone()],
            link: &loose.link[own],
            compliance: &links.compliance,
            lambda: &mut links.lambda,
        }
    }

    #[inline(always)]
    fn one<const LAW: u8, P: Spots>(&mut self, at: usize, spots: &mut P, scale: f32) {
        let (ends, rest) = ((self.a[at] as usize, self.b[at] as usize), self.rest[at]);
        if LAW == SOFT {
            let link = self.link[at] as usize;
            let (compliance, lambda) = (self.compliance[link], self.lambda[link]);
            self.lambda[link] = pull::<LAW, _>(ends, rest, compliance, lambda, spots, scale);
        } else {
            pull::<LAW, _>(ends, rest, 0.0, 0.0, spots, scale);
        }
    }

    #[inline(always)]
    fn some<S: Simd, P: Spots, const LAW: u8>(
        &mut self,
        s: S,
        first: usize,
        spots: &mut P,
        scale: f32,
    ) {
        let lanes = first..first + S::LANES;
        let (a, b) = (&self.a[lanes.clone()], &self.b[lanes.clone()]);
        let (from, to) = (Ends::of(s, spots, a), Ends::of(s, spots, b));
        let [xa, xb] = [from.x, to.x].map(|x| x.map(|x| s.load(&x, 0)));
        let mut weights = [s.load(&from.w, 0), s.load(&to.w, 0)];
        if LAW == RIGID {
            let mean = (s.splat(0.5) * (weights[0] + weights[1])).max(s.splat(TINY));
            weights = weights.map(|w| w / mean);
        }
        let (mut compliance, mut lambda) = ([0.0; LANES], [0.0; LANES]);
        if LAW == SOFT {
            for (lane, link) in self.link[lanes.clone()].iter().enumerate() {
                compliance[lane] = self.compliance[*link as usize];
                lambda[lane] = self.lambda[*link as usize];
            }
        }
        let span = [xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]];
        let ([to_a, to_b], pulled) = correct::<LAW, _>(
            s,
            span,
            weights,
            s.load(self.rest, first),
            s.load(&compliance, 0),
            s.load(&lambda, 0),
            scale,
        );
        let (mut ya, mut yb) = (from.x, to.x);
        for axis in 0..3 {
            s.store(&mut ya[axis], 0, xa[axis] + span[axis] * to_a);
            s.store(&mut yb[axis], 0, xb[axis] - span[axis] * to_b);
        }
        for (lane, (a, b)) in a.iter().zip(b).enumerate() {
            spots.put(*a as usize, Vec3::new(ya[0][lane], ya[1][lane], ya[2][lane]));
            spots.put(*b as usize, Vec3::new(yb[0][lane], yb[1][lane], yb[2][lane]));
        }
        if LAW == SOFT {
            s.store(&mut lambda, 0, pulled);
            for (link, lambda) in self.link[lanes].iter().zip(lambda) {
                self.lambda[*link as usize] = lambda;
            }
        }
    }
}
