//! Public call for the mass of the whole cloth, its center and its momentum.
//!
//! Reads particles; writes nothing. Invariant: sums are in f64 and in the order of particles.

use crate::cloth::Cloth;
use crate::math::float_env::with_float_env;
use crate::math::saturate;
use glam::{DVec3, Vec3};

/// Mass, center of mass and momentum of a whole cloth, pinned particles included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassProperties {
    /// Sum of the masses of all particles [kg].
    pub total: f32,
    /// Center of mass [m].
    pub center: Vec3,
    /// Sum of mass times velocity of all particles [kg m/s].
    pub momentum: Vec3,
}

impl Cloth {
    /// Returns mass, center of mass and momentum of the whole cloth. Computed on each call, in one
    /// pass over the particles.
    pub fn mass_properties(&self) -> MassProperties {
        with_float_env(|| {
            let p = &self.world.particles;
            let (mut total, mut moment, mut momentum) = (0.0, DVec3::ZERO, DVec3::ZERO);
            for (at, mass) in p.mass.iter().enumerate() {
                let mass = f64::from(*mass);
                total += mass;
                moment += p.x.get(at).as_dvec3() * mass;
                momentum += p.v.get(at).as_dvec3() * mass;
            }
            let center = self.world.origin.as_dvec3() + moment / total;
            MassProperties {
                total: total as f32,
                center: saturate(center.as_vec3()),
                momentum: saturate(momentum.as_vec3()),
            }
        })
    }
}
