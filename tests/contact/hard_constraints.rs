//! Colliders, non-crossing and the stretch bound hold together, not only one at a time.
//!
//! The cases come from trials in which each guarantee held alone and broke beside another one.

use crate::checks::bodies::Body;
use crate::checks::stretch::RestShape;
use crate::checks::surface::Surface;
use crate::common::crossings::crossing_count;
use crate::common::shapes::tube;
use crate::shapes::{sphere, upright_sheet};
use muslin::glam::{DVec3, Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Shape};

/// Depth below y = 0 that counts as penetration [m].
const TOLERANCE: f32 = 1.0e-4;

fn lowest(cloth: &Cloth) -> f32 {
    cloth.positions().iter().map(|p| p.y).fold(f32::MAX, f32::min)
}

/// Runs a cloth above the floor y = 0; with surface collision it starts and stays without crossings,
/// which are counted every tenth tick.
fn assert_stays_above_the_floor(desc: &GridDesc, velocity: impl Fn(Vec3) -> Vec3, ticks: u32) {
    let mode = desc.settings.self_collision;
    let mut cloth = Cloth::grid(desc).unwrap();
    cloth.add_collider(&ColliderDesc::default()).unwrap();
    for i in 0..cloth.particle_count() {
        cloth.set_velocity(i, velocity(cloth.position(i).unwrap())).unwrap();
    }
    for tick in 0..ticks {
        cloth.step(1);
        assert!(lowest(&cloth) > -TOLERANCE, "{mode:?}, tick {tick}: {} m", lowest(&cloth));
        if mode == SelfCollision::Surface && tick % 10 == 9 {
            assert_eq!(crossing_count(&cloth), 0, "tick {tick}");
        }
    }
}

fn with_mode(mut desc: GridDesc, self_collision: SelfCollision) -> GridDesc {
    desc.settings.self_collision = self_collision;
    desc
}

#[test]
fn a_strip_that_folds_onto_itself_stays_above_the_floor() {
    let (sin, cos) = 10.0_f32.to_radians().sin_cos();
    let desc = GridDesc {
        columns: 2,
        rows: 51,
        spacing: 0.01,
        origin: Vec3::new(0.0, 0.6, 0.0),
        right: Vec3::new(sin, 0.0, cos),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    for mode in [SelfCollision::Surface, SelfCollision::Particles] {
        assert_stays_above_the_floor(&with_mode(desc.clone(), mode), |_| Vec3::ZERO, 200);
    }
}

#[test]
fn a_sheet_that_crumples_on_the_floor_stays_above_it_without_crossing_itself() {
    let wave = |x: Vec3| Vec3::Z * (0.3 * (7.0 * x.x + 1.0).sin() * (5.0 * x.y + 2.0).sin());
    let sheet = |side: u32, mode: SelfCollision| {
        let desc = GridDesc { origin: Vec3::new(-1.0, 2.05, 0.0), ..upright_sheet(side, 2.0) };
        with_mode(desc, mode)
    };
    assert_stays_above_the_floor(&sheet(64, SelfCollision::Surface), wave, 30);
    assert_stays_above_the_floor(&sheet(32, SelfCollision::Surface), wave, 150);
    assert_stays_above_the_floor(&sheet(32, SelfCollision::Particles), wave, 150);
}

#[test]
fn a_hung_sheet_that_is_dropped_on_the_floor_stays_above_it() {
    let mut desc = GridDesc { columns: 24, rows: 24, ..GridDesc::default() };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let floor = lowest(&cloth) - 0.05;
    let position = Vec3::new(0.0, floor, 0.0);
    cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).unwrap();
    cloth.step(30);
    cloth.unpin_all();
    for tick in 0..90 {
        cloth.step(1);
        let depth = floor - lowest(&cloth);
        assert!(depth < TOLERANCE, "tick {tick}: {depth} m deep");
    }
}

/// Pushes a ball of 0.3 m at `speed` [m/s] against the middle of a free sheet, for 18 ticks.
fn push_by_a_ball(speed: f32, substeps: u32, max_stretch: f32, self_collision: SelfCollision) {
    let case = format!("{speed} m/s, {substeps} substeps, bound {max_stretch}, {self_collision:?}");
    let mut desc = GridDesc {
        columns: 20,
        rows: 20,
        spacing: 0.1,
        origin: Vec3::new(-0.95, 0.95, 0.0),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.substeps = substeps;
    desc.settings.max_stretch = max_stretch;
    desc.settings.self_collision = self_collision;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let ball = sphere(0.3, Vec3::Z * -0.5);
    let mut ball = Body::new(cloth.add_collider(&ball).unwrap(), ball);
    let (rest, held) = (RestShape::of(&cloth), vec![false; cloth.particle_count() as usize]);
    for tick in 0..18 {
        ball.desc.position.z += speed / 60.0;
        let center = ball.desc.position;
        cloth.move_collider(ball.collider, center, Quat::IDENTITY).unwrap();
        cloth.step(1);
        let surface = Surface::of(&cloth);
        let found = ball.penetration(&cloth, &surface, &held);
        let depth = found.particles.max(found.triangles);
        assert!(depth < f64::from(TOLERANCE), "{case}, tick {tick}: {depth} m");
        let strain = rest.strain(&cloth);
        assert!(!strain.is_broken || strain.is_told, "{case}, tick {tick}: {}", strain.greatest);
        // Slightly oblique, so that the ray does not run along an edge of the grid.
        let ahead = DVec3::new(0.0123, 0.0071, 1.0);
        let hits = surface.tree.count_ray_hits(center.as_dvec3(), ahead);
        assert!(hits > 0, "{case}, tick {tick}: the ball is past the sheet");
    }
}

#[test]
fn a_fast_ball_carries_a_free_sheet_along_whatever_else_holds() {
    for max_stretch in [0.0, 0.05] {
        for self_collision in [SelfCollision::None, SelfCollision::Surface] {
            for speed in [3.0, 5.0, 15.0] {
                push_by_a_ball(speed, 4, max_stretch, self_collision);
            }
            push_by_a_ball(10.0, 16, max_stretch, self_collision);
        }
    }
}

#[test]
fn a_skirt_over_legs_that_spread_wider_than_its_hem_stretches_no_more_than_they_force_it_to() {
    // A radius of 0.15 m at the waist, at y = 0, and of 0.3 m at the hem.
    let (positions, indices) = tube(64, 26, 0.15, [-0.5, 0.0]);
    let widened = |x: Vec3| Vec3::new(x.x * (1.0 - 2.0 * x.y), x.y, x.z * (1.0 - 2.0 * x.y));
    let positions: Vec<Vec3> = positions.into_iter().map(widened).collect();
    let pinned = (0..positions.len() as u32).filter(|i| positions[*i as usize].y == 0.0).collect();
    let mut desc = MeshDesc { positions, indices, pinned, ..MeshDesc::default() };
    desc.settings.max_stretch = 0.05;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let pose = |side: f32, angle: f32| {
        let rotation = Quat::from_rotation_x(side * angle);
        (Vec3::X * (0.075 * side) + rotation * Vec3::NEG_Y * 0.28, rotation)
    };
    let legs = [-1.0, 1.0].map(|side| {
        let (position, rotation) = pose(side, 0.0);
        let (shape, radius, half_height) = (Shape::Capsule, 0.08, 0.2);
        let desc =
            ColliderDesc { shape, radius, half_height, position, rotation, ..Default::default() };
        (side, cloth.add_collider(&desc).unwrap())
    });
    let (mut greatest, mut reported) = (0.0_f32, 0);
    for tick in 1..=30 {
        let angle =
            44.0_f32.to_radians() * (std::f32::consts::TAU * 2.5 * tick as f32 / 60.0).sin();
        for (side, leg) in legs {
            let (position, rotation) = pose(side, angle);
            cloth.move_collider(leg, position, rotation).unwrap();
        }
        cloth.step(1);
        let stats = cloth.stats();
        assert!(stats.max_stretch < 0.0501 || stats.over_stretched > 0, "tick {tick}");
        greatest = greatest.max(stats.max_stretch);
        reported = reported.max(stats.over_stretched);
    }
    assert!((0.06..0.3).contains(&greatest), "stretched by {greatest}");
    assert!(reported > 0);
}
