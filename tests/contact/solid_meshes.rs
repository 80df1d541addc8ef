//! Mesh colliders with an inside, which push out particles that are there.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, PinMode, Settings, Shape};

const RADIUS: f32 = 0.2;

/// A ball of 14 x 20 faces around the origin, closed and wound outward.
fn ball() -> ColliderDesc {
    let (rings, around) = (14, 20);
    let mut positions = vec![Vec3::Y * RADIUS];
    for ring in 1..rings {
        let (sine, cosine) = (ring as f32 / rings as f32 * std::f32::consts::PI).sin_cos();
        for k in 0..around {
            let turn = Quat::from_rotation_y(k as f32 / around as f32 * std::f32::consts::TAU);
            positions.push(turn * Vec3::new(sine, cosine, 0.0) * RADIUS);
        }
    }
    positions.push(Vec3::NEG_Y * RADIUS);
    let last = positions.len() as u32 - 1;
    let at = |ring: u32, k: u32| match ring {
        0 => 0,
        _ if ring == rings => last,
        _ => 1 + (ring - 1) * around + k % around,
    };
    let mut indices = Vec::new();
    for (ring, k) in (0..rings).flat_map(|ring| (0..around).map(move |k| (ring, k))) {
        let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)];
        if a != b {
            indices.extend([a, c, b]);
        }
        if c != d {
            indices.extend([b, c, d]);
        }
    }
    ColliderDesc { shape: Shape::Mesh, positions, indices, ..ColliderDesc::default() }
}

/// A weightless, upright sheet of 15 x 15 particles at this distance from the ball's center.
fn sheet(distance: f32) -> Cloth {
    let desc = GridDesc {
        columns: 15,
        rows: 15,
        spacing: 0.02,
        origin: Vec3::new(-0.14, 0.14, distance),
        pin_mode: PinMode::None,
        settings: Settings { gravity: Vec3::ZERO, ..Settings::default() },
        ..GridDesc::default()
    };
    Cloth::grid(&desc).unwrap()
}

/// The number of particles within the ball around `center`, whose faces lie within its radius.
fn count_inside(cloth: &Cloth, center: Vec3) -> usize {
    cloth.positions().iter().filter(|x| x.distance(center) < RADIUS * 0.97).count()
}

#[test]
fn cloth_that_starts_inside_comes_out_whichever_way_the_mesh_is_wound() {
    let outward = ball();
    let mut inward = outward.clone();
    inward.indices.chunks_mut(3).for_each(|triangle| triangle.swap(0, 1));
    for body in [outward, inward] {
        let mut cloth = sheet(0.165);
        let two_sided = cloth.add_collider(&body).unwrap();
        let before = count_inside(&cloth, Vec3::ZERO);
        assert!(before > 20, "{before} inside");
        cloth.step(60);
        // Cloth within the gap of the surface is pushed away from it, in either direction.
        assert!(count_inside(&cloth, Vec3::ZERO) > 10 && cloth.stats().free_inside == 0);
        cloth.remove_collider(two_sided).unwrap();
        cloth.reset();
        cloth.add_collider(&ColliderDesc { solid: 0.1, ..body }).unwrap();
        cloth.step(1);
        assert!(cloth.stats().free_inside > 10);
        cloth.step(179);
        assert_eq!((count_inside(&cloth, Vec3::ZERO), cloth.stats().free_inside), (0, 0));
        assert!(cloth.stats().max_speed < 0.1, "{} m/s", cloth.stats().max_speed);
        let middle = cloth.positions()[112];
        assert!(middle.z > RADIUS * 0.97, "the middle is at {middle}");
    }
}

#[test]
fn what_is_deeper_than_the_depth_stays_inside() {
    let desc = GridDesc {
        columns: 15,
        rows: 15,
        spacing: 0.01,
        origin: Vec3::new(-0.07, 0.07, 0.05),
        pin_mode: PinMode::None,
        settings: Settings { gravity: Vec3::ZERO, ..Settings::default() },
        ..GridDesc::default()
    };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&ColliderDesc { solid: 0.05, ..ball() }).unwrap();
    let before = cloth.positions().to_vec();
    cloth.step(30);
    let moved = cloth.positions().iter().zip(&before).map(|(a, b)| a.distance(*b));
    let farthest = moved.fold(0.0, f32::max);
    assert!(farthest < 1.0e-4, "moved {farthest} m");
    assert_eq!((count_inside(&cloth, Vec3::ZERO), cloth.stats().free_inside), (225, 0));
}

#[test]
fn a_solid_mesh_that_nothing_is_inside_gives_the_bits_of_one_with_two_sides() {
    let fall = |solid: f32| {
        let mut cloth = sheet(0.21);
        let settings = Settings { gravity: Vec3::NEG_Z * 9.81, ..Settings::default() };
        cloth.set_settings(settings).unwrap();
        cloth.add_collider(&ColliderDesc { solid, ..ball() }).unwrap();
        cloth.step(60);
        cloth.positions().to_vec()
    };
    assert_eq!(fall(0.1), fall(0.0));
}

#[test]
fn a_solid_mesh_that_moved_and_deformed_pushes_out_where_it_is() {
    let mut cloth = sheet(0.3);
    let body = ColliderDesc { solid: 0.1, position: Vec3::NEG_Z, ..ball() };
    let collider = cloth.add_collider(&body).unwrap();
    let squeezed: Vec<Vec3> =
        body.positions.iter().map(|x| *x * Vec3::new(1.0, 1.0, 0.9)).collect();
    cloth.update_collider(collider, &squeezed).unwrap();
    cloth.step(2);
    let center = Vec3::Z * (0.3 - 0.9 * 0.165);
    let turn = Quat::from_rotation_z(1.0);
    cloth.teleport_collider(collider, center, turn).unwrap();
    let is_inside = |x: &Vec3| ((*x - center) / Vec3::new(1.0, 1.0, 0.9)).length() < RADIUS * 0.97;
    let count = |cloth: &Cloth| cloth.positions().iter().filter(|x| is_inside(x)).count();
    assert!(count(&cloth) > 20);
    cloth.step(5);
    assert!(cloth.stats().free_inside > 10);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut cloth, &mut restored] {
        cloth.step(175);
        assert_eq!(count(cloth), 0);
    }
    assert_eq!(restored.state_hash(), cloth.state_hash());
}

#[test]
fn a_mesh_without_an_inside_cannot_be_solid() {
    let mut cloth = sheet(0.5);
    let before = cloth.state_hash();
    let mut refused = |body: &ColliderDesc, must: &'static str| {
        let error = cloth.add_collider(body).unwrap_err();
        assert_eq!(error, Error::BadValue { field: "collider.solid", must });
        assert_eq!(cloth.state_hash(), before);
    };
    for solid in [-1.0, 1.0e6, f32::NAN, f32::INFINITY] {
        refused(&ColliderDesc { solid, ..ball() }, "be at least 0 and below 1e6");
    }
    let whole = "be 0 unless the mesh is closed and consistently wound";
    let mut open = ColliderDesc { solid: 0.1, ..ball() };
    open.indices.truncate(open.indices.len() - 3);
    refused(&open, whole);
    let mut mixed = ColliderDesc { solid: 0.1, ..ball() };
    mixed.indices.swap(0, 1);
    refused(&mixed, whole);
    let mut twice = ColliderDesc { solid: 0.1, ..ball() };
    twice.indices.extend_from_within(0..3);
    refused(&twice, whole);
}
