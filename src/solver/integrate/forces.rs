//! Stage `Forces`: gravity and the air, as an acceleration of each particle.
//!
//! The air pushes each triangle along its normal by the square of the relative speed,
//! p = ½ ρ C |u·n| (u·n), and across the wind by ½ ρ C_L sin α cos α |u|². Gathered once a tick.

use crate::solver::vertex_sums::triangles;

use crate::math::simd::{Float, Simd, leveled, vectored};
use crate::math::{TINY, max};
use crate::solver::vertex_sums::triangles::{Band, Give, Surface, V, in_bands};
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::wind::{Breeze, WindModel};
use glam::Vec3;

/// The largest share of a triangle's relative speed that the air may take in one tick: explicit
/// drag is stable up to one, and without ringing up to this.
const MAX_BRAKE: f32 = 0.5;

/// Particles in the wind that one thread does at least.
const SWIRLS: usize = 2048;

/// Fills `scratch.acceleration`.
pub(crate) fn gather(world: &mut World) {
    let gravity = world.settings.gravity;
    match world.wind.model {
        WindModel::Surface if feels_air(world) => push_surfaces(world, gravity),
        WindModel::SineField if world.wind.velocity != Vec3::ZERO => push_particles(world, gravity),
        _ => world.scratch.acceleration.fill(gravity),
    }
}

fn feels_air(world: &World) -> bool {
    let material = &world.material;
    world.wind.air_density > 0.0 && (material.drag > 0.0 || material.lift > 0.0)
}

fn push_particles(world: &mut World, gravity: Vec3) {
    for i in 0..world.particles.len() {
        let push = world.wind.sine_field(world.time, world.particles.x.at(i));
        world.scratch.acceleration.set(i, gravity + push);
    }
}

fn push_surfaces(world: &mut World, gravity: Vec3) {
    let (level, threads, p) = (world.level, world.threads, &world.particles);
    let breeze = world.wind.at(world.time);
    let particles = (p.x.all(), p.v.all(), world.scratch.relative_wind.all_mut());
    threads.parallel_for(particles, SWIRLS, |(x, v, air)| face_air(level, &breeze, x, v, air));
    let half_density = 0.5 * world.wind.air_density;
    let pressure = Pressure {
        drag: half_density * world.material.drag,
        lift: half_density * world.material.lift,
        most: MAX_BRAKE * world.material.density / world.settings.tick,
    };
    let surface = Surface {
        triangles: &world.mesh.triangles,
        areas: &world.corner_area,
        cells: world.grid_cells.as_ref(),
        x: &p.x,
        air: &world.scratch.relative_wind,
    };
    let force = &mut world.scratch.acceleration;
    force.fill(Vec3::ZERO);
    in_bands(threads, surface, force, |band, force| {
        if pressure.lift > 0.0 {
            push_and_lift(level, surface, WithLift(pressure), band, force);
        } else {
            push(level, surface, pressure, band, force);
        }
    });
    threads.parallel_for(
        (force.all_mut(), &p.mass[..]),
        MIN_PARTICLES_PER_THREAD,
        |(force, mass)| {
            for (force, gravity) in force.into_iter().zip(gravity.to_array()) {
                accelerate(level, force, mass, gravity);
            }
        },
    );
}

leveled! {
    /// The air's velocity against each particle.
    fn face_air(breeze: &Breeze, x: [&[f32]; 3], v: [&[f32]; 3], air: [&mut [f32]; 3])
        = face_air_lanes
}

#[inline(always)]
fn face_air_lanes(breeze: &Breeze, x: [&[f32]; 3], v: [&[f32]; 3], mut air: [&mut [f32]; 3]) {
    for ((air, mean), v) in air.iter_mut().zip(breeze.mean.to_array()).zip(v) {
        for (air, v) in air.iter_mut().zip(v) {
            *air = mean - v;
        }
    }
    if breeze.swirls() {
        let ([x, y, z], [ax, ay, az]) = (x, air);
        let particles = x.iter().zip(y).zip(z);
        let air = ax.iter_mut().zip(ay).zip(az);
        for (((x, y), z), ((ax, ay), az)) in particles.zip(air) {
            let [sx, sy, sz] = breeze.swirl_at(*x, *y, *z);
            *ax += sx;
            *ay += sy;
            *az += sz;
        }
    }
}

vectored! {
    fn push(surface: Surface<'_>, pressure: Pressure, band: Band, force: [&mut [f32]; 3])
        = triangles::sum, Avx2, triangles::sum_apart
}

vectored! {
    fn push_and_lift(surface: Surface<'_>, pressure: WithLift, band: Band, force: [&mut [f32]; 3])
        = triangles::sum, Avx2, triangles::sum_apart
}

leveled! {
    /// From force to acceleration.
    fn accelerate(force: &mut [f32], mass: &[f32], gravity: f32) = accelerate_column
}

#[inline(always)]
fn accelerate_column(force: &mut [f32], mass: &[f32], gravity: f32) {
    for (force, mass) in force.iter_mut().zip(mass) {
        *force = *force / max(*mass, 1.0e-12) + gravity;
    }
}

/// The air's force on a triangle over its area at rest [N/m²].
#[derive(Clone, Copy)]
struct Pressure {
    /// ½ ρ C [kg/m³].
    drag: f32,
    /// ½ ρ C_L [kg/m³].
    lift: f32,
    /// The most mass of air that may meet an area in a second [kg/m²/s].
    most: f32,
}

impl Pressure {
    #[inline(always)]
    fn on<S: Simd, const LIFT: bool>(
        self,
        s: S,
        [a, b, c]: [V<S>; 3],
        air: [V<S>; 3],
        rest_area: S::F,
    ) -> V<S> {
        let (zero, tiny) = (s.splat(0.0), s.splat(TINY));
        let [ua, ub, uc] = air;
        let third = s.splat(1.0 / 3.0);
        let ux = (ua[0] + ub[0] + uc[0]) * third;
        let uy = (ua[1] + ub[1] + uc[1]) * third;
        let uz = (ua[2] + ub[2] + uc[2]) * third;
        let (px, py, pz) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        let (qx, qy, qz) = (c[0] - a[0], c[1] - a[1], c[2] - a[2]);
        let (nx, ny, nz) = (py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx);
        let double_area = (nx * nx + ny * ny + nz * nz).sqrt();
        let inverse = s.splat(1.0) / double_area.max(tiny);
        let (nx, ny, nz) = (nx * inverse, ny * inverse, nz * inverse);
        let facing = ux * nx + uy * ny + uz * nz;
        let head_on = s.select(facing, facing, zero - facing);
        // The pressure acts on the triangle as it is now, shared out as its mass is.
        let stretch = Float::min(s.splat(0.5) * double_area / rest_area.max(tiny), s.splat(4.0));
        let most = s.splat(self.most);
        let push = Float::min(s.splat(self.drag) * head_on, most) * facing * stretch;
        let mut force = [nx * push, ny * push, nz * push];
        if LIFT {
            let speed2 = ux * ux + uy * uy + uz * uz;
            let sign = s.select(zero - facing, s.splat(-1.0), s.splat(1.0));
            let rate = Float::min(s.splat(self.lift) * head_on, most) * sign * stretch;
            let share = rate / speed2.sqrt().max(tiny);
            force[0] = force[0] + (nx * speed2 - ux * facing) * share;
            force[1] = force[1] + (ny * speed2 - uy * facing) * share;
            force[2] = force[2] + (nz * speed2 - uz * facing) * share;
        }
        force
    }
}

impl Give for Pressure {
    const BY_AREA: bool = true;

    #[inline(always)]
    fn give<S: Simd>(self, s: S, x: [V<S>; 3], air: [V<S>; 3], rest_area: S::F) -> V<S> {
        self.on::<S, false>(s, x, air, rest_area)
    }
}

/// Pressure that lifts too.
#[derive(Clone, Copy)]
struct WithLift(Pressure);

impl Give for WithLift {
    const BY_AREA: bool = true;

    #[inline(always)]
    fn give<S: Simd>(self, s: S, x: [V<S>; 3], air: [V<S>; 3], rest_area: S::F) -> V<S> {
        self.0.on::<S, true>(s, x, air, rest_area)
    }
}
