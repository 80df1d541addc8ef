//! Statistics of the current state: stretch, largest speed and kinetic energy.
//!
//! Method: plain reductions in index order; sums use f64.
//!
//! Reads links and particles; writes nothing.
//! Invariant: the order of the sums is fixed, so the bits are the same on every platform.

use crate::math::max;
use crate::model::links::LinkKind;
use crate::solver::world::World;

/// Largest and mean strain of the active stretch links: 0.01 is 1 % longer than at rest.
pub(crate) fn stretch(world: &World) -> (f32, f32) {
    let x = &world.particles.x;
    let (mut largest, mut sum, mut count) = (0.0_f32, 0.0_f64, 0_u32);
    for links in [&world.constraints.links, &world.constraints.dynamic] {
        for link in 0..links.len() {
            if links.active[link] && links.kind(link) == LinkKind::Stretch {
                let span = x.get(links.b[link] as usize) - x.get(links.a[link] as usize);
                let stretch = span.length() / links.rest[link] - 1.0;
                largest = if stretch > largest { stretch } else { largest };
                sum += f64::from(stretch);
                count += 1;
            }
        }
    }
    (largest, if count == 0 { 0.0 } else { (sum / f64::from(count)) as f32 })
}

/// Speed of the fastest particle [m/s].
pub(crate) fn max_speed(world: &World) -> f32 {
    world.particles.v.iter().fold(0.0, |most, v| max(most, v.length_squared())).sqrt()
}

/// Kinetic energy [J].
pub(crate) fn kinetic_energy(world: &World) -> f32 {
    let p = &world.particles;
    let of = |i: usize| 0.5 * f64::from(p.mass[i]) * f64::from(p.v.get(i).length_squared());
    (0..p.len()).map(of).sum::<f64>() as f32
}
