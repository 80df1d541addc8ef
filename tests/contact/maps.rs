//! Painted maps of friction and thickness, in contact with colliders and with the cloth itself.

use crate::common::shapes::{free_sheet, signed_distance, sphere_mesh, ticks_until_rest};
use crate::common::{bare_grid, rms_speed};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, Map, MeshDesc, PinMode, SelfCollision, Shape};

/// Scales of all particles of a cloth, by their rest position.
fn painted(cloth: &Cloth, scale: impl Fn(Vec3) -> f32) -> Vec<f32> {
    cloth.rest_positions().map(scale).collect()
}

/// Slope of the tests of friction.
fn tilt() -> Quat {
    Quat::from_rotation_z(-20.0_f32.to_radians())
}

/// Largest displacement of the particles at which `is_meant` holds [m], and the least one.
fn most_and_least_slid(
    cloth: &Cloth,
    start: &[Vec3],
    is_meant: impl Fn(usize) -> bool,
) -> [f32; 2] {
    let moved = |i: usize| cloth.positions()[i].distance(start[i]);
    let meant = || (0..start.len()).filter(|i| is_meant(*i)).map(moved);
    [meant().fold(0.0, f32::max), meant().fold(f32::INFINITY, f32::min)]
}

#[test]
fn a_piece_painted_without_friction_slides_while_the_other_piece_rests() {
    let plate = ColliderDesc {
        shape: Shape::Mesh,
        positions: [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
            .map(|(x, z)| Vec3::new(9.0 * x, 0.0, 9.0 * z))
            .to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Default::default()
    };
    let slab = ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(9.0, 0.5, 9.0),
        position: tilt() * Vec3::NEG_Y * 0.5,
        ..Default::default()
    };
    // With friction of the material, and with friction of the collider.
    for (collider, friction) in [(ColliderDesc::default(), -1.0), (slab, -1.0), (plate, 0.6)] {
        let mut grid: GridDesc = bare_grid(9, 9, 0.03, PinMode::None);
        (grid.right, grid.down) = (tilt() * Vec3::X, Vec3::Z);
        grid.origin = tilt() * Vec3::Y * grid.material.thickness;
        grid.material.friction = 0.6;
        let mut cloth = Cloth::grid(&grid).unwrap();
        let shape = collider.shape;
        cloth.add_collider(&ColliderDesc { rotation: tilt(), friction, ..collider }).unwrap();
        let is_slippery = |x: Vec3| x.z > 0.121;
        let scales = painted(&cloth, |x| if is_slippery(x) { 0.0 } else { 1.0 });
        cloth.set_map(Map::Friction, Some(&scales)).unwrap();
        // Straight down the slope between two rows, one of each paint.
        let from = Vec3::new(-1.0, 1.0, 0.1355);
        assert!(cloth.cut(from, from + Vec3::X * 3.0, Vec3::NEG_Y * 3.0).unwrap() > 8);
        assert_eq!(cloth.stats().pieces, 2);
        let rest: Vec<Vec3> = cloth.rest_positions().collect();
        let start = cloth.positions().to_vec();
        cloth.step(90);
        let slippery = most_and_least_slid(&cloth, &start, |i| rest[i].z > 0.14);
        let rough = most_and_least_slid(&cloth, &start, |i| rest[i].z < 0.13);
        println!("{shape:?}: {slippery:?} m without friction, {rough:?} m with friction");
        // Without friction: ½ g sin 20° t², with t = 1.5 s, which is 3.8 m; the particles on the cut
        // keep a little friction, as their scales are interpolated.
        assert!(slippery[1] > 1.0 && rough[0] < 1.0e-3, "{shape:?}: {slippery:?} {rough:?}");
    }
}

/// A pinned sheet on a slope, and a smaller one that lies on it one `gap` [m] above.
fn two_sheets(slope: Quat, gap: f32) -> MeshDesc {
    let mut desc = MeshDesc::default();
    desc.settings.self_collision = SelfCollision::Surface;
    desc.settings.damping = 0.0;
    (desc.material.thickness, desc.material.drag) = (0.004, 0.0);
    for (side, height, spacing) in [(16, 0.0, 0.04), (7, gap, 0.03)] {
        let first = desc.positions.len() as u32;
        for i in 0..side * side {
            let [x, z] =
                [i % side, i / side].map(|k| (k as f32 - 0.5 * (side - 1) as f32) * spacing);
            desc.positions.push(slope * Vec3::new(x, height, z));
        }
        for cell in 0..(side - 1) * (side - 1) {
            let a = first + cell / (side - 1) * side + cell % (side - 1);
            desc.indices.extend([a, a + side, a + 1, a + 1, a + side, a + side + 1]);
        }
    }
    desc.pinned = (0..256).collect();
    desc
}

#[test]
fn a_sheet_slides_on_another_sheet_where_both_are_painted_without_friction() {
    for (scale, slides) in [(1.0, false), (0.0, true)] {
        let mut desc = two_sheets(tilt(), 0.004);
        desc.material.friction = 0.6;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        cloth.set_map(Map::Friction, Some(&painted(&cloth, |_| scale))).unwrap();
        let start = cloth.positions().to_vec();
        cloth.step(30);
        let [most, least] = most_and_least_slid(&cloth, &start, |i| i >= 256);
        println!("scale {scale}: slid by {least} to {most} m");
        assert!(if slides { least > 0.1 } else { most < 0.01 }, "{scale}: {least} {most}");
    }
    // Half of the friction, as the mean of both layers: the slope of 20° is between the friction
    // angles of 0.6 and of 0.3.
    let mut desc = two_sheets(tilt(), 0.004);
    desc.material.friction = 0.6;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let scales: Vec<f32> = (0..305).map(|i| if i < 256 { 1.0 } else { 0.0 }).collect();
    cloth.set_map(Map::Friction, Some(&scales)).unwrap();
    let start = cloth.positions().to_vec();
    cloth.step(30);
    let [most, least] = most_and_least_slid(&cloth, &start, |i| i >= 256);
    // a = g (sin 20° − 0.3 cos 20°) for half a second: 7 cm.
    assert!(least > 0.04 && most < 0.1, "slid by {least} to {most} m");
}

#[test]
fn painted_particles_keep_their_thickness_from_colliders() {
    let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.4, ..Default::default() };
    let slab = ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(0.6, 0.2, 0.6),
        ..Default::default()
    };
    for (collider, top) in
        [(ColliderDesc::default(), 0.0), (slab, 0.2), (ball, 0.4), (sphere_mesh(0.4, 24), 0.4)]
    {
        for own in [-1.0, 0.0007] {
            let mut desc = free_sheet(25, 0.5, top + 0.03);
            desc.material.friction = 0.8;
            desc.settings.damping = 2.0;
            let mut cloth = Cloth::grid(&desc).unwrap();
            let collider = ColliderDesc { thickness: own, ..collider.clone() };
            cloth.add_collider(&collider).unwrap();
            let scales = painted(&cloth, |x| if x.x > 0.0 { 20.0 } else { 0.5 });
            cloth.set_map(Map::Thickness, Some(&scales)).unwrap();
            cloth.step(400);
            let gap = if own > 0.0 { own } else { 0.00035 };
            let mut least = [f32::INFINITY; 2];
            for (x, scale) in cloth.positions().iter().zip(&scales) {
                let least = &mut least[usize::from(*scale > 1.0)];
                *least = least.min(signed_distance(&collider, *x));
            }
            let case = format!("{:?} with {own} m: at least {least:?} m", collider.shape);
            println!("{case}");
            assert!(least[1] > 19.0 * gap - 1.0e-4, "{case}");
            assert!(least[0] > 0.4 * gap - 2.0e-5, "{case}");
            if collider.shape == Shape::Plane || collider.shape == Shape::Box {
                assert!(least[0] < 0.6 * gap && least[1] < 21.0 * gap, "{case}");
            }
        }
    }
}

#[test]
fn a_sheet_with_thin_and_thick_stripes_comes_to_rest_on_a_box() {
    let mut desc = free_sheet(25, 0.5, 0.22);
    desc.settings.damping = 2.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let half_extents = Vec3::new(0.15, 0.2, 0.15);
    let collider = ColliderDesc { shape: Shape::Box, half_extents, ..Default::default() };
    cloth.add_collider(&collider).unwrap();
    let stripe = |x: Vec3| [0.0, 8.0][(x.x * 12.0).rem_euclid(2.0) as usize];
    cloth.set_map(Map::Thickness, Some(&painted(&cloth, stripe))).unwrap();
    ticks_until_rest(&mut cloth, 3600);
}

#[test]
fn layers_keep_the_mean_thickness_of_both_sides() {
    for (lower, upper) in [(1.0, 1.0), (3.0, 1.0), (0.0, 1.0), (0.5, 0.5)] {
        let gap = 0.004 * 0.5 * (lower + upper);
        let desc = two_sheets(Quat::IDENTITY, gap + 0.002);
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let scales: Vec<f32> = (0..305).map(|i| if i < 256 { lower } else { upper }).collect();
        cloth.set_map(Map::Thickness, Some(&scales)).unwrap();
        cloth.step(400);
        let above = cloth.positions()[256..].iter().map(|x| x.y);
        let (low, mean) = (above.clone().fold(f32::INFINITY, f32::min), above.sum::<f32>() / 49.0);
        println!("{lower} and {upper}: {low} m at least, {mean} m on average, gap {gap} m");
        assert!((mean - gap).abs() < 0.1 * gap && low > 0.8 * gap, "{lower} {upper}: {low} {mean}");
        assert!(rms_speed(&cloth) < 0.01);
    }
}

#[test]
fn a_new_thickness_between_layers_takes_effect_while_they_rest() {
    let mut cloth = Cloth::mesh(&two_sheets(Quat::IDENTITY, 0.004)).unwrap();
    cloth.step(120);
    let height = |cloth: &Cloth| cloth.positions()[256..].iter().map(|x| x.y).sum::<f32>() / 49.0;
    for scale in [3.0, 1.0, 0.5] {
        cloth.set_map(Map::Thickness, Some(&[scale; 305])).unwrap();
        cloth.step(240);
        let found = height(&cloth);
        assert!((found - 0.004 * scale).abs() < 0.0004 * scale, "scale {scale}: {found} m");
    }
    cloth.set_map(Map::Thickness, None).unwrap();
    cloth.step(240);
    assert!((height(&cloth) - 0.004).abs() < 0.0004, "{} m", height(&cloth));
}

#[test]
fn balls_of_particle_collision_keep_the_mean_thickness_of_a_pair() {
    // Two triangles that point at each other across a gap of 3 cm; 0 and 3 are their tips.
    for (a, b) in [(1.0, 1.0), (0.4, 0.4), (2.0, 0.0), (1.5, 1.1)] {
        let corner = |tip: f32, out: f32, side: f32| Vec3::new(tip - 0.1 * out, 0.1 * side, 0.0);
        let triangle =
            |tip: f32, out: f32| [Vec3::X * tip, corner(tip, out, 0.5), corner(tip, out, -0.5)];
        let mut desc = MeshDesc {
            positions: [triangle(0.0, 1.0), triangle(0.03, -1.0)].concat(),
            indices: (0..6).collect(),
            ..MeshDesc::default()
        };
        (desc.settings.gravity, desc.settings.substeps) = (Vec3::ZERO, 1);
        desc.settings.self_collision = SelfCollision::Particles;
        desc.settings.self_distance = 0.05;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        cloth.set_map(Map::Thickness, Some(&[a, 1.0, 1.0, b, 1.0, 1.0])).unwrap();
        cloth.step(1);
        let found = cloth.positions()[3].x - cloth.positions()[0].x;
        // A substep removes eight tenths of the overlap.
        let overlap = (0.05 * 0.5 * (a + b) - 0.03).max(0.0);
        let exact = 0.03 + 0.8 * overlap;
        assert!((found - exact).abs() < 1.0e-6, "{a} and {b}: {found} m, not {exact} m");
    }
}
