//! Two bodies that leave the cloth less room than the distances that it keeps from both, or none on
//! the line between them.
//!
//! The one that was solved last used to take all of its distance, and pushed the cloth into the other.

use crate::checks::stretch::RestShape;
use crate::common::shapes::{octahedron, signed_distance, sphere_mesh};
use crate::common::triangles;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, SelfCollision, Shape};
use std::f32::consts::FRAC_PI_2;

/// The distance that the cloth keeps from each body [m].
const THICKNESS: f32 = 0.01;
/// The room between the bodies when they are nearest [m].
const ROOM: f32 = 0.007;
/// Half the size of a body along the line between them [m].
const RADIUS: f32 = 0.1;
/// Depth that counts as inside [m].
const TOLERANCE: f32 = 1.0e-4;

fn hung_sheet(self_collision: SelfCollision, max_stretch: f32) -> Cloth {
    let mut desc = GridDesc { columns: 25, rows: 25, spacing: 0.02, ..GridDesc::default() };
    desc.origin = Vec3::new(-0.24, 0.0, 0.0);
    desc.settings.self_collision = self_collision;
    desc.settings.max_stretch = max_stretch;
    Cloth::grid(&desc).unwrap()
}

/// Moves two bodies to [`ROOM`] from both sides of a hung sheet, then past each other sideways, one
/// faster than the other, at `speed` [m/s] and less.
fn squeeze(body: &ColliderDesc, self_collision: SelfCollision, max_stretch: f32, speed: f32) {
    let case = format!("{:?}, {self_collision:?}, bound {max_stretch}, {speed} m/s", body.shape);
    let mut cloth = hung_sheet(self_collision, max_stretch);
    let desc = |side: f32, distance: f32, along: f32| ColliderDesc {
        position: Vec3::new(along, -0.35, side * (RADIUS + 0.5 * distance)),
        thickness: THICKNESS,
        ..body.clone()
    };
    let at = |time: f32| {
        let distance = ROOM + (0.2 - speed * time).max(0.0);
        let along = speed * (time - 0.2 / speed).clamp(0.0, 0.12 / speed);
        [desc(-1.0, distance, -0.3 * along), desc(1.0, distance, along)]
    };
    let bodies = at(0.0).map(|body| cloth.add_collider(&body).unwrap());
    let rest = RestShape::of(&cloth);
    for tick in 1..=(0.4 / speed * 60.0) as u32 {
        let now = at(tick as f32 / 60.0);
        for (body, desc) in bodies.iter().zip(&now) {
            cloth.move_collider(*body, desc.position, desc.rotation).unwrap();
        }
        cloth.step(1);
        for (desc, x) in now.iter().flat_map(|d| cloth.positions().iter().map(move |x| (d, *x))) {
            let depth = -signed_distance(desc, x);
            assert!(depth < TOLERANCE, "{case}, tick {tick}: {x} is {depth} m inside");
        }
        let stats = cloth.stats();
        assert_eq!(stats.free_inside, 0, "{case}, tick {tick}");
        let strain = rest.strain(&cloth);
        assert!(!strain.is_broken, "{case}, tick {tick}: stretched by {}", strain.greatest);
        assert_eq!(stats.over_stretched, 0, "{case}, tick {tick}");
    }
}

#[test]
fn cloth_between_two_bodies_stays_outside_both_and_within_its_stretch() {
    let solid = |shape| ColliderDesc {
        shape,
        radius: RADIUS,
        top_radius: RADIUS,
        half_height: 0.1,
        half_extents: Vec3::splat(RADIUS),
        ..ColliderDesc::default()
    };
    let [ball, capsule, cuboid] = [Shape::Sphere, Shape::Capsule, Shape::Box].map(solid);
    for body in [ball, capsule, cuboid, octahedron(RADIUS), sphere_mesh(RADIUS, 12)] {
        for self_collision in [SelfCollision::None, SelfCollision::Surface] {
            for max_stretch in [0.0, 0.05] {
                for speed in [1.0, 3.0] {
                    squeeze(&body, self_collision, max_stretch, speed);
                }
            }
        }
        squeeze(&body, SelfCollision::None, 0.0, 0.2);
        squeeze(&body, SelfCollision::Surface, 0.05, 0.2);
    }
}

/// Closes two bodies on the hem of a hung sheet from both sides at `speed` [m/s] each, until they
/// overlap by 10 mm, and parts them again.
fn close(bodies: [&ColliderDesc; 2], self_collision: SelfCollision, bound: f32, speed: f32) {
    const OVERLAP: f32 = 0.01;
    const START: f32 = 0.1;
    let shapes = bodies.map(|body| body.shape);
    let case = format!("{shapes:?}, {self_collision:?}, bound {bound}, {speed} m/s");
    let mut cloth = hung_sheet(self_collision, bound);
    let at = |way: f32| {
        // The bodies' middle is below the hem, so there is room above them.
        [(bodies[0], -1.0), (bodies[1], 1.0)].map(|(body, side)| ColliderDesc {
            position: Vec3::new(0.0, -0.495, side * (RADIUS + (START - way).max(-0.5 * OVERLAP))),
            thickness: 2.0e-3,
            ..body.clone()
        })
    };
    let colliders = at(0.0).map(|body| cloth.add_collider(&body).unwrap());
    let closing = ((START + 0.5 * OVERLAP) / speed * 60.0).ceil() as u32;
    for tick in 1..=2 * closing + 30 {
        let way = tick.min((2 * closing + 30).saturating_sub(tick)) as f32 * speed / 60.0;
        let now = at(way);
        for (collider, desc) in colliders.iter().zip(&now) {
            cloth.move_collider(*collider, desc.position, desc.rotation).unwrap();
        }
        cloth.step(1);
        for (desc, x) in now.iter().flat_map(|d| cloth.positions().iter().map(move |x| (d, *x))) {
            let depth = -signed_distance(desc, x);
            assert!(depth < TOLERANCE, "{case}, tick {tick}: {x} is {depth} m inside");
        }
        assert_eq!(cloth.stats().free_inside, 0, "{case}, tick {tick}");
    }
}

#[test]
fn cloth_on_which_two_round_bodies_close_comes_out_along_their_crease() {
    let solid = |shape, rotation| ColliderDesc {
        shape,
        radius: RADIUS,
        top_radius: RADIUS,
        half_height: 0.3,
        rotation,
        ..ColliderDesc::default()
    };
    let ball = solid(Shape::Sphere, Quat::IDENTITY);
    let capsule = solid(Shape::Capsule, Quat::from_rotation_z(FRAC_PI_2));
    for pair in [[&ball, &ball], [&ball, &capsule], [&capsule, &capsule]] {
        for self_collision in [SelfCollision::None, SelfCollision::Surface] {
            for (bound, speeds) in [(0.0, &[0.05, 0.5, 3.0][..]), (0.05, &[0.05, 0.5])] {
                for speed in speeds {
                    close(pair, self_collision, bound, *speed);
                }
            }
        }
    }
}

/// Presses a sheet, which starts `height` above the middle of a box, onto that box with four capsules,
/// two of them above edges of its top, and lifts it.
fn press_above_edges(height: f32) {
    const RADIUS: f32 = 0.015;
    let mut desc = GridDesc { columns: 30, rows: 30, spacing: 0.5 / 29.0, ..GridDesc::default() };
    desc.pin_mode = PinMode::None;
    desc.down = Vec3::Z;
    desc.origin = Vec3::new(-0.25, height, -0.25);
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let at = |tick: u32| {
        let share = (tick as f32 / 60.0).min(1.0);
        let lift = 0.3 * (tick.saturating_sub(60) as f32 / 60.0).min(1.0);
        let cuboid = ColliderDesc {
            shape: Shape::Box,
            half_extents: Vec3::new(0.06, 0.02, 0.06),
            position: Vec3::Y * lift,
            ..ColliderDesc::default()
        };
        let [a, b, c, d] = [-0.054, -0.018, 0.018, 0.054].map(|x| ColliderDesc {
            shape: Shape::Capsule,
            radius: RADIUS,
            top_radius: RADIUS,
            half_height: 0.04,
            position: Vec3::new(x, lift + 0.2 + (0.041 - 0.2) * share, 0.0),
            rotation: Quat::from_rotation_x(FRAC_PI_2),
            ..ColliderDesc::default()
        });
        [cuboid, a, b, c, d]
    };
    let bodies = at(0).map(|body| cloth.add_collider(&body).unwrap());
    for tick in 1..=180 {
        let now = at(tick);
        for (body, desc) in bodies.iter().zip(&now) {
            cloth.move_collider(*body, desc.position, desc.rotation).unwrap();
        }
        cloth.step(1);
        for [i, j] in triangles(&cloth).into_iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]) {
            let [from, to] = [i, j].map(|i| cloth.position(i).unwrap());
            for part in 1..16 {
                let x = from.lerp(to, part as f32 / 16.0);
                let depth = -signed_distance(&now[0], x);
                assert!(depth < TOLERANCE, "{height}, tick {tick}: {x} is {depth} m inside");
            }
        }
    }
}

#[test]
fn edges_of_cloth_stay_outside_a_box_while_a_capsule_presses_on_one_of_their_ends() {
    for height in [0.02115, 0.0214, 0.02143] {
        press_above_edges(height);
    }
}
