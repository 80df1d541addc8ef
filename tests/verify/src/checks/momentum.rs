//! Momentum budget of a free cloth in vacuum without damping.
//!
//! ```text
//! P₁ = P₀ + M g T − Σ J            J, N: impulse and angular impulse on a collider, about its
//! L₁ = L₀ + c × M g T − Σ (N + p × J)   position p; c: mean centre of mass of the tick
//! ```
//! The residual of the first is given as a change of the mean velocity [m/s], that of the second
//! about the centre of mass as a change of the angular velocity [rad/s].

use crate::play::Play;
use muslin::Cloth;
use muslin::glam::DVec3;

/// Momentum of a cloth at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Momentum {
    mass: f64,
    center: DVec3,
    linear: DVec3,
    /// About the origin.
    angular: DVec3,
    /// Polar moment of inertia about the centre of mass: Σ m |x − c|².
    inertia: f64,
}

/// What a tick changed beyond gravity and the impulses of colliders.
#[derive(Clone, Copy, Debug, Default)]
pub struct Residual {
    /// Change of the mean velocity [m/s].
    pub velocity: DVec3,
    /// Change of the angular velocity about the centre of mass [rad/s].
    pub spin: DVec3,
    /// Change of the mean velocity by the impulses of colliders, the sum of all lengths [m/s].
    pub push: f64,
}

impl Momentum {
    pub fn of(cloth: &Cloth) -> Self {
        let particles = || {
            (0..cloth.particle_count()).filter_map(|i| {
                let (mass, x, v) = (cloth.mass(i)?, cloth.position(i)?, cloth.velocity(i)?);
                Some((f64::from(mass), x.as_dvec3(), v.as_dvec3()))
            })
        };
        let mass: f64 = particles().map(|(mass, ..)| mass).sum();
        let center = particles().map(|(mass, x, _)| x * mass).sum::<DVec3>() / mass;
        Self {
            mass,
            center,
            linear: particles().map(|(mass, _, v)| v * mass).sum(),
            angular: particles().map(|(mass, x, v)| x.cross(v) * mass).sum(),
            inertia: particles().map(|(mass, x, _)| mass * x.distance_squared(center)).sum(),
        }
    }

    /// What the tick from `self` to now changed beyond gravity and the impulses of colliders.
    pub fn residual(&self, play: &Play) -> Residual {
        let now = Self::of(&play.cloth);
        let settings = play.cloth.settings();
        let weight = settings.gravity.as_dvec3() * (self.mass * f64::from(settings.tick));
        let mut linear = now.linear - self.linear - weight;
        let mut angular = now.angular - self.angular;
        let mut pushes = 0.0;
        angular -= (self.center + now.center).cross(weight) * 0.5;
        for body in &play.bodies {
            let Ok(impulse) = play.cloth.collider_impulse(body.collider) else { continue };
            let (push, turn) = (impulse.linear.as_dvec3(), impulse.angular.as_dvec3());
            let position = body.desc.position.as_dvec3();
            linear += push;
            angular += turn + position.cross(push);
            pushes += push.length();
        }
        // A residual of the linear momentum acts somewhere; about the centre it does not turn.
        let spin = angular - now.center.cross(linear);
        Residual {
            velocity: linear / self.mass,
            spin: spin / now.inertia,
            push: pushes / self.mass,
        }
    }
}
