//! What gives way where guarantees contradict each other is counted and reported by one event.

use muslin::glam::{Quat, Vec3};
use muslin::{
    Cloth, Collider, ColliderDesc, Event, EventKind, GridDesc, MeshDesc, PinMode, SelfCollision,
    Shape, Stats,
};

/// Reads the events of one kind.
fn events_of(cloth: &mut Cloth, kind: EventKind) -> Vec<Event> {
    let all = core::iter::from_fn(|| cloth.next_event());
    all.filter(|event| event.kind == kind).collect()
}

/// A sheet of 8 x 8 that hangs from its top edge above and beside everything at the origin.
fn hung_sheet() -> Cloth {
    let origin = Vec3::new(-0.2, 1.0, 0.0);
    let desc = GridDesc { columns: 8, rows: 8, origin, ..GridDesc::default() };
    Cloth::grid(&desc).unwrap()
}

/// A body of each solid shape. All but the plane reach 0.3 m from their center, the capsule 0.4 m
/// up.
fn solids() -> Vec<ColliderDesc> {
    let corners = (0..8).map(|i| {
        let sign = |bit: u32| if i >> bit & 1 == 0 { -0.3 } else { 0.3 };
        Vec3::new(sign(0), sign(1), sign(2))
    });
    let body = |shape| ColliderDesc {
        shape,
        radius: 0.3,
        half_height: 0.1,
        half_extents: Vec3::splat(0.3),
        ..ColliderDesc::default()
    };
    let hull = ColliderDesc { positions: corners.collect(), ..body(Shape::Convex) };
    vec![body(Shape::Plane), body(Shape::Sphere), body(Shape::Capsule), body(Shape::Box), hull]
}

#[test]
fn a_pin_inside_a_collider_is_counted_and_reported_once_each_time() {
    for desc in solids() {
        let (mut cloth, name) = (hung_sheet(), desc.shape);
        let desc = ColliderDesc { position: Vec3::Y * -0.5, ..desc };
        cloth.add_collider(&desc).unwrap();
        cloth.pin(63, None).unwrap();
        let outside = cloth.position(63).unwrap();
        let inside = Vec3::new(0.02, -0.55, 0.01);
        for visit in 0..2 {
            cloth.set_pin_targets(&[63], &[inside]).unwrap();
            cloth.step(3);
            assert_eq!(cloth.stats().held_inside, 1, "{name:?}, visit {visit}");
            let events = events_of(&mut cloth, EventKind::HeldInside);
            assert_eq!(events.len(), 1, "{name:?}, visit {visit}: {events:?}");
            assert_eq!((events[0].particle_a, events[0].count), (63, 1), "{name:?}");
            assert!((events[0].position - inside).length() < 1.0e-4, "{name:?}: {events:?}");
            // A save keeps in mind what was reported.
            cloth = Cloth::restore(&cloth.save()).unwrap();
            assert_eq!(cloth.stats().held_inside, 1, "{name:?}");
            cloth.step(1);
            assert_eq!(events_of(&mut cloth, EventKind::HeldInside), [], "{name:?}");
            cloth.set_pin_targets(&[63], &[outside]).unwrap();
            cloth.step(1);
            assert_eq!(cloth.stats().held_inside, 0, "{name:?}");
        }
    }
}

#[test]
fn a_pin_below_a_heightfield_is_reported() {
    let mut cloth = hung_sheet();
    let mut heights = vec![0.0; 9];
    heights[8] = -1.0;
    let desc = ColliderDesc {
        shape: Shape::Heightfield,
        position: Vec3::new(-1.0, -0.5, -1.0),
        columns: 3,
        rows: 3,
        spacing: 1.0,
        heights,
        ..ColliderDesc::default()
    };
    cloth.add_collider(&desc).unwrap();
    cloth.pin(63, Some(Vec3::new(-0.4, -0.6, -0.4))).unwrap();
    cloth.step(1);
    assert_eq!(cloth.stats().held_inside, 1);
}

/// Returns a free sheet between two plates with a gap of 2 cm, and the upper plate.
fn pressed_sheet() -> (Cloth, Collider) {
    let mut desc = GridDesc {
        columns: 12,
        rows: 12,
        spacing: 0.03,
        origin: Vec3::new(-0.165, 0.0, -0.165),
        down: Vec3::Z,
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.gravity = Vec3::ZERO;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let mut plate = |y: f32| {
        let desc = ColliderDesc {
            shape: Shape::Box,
            position: Vec3::Y * y,
            half_extents: Vec3::new(0.3, 0.05, 0.3),
            ..ColliderDesc::default()
        };
        cloth.add_collider(&desc).unwrap()
    };
    plate(-0.06);
    let upper = plate(0.06);
    (cloth, upper)
}

#[test]
fn cloth_that_two_colliders_leave_no_room_is_reported() {
    let (mut cloth, upper) = pressed_sheet();
    cloth.step(10);
    assert_eq!((cloth.stats().free_inside, cloth.stats().held_inside), (0, 0));
    for tick in 1..=20 {
        let y = 0.06 - 0.0012 * tick as f32;
        cloth.move_collider(upper, Vec3::Y * y, Quat::IDENTITY).unwrap();
        cloth.step(1);
    }
    assert!(cloth.stats().free_inside > 100, "{:?}", cloth.stats());
    let events = events_of(&mut cloth, EventKind::FreeInside);
    assert_eq!(events.len(), 1, "{events:?}");
    cloth.move_collider(upper, Vec3::Y * 0.2, Quat::IDENTITY).unwrap();
    cloth.step(120);
    assert_eq!(cloth.stats().free_inside, 0);
}

#[test]
fn ordinary_contact_is_not_reported() {
    for body in solids() {
        let name = body.shape;
        let mut desc = GridDesc {
            columns: 20,
            rows: 20,
            origin: Vec3::new(-0.475, 0.02, -0.475),
            down: Vec3::Z,
            pin_mode: PinMode::None,
            ..GridDesc::default()
        };
        desc.settings.self_collision = SelfCollision::Surface;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let top = match name {
            Shape::Plane => 0.0,
            Shape::Capsule => 0.4,
            _ => 0.3,
        };
        cloth.add_collider(&ColliderDesc { position: Vec3::Y * -top, ..body }).unwrap();
        for tick in 0..90 {
            cloth.step(1);
            let Stats { held_inside, free_inside, crossings, .. } = cloth.stats();
            let found = (held_inside, free_inside, crossings);
            assert_eq!(found, (0, 0, 0), "{name:?}, tick {tick}");
        }
        assert_eq!(cloth.next_event(), None, "{name:?}");
    }
}

/// Two sheets of one cloth, all pinned, 5 cm apart along z; the second one is smaller.
fn pinned_sheets() -> (Cloth, Vec<u32>, Vec<Vec3>) {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for (count, spacing, z) in [(5_u32, 0.1, 0.0), (4, 0.07, 0.05)] {
        let first = positions.len() as u32;
        for row in 0..count {
            for column in 0..count {
                let at = |i: u32| (i as f32 - 0.5 * (count - 1) as f32) * spacing;
                positions.push(Vec3::new(at(column), at(row), z));
            }
        }
        for row in 0..count - 1 {
            for column in 0..count - 1 {
                let a = first + row * count + column;
                indices.extend([a, a + 1, a + count, a + 1, a + count + 1, a + count]);
            }
        }
    }
    let mut desc = MeshDesc { positions, indices, ..MeshDesc::default() };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let particles: Vec<u32> = (0..cloth.particle_count()).collect();
    for particle in &particles {
        cloth.pin(*particle, None).unwrap();
    }
    let targets = particles.iter().map(|i| cloth.position(*i).unwrap()).collect();
    (cloth, particles, targets)
}

#[test]
fn layers_that_pins_force_through_each_other_are_reported() {
    let (mut cloth, particles, mut targets) = pinned_sheets();
    cloth.step(20);
    assert_eq!(cloth.stats().crossings, 0);
    assert_eq!(events_of(&mut cloth, EventKind::LayersCross), []);
    // One corner of the small sheet goes through the large one.
    targets[25].z -= 0.1;
    cloth.set_pin_targets(&particles, &targets).unwrap();
    let mut ticks = 0;
    while cloth.stats().crossings == 0 {
        cloth.step(1);
        ticks += 1;
        assert!(ticks <= 17, "not found");
    }
    cloth.step(5);
    let events = events_of(&mut cloth, EventKind::LayersCross);
    assert_eq!(events.len(), 1, "{events:?}");
    assert!(events[0].count > 0 && events[0].particle_a < 41 && events[0].particle_b < 41);
    targets[25].z += 0.1;
    cloth.set_pin_targets(&particles, &targets).unwrap();
    cloth.step(3);
    assert_eq!(cloth.stats().crossings, 0);
}
