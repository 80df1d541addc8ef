//! The corner of a free sheet between two colliders that leave it a gap of a few millimetres.

use crate::checks::bodies::Body;
use crate::checks::surface::Surface;
use crate::shapes::{cuboid, with_bound};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, SelfCollision};
use std::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Depth of a particle or a triangle that counts as penetration [m].
const TOLERANCE: f64 = 1.0e-4;
/// Half the size of a box along z [m].
const HALF: f32 = 0.1;
/// Angle by which a sheet leans out of the plane of the gap [rad].
const TILT: f32 = 0.2;
/// Self-collision and bound of stretch of a run.
type Mode = (SelfCollision, f32);
/// The modes, each with the speeds at which a sheet falls [m/s].
const MODES: [(Mode, &[f32]); 2] =
    [((SelfCollision::None, 0.0), &[0.0, 2.0, 5.0]), ((SelfCollision::Surface, 0.05), &[2.0])];

/// A sheet of 25 x 25 particles that leans and points down with a corner at height `y` [m] in the
/// x–y plane.
fn sheet_on_its_corner(y: f32, (self_collision, bound): Mode) -> Cloth {
    let tilt = Quat::from_rotation_x(TILT);
    let along = |x: f32| tilt * Vec3::new(x * FRAC_1_SQRT_2, -FRAC_1_SQRT_2, 0.0);
    let mut desc = GridDesc {
        columns: 25,
        rows: 25,
        spacing: 0.02,
        origin: Vec3::Y * y - 0.48 * (along(1.0) + along(-1.0)),
        right: along(1.0),
        down: along(-1.0),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.self_collision = self_collision;
    Cloth::grid(&with_bound(desc, bound)).unwrap()
}

/// A box whose top is at y = 0 and whose nearest face is `distance` [m] from the x–y plane, on the
/// given side of it.
fn wall(side: f32, distance: f32) -> ColliderDesc {
    cuboid(Vec3::new(0.4, 0.2, HALF), Vec3::new(0.0, -0.2, side * (HALF + distance)))
}

/// A plane at this distance [m] behind the x–y plane.
fn upright_plane(distance: f32) -> ColliderDesc {
    let rotation = Quat::from_rotation_x(FRAC_PI_2);
    ColliderDesc { rotation, position: Vec3::NEG_Z * distance, ..ColliderDesc::default() }
}

/// Runs `ticks` ticks with the colliders moved to `pose(tick)` first, and checks after each that the
/// sheet is outside both.
fn run(
    case: &str,
    mut cloth: Cloth,
    colliders: [ColliderDesc; 2],
    ticks: u32,
    pose: impl Fn(u32) -> [Vec3; 2],
) {
    let mut bodies = colliders.map(|desc| Body::new(cloth.add_collider(&desc).unwrap(), desc));
    let held = vec![false; cloth.particle_count() as usize];
    for tick in 0..ticks {
        for (body, position) in bodies.iter_mut().zip(pose(tick)) {
            body.desc.position = position;
            cloth.move_collider(body.collider, position, body.desc.rotation).unwrap();
        }
        cloth.step(1);
        let surface = Surface::of(&cloth);
        for body in &bodies {
            let (found, shape) = (body.penetration(&cloth, &surface, &held), body.desc.shape);
            let depth = found.particles.max(found.triangles);
            assert!(depth < TOLERANCE, "{case}, tick {tick}: {found:?} in {shape:?}");
        }
        assert_eq!(cloth.stats().free_inside, 0, "{case}, tick {tick}");
    }
}

/// Drops a sheet at `speed` [m/s] into gaps between a box and another box or a plane.
fn fall_into_gaps(gaps: &[f32]) {
    for gap in gaps {
        for (name, other) in [("box", wall(-1.0, 0.5 * gap)), ("plane", upright_plane(0.5 * gap))] {
            for (mode, speeds) in MODES {
                for speed in speeds {
                    let case = format!("{gap} m to a {name}, {mode:?}, {speed} m/s");
                    let mut cloth = sheet_on_its_corner(0.01, mode);
                    let velocity = Vec3::NEG_Y * *speed;
                    (0..625).for_each(|i| cloth.set_velocity(i, velocity).unwrap());
                    let walls = [other.clone(), wall(1.0, 0.5 * gap)];
                    let at = walls.clone().map(|desc| desc.position);
                    run(&case, cloth, walls, 14, |_| at);
                }
            }
        }
    }
}

#[test]
fn a_corner_that_falls_into_a_gap_stays_outside_both_of_its_walls() {
    fall_into_gaps(&[2.0e-3, 4.0e-3, 8.0e-3]);
}

#[test]
fn a_corner_on_which_two_boxes_close_stays_outside_both() {
    const START: f32 = 0.1;
    for (gap, speed) in [(2.0e-3, 1.0), (2.0e-3, 3.0), (8.0e-3, 3.0)] {
        for (mode, _) in MODES {
            let case = format!("closing to {gap} m, {mode:?}, {speed} m/s");
            let walls_at = |time: f32| {
                let distance = (START - speed * time).max(0.5 * gap);
                [-1.0, 1.0].map(|side| wall(side, distance))
            };
            let ticks = ((START / speed) * 60.0).ceil() as u32 + 10;
            let pose = |tick| walls_at((tick + 1) as f32 / 60.0).map(|desc| desc.position);
            let cloth = sheet_on_its_corner(-0.1, mode);
            run(&case, cloth, walls_at(0.0), ticks, pose);
        }
    }
}
