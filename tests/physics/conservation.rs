//! Momentum and energy of free and hanging cloth: only forces change them.
//!
//! Most cases come from public bug reports about cloth libraries. The thresholds are the right
//! values of these reports, not what the solver happens to reach.

use muslin::glam::{DMat3, DVec3, Vec3};
use muslin::{Cloth, GridDesc, MeshDesc, PinMode, Settings, Wind};

/// Sum of m · v [kg m/s] over the total mass [kg], in f64.
fn mean_velocity(cloth: &Cloth) -> Vec3 {
    weighted_mean(cloth, |i| cloth.velocity(i).unwrap())
}

/// Centre of mass [m].
fn centroid(cloth: &Cloth) -> Vec3 {
    weighted_mean(cloth, |i| cloth.position(i).unwrap())
}

fn weighted_mean(cloth: &Cloth, value: impl Fn(u32) -> Vec3) -> Vec3 {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for i in 0..cloth.particle_count() {
        let mass = f64::from(cloth.mass(i).unwrap());
        sum += value(i).as_dvec3() * mass;
        total += mass;
    }
    (sum / total).as_vec3()
}

/// Angular momentum about the centre of mass [kg m²/s], in f64.
fn spin(cloth: &Cloth) -> Vec3 {
    let (center, drift) = (centroid(cloth).as_dvec3(), mean_velocity(cloth).as_dvec3());
    let all = (0..cloth.particle_count()).map(|i| {
        let r = cloth.position(i).unwrap().as_dvec3() - center;
        let v = cloth.velocity(i).unwrap().as_dvec3() - drift;
        r.cross(v) * f64::from(cloth.mass(i).unwrap())
    });
    all.sum::<DVec3>().as_vec3()
}

/// Angular velocity of the rigid motion with the same angular momentum [rad/s].
fn angular_velocity(cloth: &Cloth) -> Vec3 {
    let center = centroid(cloth).as_dvec3();
    let all = (0..cloth.particle_count()).map(|i| {
        let r = cloth.position(i).unwrap().as_dvec3() - center;
        let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
        (DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer)
            * f64::from(cloth.mass(i).unwrap())
    });
    let inertia = all.fold(DMat3::ZERO, |sum, one| sum + one);
    (inertia.inverse() * spin(cloth).as_dvec3()).as_vec3()
}

/// Kinetic energy [J].
fn kinetic_energy(cloth: &Cloth) -> f64 {
    let all = (0..cloth.particle_count()).map(|i| {
        let speed2 = f64::from(cloth.velocity(i).unwrap().length_squared());
        0.5 * f64::from(cloth.mass(i).unwrap()) * speed2
    });
    all.sum()
}

fn max_speed(cloth: &Cloth) -> f32 {
    (0..cloth.particle_count()).map(|i| cloth.velocity(i).unwrap().length()).fold(0.0, f32::max)
}

fn in_vacuum(mut cloth: Cloth) -> Cloth {
    cloth.set_wind(Wind { air_density: 0.0, ..Wind::default() }).unwrap();
    cloth
}

/// A free grid without damping and air.
fn free_grid(columns: u32, rows: u32) -> GridDesc {
    let mut desc = GridDesc { columns, rows, pin_mode: PinMode::None, ..GridDesc::default() };
    desc.settings.damping = 0.0;
    desc
}

/// Numbers from 0 to 1 that look random and are always the same.
fn random(seed: u32) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    }
}

#[test]
fn a_sheet_on_one_pin_comes_to_rest() {
    for (iterations, tethers, limit) in [(2, true, 1.0e-3), (2, false, 1.0e-3), (1, true, 2.0e-3)] {
        let mut desc =
            GridDesc { columns: 20, rows: 20, pin_mode: PinMode::None, ..GridDesc::default() };
        desc.settings.iterations = iterations;
        desc.settings.tethers = tethers;
        let mut cloth = Cloth::grid(&desc).unwrap();
        cloth.pin(0, None).unwrap();
        cloth.set_velocity(399, Vec3::new(0.0, 0.0, 0.1)).unwrap();
        cloth.step(2400);
        let speed = (0..60).fold(0.0, |most: f32, _| {
            cloth.step(1);
            most.max(max_speed(&cloth))
        });
        assert!(speed < limit, "{iterations} iterations, tethers {tethers}: {speed} m/s");
    }
}

/// A closed ellipsoid of 24 × 8 × 24 cm: rings of triangles between two poles.
fn ellipsoid() -> MeshDesc {
    let (rings, around) = (12_u32, 24_u32);
    let mut positions = vec![Vec3::new(0.0, 0.04, 0.0)];
    for ring in 1..rings {
        let theta = std::f32::consts::PI * ring as f32 / rings as f32;
        for k in 0..around {
            let phi = std::f32::consts::TAU * k as f32 / around as f32;
            let (out, up) = (0.12 * theta.sin(), 0.04 * theta.cos());
            positions.push(Vec3::new(out * phi.cos(), up, out * phi.sin()));
        }
    }
    let last = positions.len() as u32;
    positions.push(Vec3::new(0.0, -0.04, 0.0));
    let at = |ring: u32, k: u32| 1 + (ring - 1) * around + k % around;
    let mut indices = Vec::new();
    for k in 0..around {
        indices.extend([0, at(1, k + 1), at(1, k)]);
        indices.extend([last, at(rings - 1, k), at(rings - 1, k + 1)]);
        for ring in 1..rings - 1 {
            indices.extend([at(ring, k), at(ring, k + 1), at(ring + 1, k)]);
            indices.extend([at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)]);
        }
    }
    MeshDesc { positions, indices, ..MeshDesc::default() }
}

#[test]
fn a_stiff_shell_does_not_drive_itself() {
    for bend_stiffness in [2.5e-5, 1.0e-3, 1.0e-2, 1.0e-1] {
        let mut desc = ellipsoid();
        desc.settings.gravity = Vec3::ZERO;
        desc.settings.damping = 0.0;
        desc.material.bend_stiffness = bend_stiffness;
        let mut cloth = in_vacuum(Cloth::mesh(&desc).unwrap());
        let before = centroid(&cloth);
        for tick in 0..60 {
            cloth.step(1);
            let (moved, speed) =
                (centroid(&cloth).distance(before), mean_velocity(&cloth).length());
            let case = format!("{bend_stiffness} N m, tick {tick}");
            assert!(moved < 1.0e-6, "{case}: the centroid moved {moved} m");
            assert!(speed < 1.0e-6, "{case}: the centroid moves at {speed} m/s");
            let turn = angular_velocity(&cloth).length();
            let is_still = bend_stiffness > 1.0e-2 || turn < 1.0e-3;
            assert!(is_still, "{case}: the shell turns at {turn} rad/s");
        }
    }
}

#[test]
fn switching_between_two_tick_lengths_is_stable() {
    for (side, substeps, tethers) in [(8, 4, true), (8, 16, true), (8, 4, false), (20, 4, true)] {
        let mut desc = GridDesc { columns: side, rows: side, ..GridDesc::default() };
        desc.settings.substeps = substeps;
        desc.settings.tethers = tethers;
        let mut cloth = Cloth::grid(&desc).unwrap();
        cloth.step(120);
        let mut before = max_speed(&cloth);
        for frame in 0..240 {
            let tick = if frame % 2 == 0 { 1.0 / 60.0 } else { 1.0 / 600.0 };
            cloth.set_settings(Settings { tick, ..cloth.settings().clone() }).unwrap();
            cloth.step(1);
            let after = max_speed(&cloth);
            assert!(
                after < before + 9.81 * tick + 1.0e-4,
                "{side} x {side}, {substeps} substeps, tethers {tethers}: {before} to {after} m/s in \
                 frame {frame}"
            );
            before = after;
        }
    }
}

#[test]
fn random_tick_lengths_keep_a_hanging_sheet_calm_and_a_falling_one_on_its_parabola() {
    let mut next = random(4);
    let mut tick = move || 0.02_f32.powf(next()) / 30.0;
    let mut hung = Cloth::grid(&GridDesc { columns: 20, rows: 20, ..GridDesc::default() }).unwrap();
    let mut falling = in_vacuum(Cloth::grid(&free_grid(8, 8)).unwrap());
    let start = centroid(&falling);
    let mut time = 0.0_f64;
    while time < 1.0 {
        let tick = tick();
        for cloth in [&mut hung, &mut falling] {
            cloth.set_settings(Settings { tick, ..cloth.settings().clone() }).unwrap();
            cloth.step(1);
        }
        time += f64::from(tick);
        assert!(max_speed(&hung) < 0.35, "the hanging sheet moves at {} m/s", max_speed(&hung));
    }
    let speed = f64::from(mean_velocity(&falling).y);
    assert!((speed + 9.81 * time).abs() < 0.005, "{speed} m/s after {time} s");
    let fall = f64::from(centroid(&falling).y - start.y);
    assert!((fall + 4.905 * time * time).abs() < 0.02, "fell {fall} m in {time} s");
}

#[test]
fn small_ticks_make_no_momentum() {
    for tick in [1.0e-3, 1.0e-4, 1.0e-5, 1.0e-6, 1.0e-8] {
        for (n, origin) in [(2, Vec3::ZERO), (2, Vec3::splat(3.0)), (12, Vec3::ZERO)] {
            let mut desc = free_grid(n, n);
            desc.origin = origin;
            desc.settings.tick = tick;
            let mut cloth = in_vacuum(Cloth::grid(&desc).unwrap());
            cloth.step(1000);
            let (mean, right) = (mean_velocity(&cloth), Vec3::new(0.0, -9810.0 * tick, 0.0));
            let error = (mean - right).length();
            assert!(error < 3.0e-4 * right.length().max(0.1), "tick {tick}, {n}²: {mean}");
            let internal = max_speed(&cloth) - right.length();
            assert!(internal < 0.01, "tick {tick}, {n}²: {internal} m/s beside the fall");
        }
    }
}

#[test]
fn an_irregular_mesh_falls_straight_down_in_vacuum() {
    let (columns, rows) = (31_u32, 31_u32);
    let mut next = random(12_345);
    let mut jitter = move || 0.5 * (next() - 0.5);
    let mut positions = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let (x, z) = (column as f32 + jitter(), row as f32 + jitter());
            positions.push(Vec3::new(x, 0.0, z) * 0.03);
        }
    }
    let mut indices = Vec::new();
    for row in 0..rows - 1 {
        for i in row * columns..(row + 1) * columns - 1 {
            indices.extend([i, i + columns, i + 1, i + 1, i + columns, i + columns + 1]);
        }
    }
    let mut desc = MeshDesc { positions, indices, ..MeshDesc::default() };
    desc.settings.damping = 0.0;
    desc.material.stretch_stiffness_warp = 1.0e4;
    desc.material.stretch_stiffness_weft = 1.0e4;
    desc.material.stretch_damping = 1.0;
    let mut cloth = in_vacuum(Cloth::mesh(&desc).unwrap());
    let before = centroid(&cloth);
    cloth.step(60);
    let moved = centroid(&cloth) - before;
    assert!(moved.x.hypot(moved.z) < 1.0e-5, "drifted by {moved}");
}

/// Random free scenes: a grid or a mesh of a random fabric, with random velocities of particles.
#[test]
fn free_cloth_keeps_its_momentum_and_gains_no_energy() {
    for seed in 0..48 {
        let mut next = random(seed * 7919 + 1);
        let mut desc = free_grid(2 + (next() * 9.0) as u32, 3 + (next() * 9.0) as u32);
        desc.settings.gravity = Vec3::ZERO;
        desc.settings.iterations = 1 + (next() * 3.0) as u32;
        desc.material.bend_stiffness = 1.0e-6 * 1.0e4_f32.powf(next());
        if next() < 0.5 {
            desc.material.stretch_stiffness_warp = 2.0e3;
            desc.material.stretch_stiffness_weft = 2.0e3;
        }
        let mut cloth = in_vacuum(Cloth::grid(&desc).unwrap());
        for i in 0..cloth.particle_count() {
            let v = Vec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
            cloth.set_velocity(i, v).unwrap();
        }
        let (p0, l0, e0) = (mean_velocity(&cloth), spin(&cloth), kinetic_energy(&cloth));
        for tick in 0..120 {
            cloth.step(1);
            let energy = kinetic_energy(&cloth);
            assert!(energy < e0 * 1.001, "seed {seed}, tick {tick}: {e0} to {energy} J");
        }
        let mass: f32 = (0..cloth.particle_count()).map(|i| cloth.mass(i).unwrap()).sum();
        let drift = mean_velocity(&cloth).distance(p0);
        assert!(drift < 1.0e-5, "seed {seed}: momentum / mass changed by {drift} m/s");
        let turned = spin(&cloth).distance(l0) / (mass * desc.spacing * desc.columns as f32);
        assert!(turned < 0.02, "seed {seed}: angular momentum changed by {turned} m/s");
    }
}
