//! Invalid input is refused with an error that names the field, and changes nothing.

use muslin::glam::{Quat, Vec2, Vec3};
use muslin::{
    Cloth, ColliderDesc, Error, Grab, GridDesc, Material, MeshDesc, SelfCollision, Settings,
    SewDesc, Wind,
};

/// A field name, and a function that makes this field invalid.
type Invalidation<D> = (&'static str, fn(&mut D));

/// The error message of a call that must fail.
fn error_message<T>(result: Result<T, Error>) -> String {
    match result {
        Ok(_) => panic!("the invalid call was accepted"),
        Err(error) => error.to_string(),
    }
}

/// Asserts that the call fails with a message that names `field`.
fn assert_error_names(result: Result<Cloth, Error>, field: &str) {
    let message = error_message(result);
    assert!(message.contains(&format!("`{field}`")), "`{message}` does not name {field}");
}

#[test]
fn grid_errors_name_the_invalid_field() {
    let cases: &[Invalidation<GridDesc>] = &[
        ("columns", |d| d.columns = 1),
        ("rows", |d| d.rows = 0),
        ("columns", |d| (d.columns, d.rows) = (100_000, 100_000)),
        ("spacing", |d| d.spacing = 0.0),
        ("spacing", |d| d.spacing = f32::NAN),
        ("spacing", |d| d.spacing = 1.0e-7),
        ("spacing", |d| d.spacing = 2.0e6),
        ("origin", |d| d.origin.y = 2.0e5),
        ("origin", |d| d.origin.x = f32::INFINITY),
        ("right", |d| d.right = Vec3::ZERO),
        ("down", |d| d.down = Vec3::X),
        ("extra_particles", |d| d.extra_particles = u32::MAX - 1),
        ("material.density", |d| d.material.density = -1.0),
        ("settings.substeps", |d| d.settings.substeps = 0),
        ("settings.tick", |d| d.settings.tick = f32::NAN),
    ];
    for (field, invalidate) in cases {
        let mut desc = GridDesc::default();
        invalidate(&mut desc);
        assert_error_names(Cloth::grid(&desc), field);
    }
}

#[test]
fn mesh_errors_name_the_invalid_field() {
    let square = || MeshDesc {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0), Vec3::NEG_X],
        indices: vec![0, 1, 2, 1, 3, 2],
        ..MeshDesc::default()
    };
    assert!(Cloth::mesh(&square()).is_ok());
    let cases: &[Invalidation<MeshDesc>] = &[
        ("positions", |d| d.positions.clear()),
        ("positions", |d| d.positions[2].z = f32::NAN),
        ("indices", |d| d.indices.clear()),
        ("indices", |d| d.indices.truncate(4)),
        ("indices", |d| d.indices[4] = 5),
        ("indices", |d| d.indices = vec![1, 0, 0, 0, 4, 1]),
        ("indices", |d| (d.positions[0], d.positions[1]) = (Vec3::MAX, Vec3::MIN)),
        ("weld_distance", |d| d.weld_distance = f32::NAN),
        ("weld_distance", |d| d.weld_distance = f32::INFINITY),
        ("simplify_below", |d| d.simplify_below = f32::NAN),
        ("simplify_below", |d| d.simplify_below = f32::INFINITY),
        ("simplify_below", |d| d.simplify_below = -1.0e-6),
        ("simplify_below", |d| d.simplify_below = 10.0),
        ("pinned", |d| d.pinned = vec![0, 5]),
        ("uvs", |d| d.uvs = vec![Vec2::ZERO; 4]),
    ];
    for (field, invalidate) in cases {
        let mut desc = square();
        invalidate(&mut desc);
        assert_error_names(Cloth::mesh(&desc), field);
    }
}

#[test]
fn errors_of_settings_material_and_wind_name_the_invalid_field() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    let hash = cloth.state_hash();
    let settings: &[Invalidation<Settings>] = &[
        ("settings.tick", |s| s.tick = 0.0),
        ("settings.substeps", |s| s.substeps = 1001),
        ("settings.iterations", |s| s.iterations = 0),
        ("settings.max_ticks_per_advance", |s| s.max_ticks_per_advance = 0),
        ("settings.gravity", |s| s.gravity.y = f32::NAN),
        ("settings.damping", |s| s.damping = -0.1),
        ("settings.max_displacement", |s| s.max_displacement = 0.0),
        ("settings.max_stretch", |s| s.max_stretch = f32::INFINITY),
        ("settings.self_distance", |s| s.self_distance = -0.01),
        ("settings.sleep_speed", |s| s.sleep_speed = -0.01),
        ("settings.pressure", |s| s.pressure = f32::NEG_INFINITY),
        ("settings.self_distance", |s| {
            (s.self_collision, s.self_distance) = (SelfCollision::Particles, 0.1001);
        }),
        ("settings.self_distance", |s| {
            (s.self_collision, s.self_distance) = (SelfCollision::Surface, 0.0251);
        }),
    ];
    for (field, invalidate) in settings {
        let mut changed = cloth.settings().clone();
        invalidate(&mut changed);
        assert!(error_message(cloth.set_settings(changed)).contains(field), "{field}");
    }
    let material: &[Invalidation<Material>] = &[
        ("material.density", |m| m.density = 0.0),
        ("material.thickness", |m| m.thickness = -1.0),
        ("material.shear_stiffness", |m| m.shear_stiffness = f32::NAN),
        ("material.bend_stiffness", |m| m.bend_stiffness = -1.0),
        ("material.friction", |m| m.friction = -0.5),
        ("material.restitution", |m| m.restitution = 1.5),
        ("material.tear_stretch", |m| m.tear_stretch = 0.9),
        ("material.tear_variation", |m| m.tear_variation = 2.0),
        ("material.yield_angle", |m| m.yield_angle = -1.0),
        ("material.yield_creep", |m| m.yield_creep = 1.5),
        ("material.fold_length", |m| m.fold_length = f32::NAN),
        ("material.yield_hardening", |m| m.yield_hardening = -0.5),
        ("material.yield_weakening", |m| m.yield_weakening = f32::INFINITY),
        ("material.bend_damping", |m| m.bend_damping = -0.1),
        ("material.stretch_damping", |m| m.stretch_damping = f32::INFINITY),
    ];
    for (field, invalidate) in material {
        let mut changed = cloth.material().clone();
        invalidate(&mut changed);
        assert!(error_message(cloth.set_material(changed)).contains(field), "{field}");
    }
    let wind: &[Invalidation<Wind>] = &[
        ("wind.velocity", |w| w.velocity.x = f32::NAN),
        ("wind.gust", |w| w.gust = 1.1),
        ("wind.wander", |w| w.wander = -0.1),
        ("wind.turbulence", |w| w.turbulence = f32::NAN),
        ("wind.air_density", |w| w.air_density = -1.0),
    ];
    for (field, invalidate) in wind {
        let mut changed = Wind::default();
        invalidate(&mut changed);
        assert!(error_message(cloth.set_wind(changed)).contains(field), "{field}");
    }
    assert_eq!(cloth.state_hash(), hash);
    assert_eq!(*cloth.settings(), Settings::default());
    assert_eq!(*cloth.material(), Material::default());
    assert_eq!(*cloth.wind(), Wind::default());
}

#[test]
fn refused_calls_name_the_invalid_argument_and_change_nothing() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    let (hash, nan) = (cloth.state_hash(), Vec3::splat(f32::NAN));
    let mut messages = vec![
        ("seconds", error_message(cloth.advance(-1.0))),
        ("seconds", error_message(cloth.advance(f32::INFINITY))),
        ("particle", error_message(cloth.pin(1600, None))),
        ("target", error_message(cloth.pin(5, Some(nan)))),
        ("particle", error_message(cloth.unpin(1600))),
        ("targets", error_message(cloth.set_pin_targets(&[1, 2], &[Vec3::ZERO]))),
        ("particles", error_message(cloth.set_pin_targets(&[50, 9999], &[Vec3::ZERO; 2]))),
        ("targets", error_message(cloth.set_pin_targets(&[50, 51], &[Vec3::ZERO, nan]))),
        ("position", error_message(cloth.set_position(70, nan))),
        ("velocity", error_message(cloth.set_velocity(70, nan))),
        ("direction", error_message(cloth.raycast(Vec3::ZERO, Vec3::ZERO, 1.0))),
        ("origin", error_message(cloth.raycast(nan, Vec3::X, 1.0))),
        ("max_distance", error_message(cloth.raycast(Vec3::ZERO, Vec3::X, -1.0))),
        ("radius", error_message(cloth.grab_ray(Vec3::ZERO, Vec3::X, f32::NAN))),
        ("particle", error_message(cloth.grab_particle(1600))),
        ("particle_a", error_message(cloth.tear_edge(1600, 0))),
        ("particle_b", error_message(cloth.tear_edge(0, 700))),
        ("particle_b", error_message(cloth.tear_edge(7, 7))),
        ("grab", error_message(cloth.move_grab(Grab::from_bits(1 << 16 | 1), Vec3::ZERO))),
    ];
    let invalid = ColliderDesc { restitution: 3.0, ..ColliderDesc::default() };
    messages.push(("collider.restitution", error_message(cloth.add_collider(&invalid))));
    let invalid =
        ColliderDesc { rotation: Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), ..ColliderDesc::default() };
    messages.push(("collider.rotation", error_message(cloth.add_collider(&invalid))));
    for (argument, message) in messages {
        assert!(message.contains(&format!("`{argument}`")), "`{message}` does not name {argument}");
    }
    assert_eq!(cloth.state_hash(), hash);
}

#[test]
fn released_removed_and_reset_handles_are_refused() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    let grab = cloth.grab_particle(100).unwrap();
    cloth.release(grab).unwrap();
    assert_eq!(cloth.release(grab), Err(Error::BadHandle { what: "grab" }));
    let newer = cloth.grab_particle(100).unwrap();
    assert_eq!(cloth.move_grab(grab, Vec3::ZERO), Err(Error::BadHandle { what: "grab" }));
    cloth.reset();
    assert_eq!(cloth.move_grab(newer, Vec3::ZERO), Err(Error::BadHandle { what: "grab" }));
    let floor = cloth.add_collider(&ColliderDesc::default()).unwrap();
    cloth.remove_collider(floor).unwrap();
    let stale = cloth.move_collider(floor, Vec3::ZERO, Quat::IDENTITY);
    assert_eq!(stale, Err(Error::BadHandle { what: "collider" }));
    for _ in 0..64 {
        cloth.grab_particle(100).unwrap();
    }
    assert!(matches!(cloth.grab_particle(100), Err(Error::Full { .. })));
}

#[test]
fn a_save_with_any_damaged_byte_is_refused() {
    let mut desc = GridDesc { columns: 6, rows: 6, ..GridDesc::default() };
    desc.settings.tearing = true;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(5);
    cloth.tear_edge(14, 20).unwrap();
    let saved = cloth.save();
    assert!(Cloth::restore(&saved).is_ok());
    for at in 0..saved.len() {
        let mut damaged = saved.clone();
        damaged[at] ^= 0x41;
        assert!(matches!(Cloth::restore(&damaged), Err(Error::BadSave { .. })), "byte {at}");
    }
    for length in [0, 5, 19, 20, saved.len() - 1] {
        assert!(Cloth::restore(&saved[..length]).is_err(), "{length} bytes");
    }
}

#[test]
fn wrong_pairs_and_sewing_options_are_refused_and_change_nothing() {
    let desc = MeshDesc {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(9.0)],
        indices: vec![0, 1, 2],
        ..MeshDesc::default()
    };
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let (hash, last) = (cloth.state_hash(), cloth.particle_count() - 1);
    for (pairs, rule) in [
        ([[0, 1], [1, last + 1]], "`pairs[1]` must name particles of the cloth"),
        ([[0, 1], [2, 2]], "`pairs[1]` must name two different particles"),
        ([[0, last], [1, 2]], "`pairs[0]` must name particles that have a triangle"),
    ] {
        assert_eq!(error_message(cloth.sew(&pairs, &SewDesc::default())), rule);
    }
    for (field, desc) in [
        ("`speed`", SewDesc { speed: 0.0, ..SewDesc::default() }),
        ("`speed`", SewDesc { speed: f32::INFINITY, ..SewDesc::default() }),
        ("`tear_force`", SewDesc { tear_force: -1.0, ..SewDesc::default() }),
        ("`tear_force`", SewDesc { tear_force: f32::NAN, ..SewDesc::default() }),
    ] {
        assert!(error_message(cloth.sew(&[[0, 1]], &desc)).contains(field), "{field}");
    }
    cloth.sew(&[], &SewDesc::default()).unwrap();
    assert_eq!(cloth.state_hash(), hash);
}
