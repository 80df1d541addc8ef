//! Stage `Forces`: gravity and aerodynamics, as an acceleration of each particle.
//!
//! ```text
//!        n ▲   ▲ lift          u: mean velocity of the air relative to the triangle
//!          │  ╱                drag pressure  p = ½ ρ C_d |u·n| (u·n), along n
//!   ───────┼─╱───── triangle   lift pressure  p = ½ ρ C_l sin α cos α |u|², across u
//!        ╱                     α: angle between u and the triangle
//!      u
//! ```
//! Method: a quadratic pressure per triangle as in flat-plate aerodynamics, shared among its
//! corners by their rest areas. It is explicit in time. It runs once per tick; in wind so strong
//! that drag would remove more than a tenth of its speed in a tick, it runs more often, at most once
//! per substep. The pressure is clamped to the range where explicit drag is stable.
//!
//! Reads positions, velocities, masses, wind, material and maps; writes `scratch.acceleration` and
//! `scratch.relative_wind`.
//! Invariant: forces add up in triangle order, so the bits do not depend on threads or SIMD level.

use crate::math::columns::Columns;
use crate::math::simd::{Float, Level, Scalar, Simd, leveled, vectored};
use crate::math::{TINY, max};
use crate::model::maps::{Map, mean};
use crate::solver::vertex_sums::contribution::{
    LaneVector, RowBand, SumInput, TriangleContribution,
};
use crate::solver::vertex_sums::triangles::{self, sum_in_bands};
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::wind::{WindModel, WindSample};
use glam::Vec3;

/// Largest share of a triangle's relative speed that drag may remove before it is evaluated again.
/// Explicit drag is stable up to 1 and does not oscillate up to this value.
const MAX_DRAG_SHARE: f32 = 0.5;

/// Share of the speed of the wind that drag may remove from cloth at rest before it is evaluated
/// again: with more, a sheet that the wind tightens vibrates.
const REGULAR_DRAG_SHARE: f32 = 0.1;

/// Smallest number of particles that a thread gets when it evaluates the turbulent wind.
const MIN_WIND_PARTICLES_PER_THREAD: usize = 2048;

/// Fills `scratch.acceleration` [m/s²] with gravity and the force of the air over mass, at the
/// start of substep `number`; does nothing where the values of an earlier substep still hold.
pub(crate) fn compute_acceleration(world: &mut World, number: u32) {
    let gravity = world.settings.gravity;
    if world.wind.model == WindModel::Surface && has_aerodynamics(world) {
        let interval = held_substeps(world);
        if number.is_multiple_of(interval) {
            add_surface_wind(world, gravity, number, interval);
        }
    } else if number == 0 {
        if world.wind.model == WindModel::SineField && world.wind.velocity != Vec3::ZERO {
            add_sine_wind(world, gravity);
        } else {
            world.scratch.acceleration.fill(gravity);
        }
    }
}

fn has_aerodynamics(world: &World) -> bool {
    let material = &world.material;
    world.wind.air_density > 0.0 && (material.drag > 0.0 || material.lift > 0.0)
}

/// Number of substeps for which the force of the air is kept.
fn held_substeps(world: &World) -> u32 {
    let [_, most] = world.maps.range(Map::Drag);
    let coefficient = max(world.material.drag * most, world.material.lift);
    let flux = 0.5 * world.wind.air_density * coefficient * world.wind.greatest_speed();
    let share = flux * world.settings.tick / (REGULAR_DRAG_SHARE * world.material.density);
    // The conversion saturates; NaN becomes 0.
    ((world.substeps as f32 / max(share, 1.0)) as u32).clamp(1, world.substeps)
}

/// Largest pressure of the wind on cloth at rest [Pa].
pub(crate) fn greatest_wind_pressure(world: &World) -> f32 {
    if world.wind.model != WindModel::Surface {
        return 0.0;
    }
    let [_, most] = world.maps.range(Map::Drag);
    let coefficient = world.material.drag * most + world.material.lift;
    let speed = world.wind.greatest_speed();
    0.5 * world.wind.air_density * coefficient * speed * speed
}

/// Adds a field of sine waves as an acceleration, whatever the orientation of the cloth.
fn add_sine_wind(world: &mut World, gravity: Vec3) {
    for i in 0..world.particles.len() {
        let wind = world.wind.sine_field(world.clock.time, world.origin, world.particles.x.get(i));
        world.scratch.acceleration.set(i, gravity + wind);
    }
}

/// Adds the pressure of the air on each triangle.
fn add_surface_wind(world: &mut World, gravity: Vec3, number: u32, interval: u32) {
    let (level, threads, p) = (world.level, world.threads, &world.particles);
    let step = world.settings.tick / world.substeps as f32;
    let wind = world.wind.sample(world.clock.time + f64::from(number as f32 * step), world.origin);
    let particles = (p.x.slices(), p.v.slices(), world.scratch.relative_wind.slices_mut());
    threads.parallel_for(particles, MIN_WIND_PARTICLES_PER_THREAD, |(x, v, air)| {
        compute_relative_wind(level, &wind, x, v, air);
    });
    let half_density = 0.5 * world.wind.air_density;
    let pressure = Pressure {
        drag: half_density * world.material.drag,
        lift: half_density * world.material.lift,
        max_mass_flux: MAX_DRAG_SHARE * world.material.density / (interval as f32 * step),
    };
    let input = SumInput {
        triangles: &world.mesh.triangles,
        areas: &world.corner_area,
        cells: world.grid_cells.as_ref(),
        x: &p.x,
        attribute: &world.scratch.relative_wind,
    };
    let force = &mut world.scratch.acceleration;
    force.fill(Vec3::ZERO);
    match world.maps.get(Map::Drag) {
        Some(scales) => sum_painted(input, pressure, scales, force),
        None => sum_in_bands(threads, input, force, |band, force| {
            sum_pressure(level, input, pressure, band, force);
        }),
    }
    threads.parallel_for(
        (force.slices_mut(), &p.mass[..]),
        MIN_PARTICLES_PER_THREAD,
        |(force, mass)| {
            for (force, gravity) in force.into_iter().zip(gravity.to_array()) {
                apply_mass_and_gravity(level, force, mass, gravity);
            }
        },
    );
}

/// Computes the velocity of the air relative to each particle [m/s].
fn compute_relative_wind(
    level: Level,
    wind: &WindSample,
    x: [&[f32]; 3],
    v: [&[f32]; 3],
    air: [&mut [f32]; 3],
) {
    for (axis, air) in air.into_iter().enumerate() {
        subtract_velocity(level, wind.mean[axis], v[axis], air);
        if wind.is_turbulent() {
            add_turbulence(level, wind, axis, x[(axis + 1) % 3], x[(axis + 2) % 3], air);
        }
    }
}

leveled! {
    fn subtract_velocity(mean: f32, v: &[f32], air: &mut [f32]) = subtract_velocity_lanes
}

#[inline(always)]
fn subtract_velocity_lanes(mean: f32, v: &[f32], air: &mut [f32]) {
    for (air, v) in air.iter_mut().zip(v) {
        *air = mean - v;
    }
}

leveled! {
    /// Adds the turbulence along an axis, from the positions along the other two.
    fn add_turbulence(
        wind: &WindSample, axis: usize, next: &[f32], last: &[f32], air: &mut [f32],
    ) = add_turbulence_lanes
}

#[inline(always)]
fn add_turbulence_lanes(
    wind: &WindSample,
    axis: usize,
    next: &[f32],
    last: &[f32],
    air: &mut [f32],
) {
    for ((next, last), air) in next.iter().zip(last).zip(air) {
        *air += wind.turbulence_along(axis, *next, *last);
    }
}

vectored! {
    /// Adds the drag and the lift of each triangle to its corners.
    fn sum_pressure(
        input: SumInput<'_>,
        pressure: Pressure,
        band: RowBand,
        force: [&mut [f32]; 3],
    ) = triangles::sum, triangles::sum_scalar
}

/// Adds the drag, times the mean painted scale of the corners, and the lift of each triangle to its
/// corners.
#[inline(never)]
fn sum_painted(input: SumInput<'_>, pressure: Pressure, scales: &[f32], out: &mut Columns) {
    for (corners, areas) in input.triangles.iter().zip(input.areas) {
        let of = |columns: &Columns| corners.map(|i| columns.get(i as usize).to_array());
        let painted = Pressure { drag: pressure.drag * mean(scales, corners), ..pressure };
        let [a, b, c] = *areas;
        let (x, air) = (of(input.x), of(input.attribute));
        let force = painted.force_on(Scalar, x, air, a + b + c);
        for (i, area) in corners.iter().zip(areas) {
            out.add(*i as usize, Vec3::from(force) * *area);
        }
    }
}

leveled! {
    /// Divides force by mass and adds gravity.
    fn apply_mass_and_gravity(force: &mut [f32], mass: &[f32], gravity: f32)
        = apply_mass_and_gravity_column
}

#[inline(always)]
fn apply_mass_and_gravity_column(force: &mut [f32], mass: &[f32], gravity: f32) {
    for (force, mass) in force.iter_mut().zip(mass) {
        *force = *force / max(*mass, 1.0e-12) + gravity;
    }
}

/// Parameters of the air's force on a triangle per rest area [N/m²].
#[derive(Clone, Copy)]
struct Pressure {
    /// ½ ρ C_d [kg/m³].
    drag: f32,
    /// ½ ρ C_l [kg/m³].
    lift: f32,
    /// Largest mass of air that may act on a unit of area per second [kg/m²/s].
    max_mass_flux: f32,
}

impl Pressure {
    /// Force on a triangle with corners `a`, `b`, `c` and relative wind `air` at these corners.
    #[inline(always)]
    fn force_on<S: Simd>(
        self,
        s: S,
        [a, b, c]: [LaneVector<S>; 3],
        air: [LaneVector<S>; 3],
        rest_area: S::F,
    ) -> LaneVector<S> {
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
        // The pressure acts on the current area; the corners get shares by rest area, like mass.
        let stretch = Float::min(s.splat(0.5) * double_area / rest_area.max(tiny), s.splat(4.0));
        let max_mass_flux = s.splat(self.max_mass_flux);
        let push = Float::min(s.splat(self.drag) * head_on, max_mass_flux) * facing * stretch;
        let mut force = [nx * push, ny * push, nz * push];
        if self.lift > 0.0 {
            let speed2 = ux * ux + uy * uy + uz * uz;
            let sign = s.select(zero - facing, s.splat(-1.0), s.splat(1.0));
            let rate = Float::min(s.splat(self.lift) * head_on, max_mass_flux) * sign * stretch;
            let share = rate / speed2.sqrt().max(tiny);
            force[0] = force[0] + (nx * speed2 - ux * facing) * share;
            force[1] = force[1] + (ny * speed2 - uy * facing) * share;
            force[2] = force[2] + (nz * speed2 - uz * facing) * share;
        }
        force
    }
}

impl TriangleContribution for Pressure {
    const WEIGHTED_BY_AREA: bool = true;

    #[inline(always)]
    fn evaluate<S: Simd>(
        self,
        s: S,
        x: [LaneVector<S>; 3],
        air: [LaneVector<S>; 3],
        rest_area: S::F,
    ) -> LaneVector<S> {
        self.force_on(s, x, air, rest_area)
    }
}
