//! Bodies as small as a few cells, faceted bodies and fast bodies: neither particles nor triangles
//! of the cloth are in them after any tick, and none passes through.
//!
//! The checks are those of `cargo xtask verify`; the cases come from trials in which triangles
//! crossed a body between their corners.

use crate::checks::bodies::Body;
use crate::checks::surface::Surface;
use crate::shapes::{
    box_mesh, capsule, cuboid, floor, head_with_ears, level_sheet, lumpy_mesh, push_patch,
    round_mesh, sphere, upright_sheet, with_bound, with_surface, without_losses,
};
use muslin::glam::{DVec3, Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision};
use std::f32::consts::FRAC_PI_2;

/// Depth of a particle or a triangle that counts as penetration [m].
const TOLERANCE: f64 = 1.0e-4;

/// What is wrong after a tick; depths in metres.
#[derive(Debug, PartialEq)]
enum Failure {
    ParticleInside {
        depth: f64,
    },
    TriangleInside {
        depth: f64,
    },
    TrianglesCross {
        pairs: usize,
    },
    /// The body is past the cloth.
    Passed,
}

/// A cloth and the body that it must stay out of.
struct Impact {
    cloth: Cloth,
    body: Body,
    /// Particles that are pinned.
    held: Vec<bool>,
    /// The direction in which the body moves relative to the cloth.
    direction: Vec3,
}

impl Impact {
    fn new(sheet: &GridDesc, body: ColliderDesc, direction: Vec3) -> Self {
        Self::of(Cloth::grid(sheet).unwrap(), body, direction)
    }

    fn of(mut cloth: Cloth, body: ColliderDesc, direction: Vec3) -> Self {
        let collider = cloth.add_collider(&body).unwrap();
        let mut held = vec![false; cloth.particle_count() as usize];
        cloth.pinned().for_each(|particle| held[particle as usize] = true);
        Self { cloth, body: Body::new(collider, body), held, direction }
    }

    /// Moves the body by `way` [m] within the next tick.
    fn advance(&mut self, way: f32) {
        self.body.desc.position += self.direction * way;
        self.cloth
            .move_collider(self.body.collider, self.body.desc.position, Quat::IDENTITY)
            .unwrap();
    }

    /// Runs a tick, and returns what is wrong after it.
    fn step(&mut self) -> Result<(), Failure> {
        self.cloth.step(1);
        let surface = Surface::of(&self.cloth);
        let found = self.body.penetration(&self.cloth, &surface, &self.held);
        if found.particles > TOLERANCE {
            return Err(Failure::ParticleInside { depth: found.particles });
        }
        if found.triangles > TOLERANCE {
            return Err(Failure::TriangleInside { depth: found.triangles });
        }
        if found.pairs > 0 {
            return Err(Failure::TrianglesCross { pairs: found.pairs });
        }
        // Slightly oblique, so that the ray does not run along an edge of the grid.
        let ahead = self.direction.as_dvec3() + DVec3::new(0.0123, 0.0071, 0.0031);
        if surface.tree.count_ray_hits(self.body.desc.position.as_dvec3(), ahead) == 0 {
            return Err(Failure::Passed);
        }
        Ok(())
    }
}

/// Asserts that none of the named runs failed.
fn assert_all_hold(runs: impl IntoIterator<Item = (String, Result<(), String>)>) {
    let failures: Vec<String> = runs
        .into_iter()
        .filter_map(|(name, run)| Some(format!("{name}: {}", run.err()?)))
        .collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Lets a sheet fall on a body above a floor.
fn drop_on(body: ColliderDesc, sheet: &GridDesc, ticks: u32) -> Result<(), String> {
    fall(Impact::new(sheet, body, Vec3::Y), ticks)
}

fn fall(mut impact: Impact, ticks: u32) -> Result<(), String> {
    const FLOOR: f32 = -0.6;
    impact.cloth.add_collider(&floor(FLOOR)).unwrap();
    (0..ticks).try_for_each(|tick| {
        impact.step().map_err(|what| format!("tick {tick}: {what:?}"))?;
        let lowest = impact.cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
        let is_above = f64::from(lowest - FLOOR) > -TOLERANCE;
        if is_above { Ok(()) } else { Err(format!("tick {tick}: lowest at {lowest} m")) }
    })
}

/// A level sheet as a mesh whose triangles are not in the order of a grid, so that none is detected
/// and the mesh solver runs.
fn mesh_sheet(side: u32, width: f32) -> MeshDesc {
    let mut desc = MeshDesc::default();
    let at = |k: u32| width * (k as f32 / (side - 1) as f32 - 0.5);
    push_patch(&mut desc, side, side, |i, j| Vec3::new(at(i), 0.0, at(j)));
    desc.indices.rotate_left(3);
    desc
}

#[test]
fn a_sheet_that_falls_on_a_small_ball_or_rod_is_caught() {
    let ball = sphere(0.03, Vec3::Y * -0.05);
    let large_ball = sphere(0.1, Vec3::Y * -0.12);
    let upright_rod = capsule(0.03, 0.15, Vec3::Y * -0.2);
    let lying = Quat::from_rotation_z(FRAC_PI_2);
    let rod = ColliderDesc { rotation: lying, ..capsule(0.03, 0.15, Vec3::Y * -0.05) };
    let sheet = |self_collision: SelfCollision, substeps: u32| {
        let mut mesh = mesh_sheet(40, 0.7);
        mesh.settings.self_collision = self_collision;
        mesh.settings.substeps = substeps;
        Cloth::mesh(&mesh).unwrap()
    };
    let grid = Cloth::grid(&level_sheet(40, 0.7, 0.0)).unwrap();
    let runs = [
        ("ball", sheet(SelfCollision::None, 4), &ball),
        ("ball, surface collision", sheet(SelfCollision::Surface, 4), &ball),
        ("large ball", sheet(SelfCollision::None, 4), &large_ball),
        ("rod", sheet(SelfCollision::None, 4), &rod),
        ("rod, surface collision", sheet(SelfCollision::Surface, 4), &rod),
        ("rod, 16 substeps", sheet(SelfCollision::None, 16), &rod),
        ("upright rod", sheet(SelfCollision::None, 4), &upright_rod),
        ("upright rod, 16 substeps", sheet(SelfCollision::None, 16), &upright_rod),
        ("grid on a ball", grid.clone(), &ball),
        ("grid on a rod", grid, &rod),
    ];
    assert_all_hold(runs.map(|(name, cloth, body)| {
        (name.to_string(), fall(Impact::of(cloth, body.clone(), Vec3::Y), 32))
    }));
}

#[test]
fn triangles_stay_out_of_faceted_bodies() {
    let half = Vec3::new(0.25, 0.2, 0.25);
    let cells_of_three_centimetres = level_sheet(40, 1.17, 0.4);
    let on_a_box = with_surface(level_sheet(49, 0.9, 0.25));
    let round = round_mesh(58, 120, |_, _| Vec3::splat(0.3));
    let cases = [
        ("lumpy mesh", lumpy_mesh(), &cells_of_three_centimetres),
        ("round mesh", round, &cells_of_three_centimetres),
        ("box as a mesh", box_mesh(half, 6), &on_a_box),
        ("box", cuboid(half, Vec3::ZERO), &on_a_box),
    ];
    assert_all_hold(cases.map(|(name, body, sheet)| (name.to_string(), drop_on(body, sheet, 60))));
}

#[test]
fn triangles_stay_out_of_a_concave_body_of_ten_thousand_vertices() {
    let run = drop_on(head_with_ears(), &level_sheet(20, 0.57, 0.5), 45);
    assert_all_hold([("head with ears".to_string(), run)]);
}

/// Round meshes whose poles are fans: the faces around a pole are narrow, so neighbours differ little
/// and opposite ones much.
fn fans() -> impl Iterator<Item = (String, ColliderDesc)> {
    let bodies = [(7, 12), (7, 18), (8, 14), (9, 20), (10, 16)];
    let places = [Vec3::ZERO, Vec3::X * 0.01, Vec3::new(0.006, 0.0, -0.009)];
    bodies.into_iter().flat_map(move |(rings, around)| {
        places.map(|position| {
            let mesh = round_mesh(rings, around, |_, _| Vec3::splat(0.1));
            let name = format!("{rings} rings of {around} at {position}");
            (name, ColliderDesc { position, ..mesh })
        })
    })
}

#[test]
fn triangles_stay_out_of_the_pole_of_a_fan() {
    let sheet = level_sheet(20, 0.57, 0.105);
    assert_all_hold(fans().map(|(name, body)| (name, drop_on(body, &sheet, 60))));
}

#[test]
fn triangles_stay_out_of_the_pole_of_a_fan_that_deforms() {
    let sheet = level_sheet(20, 0.57, 0.105);
    let rest_on_waves = |body: ColliderDesc| {
        let mut impact = Impact::new(&sheet, body, Vec3::Y);
        let rest = impact.body.desc.positions.clone();
        (0..60).try_for_each(|tick| {
            let stretch = 1.0 + 0.1 * (0.2 * tick as f32).sin();
            let now: Vec<Vec3> = rest.iter().map(|x| Vec3::new(x.x, x.y * stretch, x.z)).collect();
            impact.cloth.update_collider(impact.body.collider, &now).unwrap();
            impact.body.deform(now);
            impact.step().map_err(|what| format!("tick {tick}: {what:?}"))
        })
    };
    assert_all_hold(fans().map(|(name, body)| (name, rest_on_waves(body))));
}

#[test]
fn a_small_ball_does_not_pass_between_the_particles_of_a_sheet() {
    let run = |side: u32, speed: f32| {
        let ball = sphere(0.05, Vec3::Y * -0.1);
        let mut impact = Impact::new(&level_sheet(side, 0.8, 0.0), ball, Vec3::Y);
        let ticks = (0.3 / speed * 60.0).ceil() as u32 + 6;
        (0..ticks).try_for_each(|tick| {
            impact.advance((0.2 - impact.body.desc.position.y).min(speed / 60.0));
            impact.step().map_err(|what| format!("tick {tick}: {what:?}"))
        })
    };
    assert_all_hold([40, 41].into_iter().flat_map(|side| {
        [1.0, 2.0, 3.0, 5.0]
            .map(|speed| (format!("{side} particles a side, {speed} m/s"), run(side, speed)))
    }));
}

/// Ticks of a flight.
const FLIGHT: u32 = 18;

/// An upright sheet, 2 m wide; a free one is without gravity.
fn target_sheet(is_hung: bool) -> GridDesc {
    let mut sheet = upright_sheet(40, 2.0);
    if is_hung {
        sheet.pin_mode = PinMode::TopEdge;
    } else {
        sheet.settings.gravity = Vec3::ZERO;
    }
    sheet
}

/// Flies a body from 0.5 m before an upright sheet into it and on. Against a hung sheet it stops
/// after 1.1 m.
fn fly(mut body: ColliderDesc, speed: f32, sheet: &GridDesc) -> Result<(), String> {
    body.position = Vec3::Z * -0.5;
    let mut impact = Impact::new(sheet, body, Vec3::Z);
    let end = if sheet.pin_mode == PinMode::None { f32::INFINITY } else { 0.6 };
    (0..FLIGHT).try_for_each(|tick| {
        let way = (end - impact.body.desc.position.z).min(speed / 60.0);
        impact.advance(way);
        impact.step().or_else(|what| {
            // When the body has stopped, a hung sheet may swing on beside it.
            let is_beside = way == 0.0 && what == Failure::Passed;
            if is_beside { Ok(()) } else { Err(format!("tick {tick}: {what:?}")) }
        })
    })
}

/// Speeds against a hung and against a free sheet [m/s].
const SPEEDS: [(&str, &[f32]); 2] = [("hung", &[5.0, 15.0, 50.0]), ("free", &[5.0, 15.0, 50.0])];

fn assert_sheet_stays_out_of(body: &ColliderDesc, speeds: [(&str, &[f32]); 2]) {
    assert_all_hold(speeds.into_iter().flat_map(|(sheet, speeds)| {
        speeds.iter().map(move |speed| {
            (
                format!("{sheet}, {speed} m/s"),
                fly(body.clone(), *speed, &target_sheet(sheet == "hung")),
            )
        })
    }));
}

#[test]
fn a_sheet_stays_out_of_a_fast_sphere() {
    assert_sheet_stays_out_of(&sphere(0.3, Vec3::ZERO), SPEEDS);
}

#[test]
fn a_sheet_stays_out_of_a_fast_box() {
    assert_sheet_stays_out_of(&cuboid(Vec3::new(0.3, 0.2, 0.25), Vec3::ZERO), SPEEDS);
}

#[test]
fn a_sheet_stays_out_of_a_fast_capsule() {
    assert_sheet_stays_out_of(&capsule(0.2, 0.3, Vec3::ZERO), SPEEDS);
}

#[test]
fn a_sheet_stays_out_of_a_fast_mesh() {
    // The manual lists faster meshes among the known limits.
    let speeds: [(&str, &[f32]); 2] = [("hung", &[5.0]), ("free", &[5.0, 15.0])];
    assert_sheet_stays_out_of(&round_mesh(16, 32, |_, _| Vec3::splat(0.3)), speeds);
}

#[test]
fn a_bounded_sheet_with_surface_stays_out_of_a_fast_mesh() {
    // Where the last phase began with the path of the last substep, particles ended on the inner
    // side of the mesh, which had moved on.
    let sheet = with_surface(with_bound(without_losses(target_sheet(false)), 0.05));
    let ball = round_mesh(16, 32, |_, _| Vec3::splat(0.3));
    assert_all_hold(
        [3.0, 5.0].map(|speed| (format!("{speed} m/s"), fly(ball.clone(), speed, &sheet))),
    );
}
