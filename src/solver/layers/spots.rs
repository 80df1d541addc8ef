//! Particles one after the other, x, y, z and inverse mass of each together: what pairs of anything want.

use super::four::Four;
use crate::math::columns::Columns;
use glam::Vec3;

/// Where a particle is, and its inverse mass.
pub(super) type Spot = [f32; 4];

/// Where it is.
#[inline(always)]
pub(super) fn place(spot: &Spot) -> Vec3 {
    Vec3::new(spot[0], spot[1], spot[2])
}

/// Moves a particle.
#[inline(always)]
pub(super) fn shift(spot: &mut Spot, by: Vec3) {
    spot[0] += by.x;
    spot[1] += by.y;
    spot[2] += by.z;
}

/// Moves a particle, and leaves its mass.
#[inline(always)]
pub(super) fn push(spot: &mut Spot, by: Four) {
    (Four::of(spot) + by.ways()).put(spot);
}

/// Makes it the list of these particles.
pub(super) fn gather(spots: &mut Vec<Spot>, x: &Columns, w: &[f32]) {
    let [x, y, z] = x.all();
    spots.clear();
    let all = x.iter().zip(y).zip(z).zip(w);
    spots.extend(all.map(|(((x, y), z), w)| [*x, *y, *z, *w]));
}

/// Puts particles back.
pub(super) fn scatter(spots: &[Spot], x: &mut Columns) {
    let [x, y, z] = x.all_mut();
    for (((x, y), z), spot) in x.iter_mut().zip(y).zip(z).zip(spots) {
        [*x, *y, *z] = [spot[0], spot[1], spot[2]];
    }
}

/// How all moved from one state to another, in the mean.
pub(super) fn drift(from: &[Spot], to: &[Spot]) -> Vec3 {
    let mut sums = [[0.0_f32; 4]; 4];
    let (from4, to4) = (from.chunks_exact(4), to.chunks_exact(4));
    let rest = from4.remainder().iter().zip(to4.remainder());
    for (from, to) in from4.zip(to4) {
        for k in 0..4 {
            for c in 0..4 {
                sums[k][c] += to[k][c] - from[k][c];
            }
        }
    }
    let rest = rest.fold(Vec3::ZERO, |sum, (from, to)| sum + (place(to) - place(from)));
    let all = sums.iter().fold(rest, |sum, part| sum + place(part));
    all * (1.0 / from.len() as f32)
}

/// Whether any is held.
pub(super) fn is_any_held(spots: &[Spot]) -> bool {
    spots.iter().any(|spot| spot[3] <= 0.0)
}

/// The middle of all mass, of places and inverse masses.
pub(super) fn middle(spots: impl Iterator<Item = (Vec3, f32)>) -> Vec3 {
    let (mut sum, mut all) = ([0.0_f64; 3], 0.0_f64);
    for (x, w) in spots {
        let mass = 1.0 / f64::from(w);
        all += mass;
        for (sum, x) in sum.iter_mut().zip(x.to_array()) {
            *sum += mass * f64::from(x);
        }
    }
    Vec3::from_array(sum.map(|sum| (sum / all) as f32))
}
