//! A sheet that lands on a collider of each shape comes to rest and stays outside the collider.

use crate::common::rms_speed;
use crate::common::shapes::{
    free_sheet, hilly_heightfield, octahedron, speed_and_drift_at_rest, sphere_mesh,
    ticks_until_rest, vertex_and_face_clearance,
};
use muslin::glam::{EulerRot, Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Shape};

/// Largest penetration of triangles while a sheet lands [m]; particles must stay outside.
const MAX_FACE_PENETRATION: f32 = 2.0e-3;

/// Drops a sheet on a collider and asserts that it stays outside throughout and comes to rest.
fn assert_lands_and_rests(desc: &ColliderDesc, mut cloth: Cloth) -> Cloth {
    let name = format!("{:?} with {} vertices", desc.shape, cloth.positions().len());
    cloth.add_collider(desc).unwrap();
    cloth.add_collider(&ColliderDesc { position: Vec3::Y * -1.0, ..Default::default() }).unwrap();
    let (mut deepest, mut faces) = (f32::INFINITY, f32::INFINITY);
    for tick in 0..240 {
        cloth.step(1);
        if tick % 8 == 0 {
            let (vertex, face) = vertex_and_face_clearance(&cloth, desc);
            (deepest, faces) = (deepest.min(vertex), faces.min(face));
        }
    }
    println!("{name}: vertices {deepest} m, faces {faces} m while it lands");
    assert!(deepest > -2.0e-5, "{name}: a vertex is {} m inside", -deepest);
    assert!(faces > -MAX_FACE_PENETRATION, "{name}: a triangle is {} m inside", -faces);
    let ticks = ticks_until_rest(&mut cloth, 2400);
    let (noise, drift) = speed_and_drift_at_rest(&mut cloth);
    println!("{name}: at rest after {ticks} ticks, noise {noise} m/s, drift {drift} m");
    assert!(noise < 1.0e-3 && drift < 1.0e-3, "{name}: noise {noise} m/s, drift {drift} m");
    let (vertex, face) = vertex_and_face_clearance(&cloth, desc);
    assert!(vertex > 0.0 && face > 0.0, "{name} at rest: {vertex} m, {face} m");
    cloth
}

/// Number of particles above `height` [m].
fn count_above(cloth: &Cloth, height: f32) -> usize {
    cloth.positions().iter().filter(|x| x.y > height).count()
}

#[test]
fn a_sheet_on_a_sphere_stays_outside_and_comes_to_rest() {
    for nodes in [24, 40, 56] {
        let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.3, ..Default::default() };
        let cloth = assert_lands_and_rests(
            &ball,
            Cloth::grid(&free_sheet(nodes, 1.0, 0.3 + 0.15)).unwrap(),
        );
        assert!(count_above(&cloth, 0.2) > 10, "the sheet fell off");
    }
}

#[test]
fn a_sheet_on_a_sphere_smaller_than_a_cell_stays_outside() {
    let ball = ColliderDesc {
        shape: Shape::Sphere,
        radius: 0.02,
        position: Vec3::new(0.011, 0.0, 0.013),
        ..Default::default()
    };
    let mut desc = free_sheet(9, 0.8, 0.2);
    desc.material.bend_stiffness = 0.02;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&ball).unwrap();
    cloth.add_collider(&ColliderDesc { position: Vec3::Y * -0.1, ..Default::default() }).unwrap();
    for _ in 0..300 {
        cloth.step(1);
        let (vertex, face) = vertex_and_face_clearance(&cloth, &ball);
        assert!(vertex > 0.0 && face > -1.0e-3, "{vertex} m, {face} m");
    }
    assert!(count_above(&cloth, -0.05) > 0, "the sheet slipped past the ball");
}

#[test]
fn a_sheet_on_a_capsule_stays_outside_and_comes_to_rest() {
    let lying = Quat::from_rotation_z(1.4);
    for top_radius in [-1.0, 0.05] {
        let capsule = ColliderDesc {
            shape: Shape::Capsule,
            radius: 0.15,
            top_radius,
            half_height: 0.3,
            rotation: lying,
            ..Default::default()
        };
        let cloth =
            assert_lands_and_rests(&capsule, Cloth::grid(&free_sheet(24, 1.0, 0.3)).unwrap());
        assert!(count_above(&cloth, 0.0) > 10, "the sheet fell off");
    }
}

#[test]
fn a_sheet_on_a_box_stays_outside_and_comes_to_rest() {
    let turned = Quat::from_euler(EulerRot::XYZ, 0.5, 0.3, 0.6);
    for (half_extents, rotation) in
        [(Vec3::new(0.25, 0.2, 0.25), Quat::IDENTITY), (Vec3::new(0.25, 0.2, 0.15), turned)]
    {
        let desc = ColliderDesc { shape: Shape::Box, half_extents, rotation, ..Default::default() };
        assert_lands_and_rests(&desc, Cloth::grid(&free_sheet(21, 0.9, 0.45)).unwrap());
    }
}

#[test]
fn a_pole_thinner_than_a_cell_does_not_penetrate_the_sheet() {
    let half_extents = Vec3::new(0.012, 0.2, 0.012);
    let pole = ColliderDesc { shape: Shape::Box, half_extents, ..Default::default() };
    let mut cloth = Cloth::grid(&free_sheet(31, 0.9, 0.45)).unwrap();
    cloth.add_collider(&pole).unwrap();
    for tick in 0..400 {
        cloth.step(1);
        if tick % 8 == 0 {
            let (vertex, face) = vertex_and_face_clearance(&cloth, &pole);
            assert!(
                vertex > -2.0e-5 && face > -MAX_FACE_PENETRATION,
                "tick {tick}: {vertex} m, {face} m"
            );
        }
    }
    assert!(count_above(&cloth, 0.19) > 0, "the sheet fell off");
}

/// A soft sheet that hangs over the tips of the body keeps moving at a few mm/s.
#[test]
fn a_sheet_on_a_convex_collider_stays_outside() {
    let rotation = Quat::from_euler(EulerRot::XYZ, 0.2, 0.3, 0.1);
    let body = ColliderDesc { rotation, ..octahedron(0.3) };
    let mut cloth = Cloth::grid(&free_sheet(21, 0.9, 0.45)).unwrap();
    cloth.add_collider(&body).unwrap();
    for tick in 0..900 {
        cloth.step(1);
        if tick % 8 == 0 {
            let (vertex, face) = vertex_and_face_clearance(&cloth, &body);
            assert!(
                vertex > -2.0e-5 && face > -MAX_FACE_PENETRATION,
                "tick {tick}: {vertex} m, {face} m"
            );
        }
        let speed = rms_speed(&cloth);
        assert!(tick < 600 || speed < 0.03, "tick {tick}: {speed} m/s");
    }
    assert!(count_above(&cloth, 0.1) > 0, "the sheet fell off");
}

#[test]
fn a_sheet_on_a_mesh_collider_stays_outside_and_comes_to_rest() {
    let cloth = assert_lands_and_rests(
        &sphere_mesh(0.3, 6),
        Cloth::grid(&free_sheet(21, 0.9, 0.45)).unwrap(),
    );
    assert!(count_above(&cloth, 0.2) > 10, "the sheet fell off");
}

#[test]
fn a_sheet_on_a_heightfield_stays_above_it_and_comes_to_rest() {
    for cells in [6, 20] {
        assert_lands_and_rests(
            &hilly_heightfield(cells, 1.6),
            Cloth::grid(&free_sheet(21, 0.9, 0.45)).unwrap(),
        );
    }
}
