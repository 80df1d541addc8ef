//! Friction, restitution, rest gap, impulses on colliders, and refused collider descriptors.

use crate::common::shapes::{
    free_sheet, hilly_heightfield, octahedron, sphere_mesh, ticks_until_rest,
};
use crate::common::{bare_grid, rms_speed};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, PinMode, Settings, Shape};

/// A sheet that lies flat on the top of a shape tilted by `degrees`.
fn sheet_on_slope(
    degrees: f32,
    desc: &ColliderDesc,
    top: f32,
    settings: &Settings,
    nodes: u32,
) -> Cloth {
    let angle = degrees.to_radians();
    let rotation = Quat::from_rotation_z(-angle);
    let desc = ColliderDesc { rotation, ..desc.clone() };
    let spacing = 0.25 / (nodes - 1) as f32;
    let mut grid: GridDesc = bare_grid(nodes, nodes, spacing, PinMode::None);
    grid.settings = settings.clone();
    grid.right = rotation * Vec3::X;
    grid.down = Vec3::Z;
    let up = rotation * Vec3::Y;
    grid.origin = up * (top + grid.material.thickness) - grid.right * 0.125 - grid.down * 0.125;
    let mut cloth = Cloth::grid(&grid).unwrap();
    cloth.add_collider(&desc).unwrap();
    cloth
}

/// Settings with different ticks, substeps and iterations.
fn settings_variants() -> Vec<Settings> {
    let bare = Settings { damping: 0.0, ..Settings::default() };
    vec![
        bare.clone(),
        Settings { substeps: 8, iterations: 1, ..bare.clone() },
        Settings { substeps: 1, iterations: 8, tick: 1.0 / 240.0, ..bare.clone() },
        Settings { tick: 1.0 / 30.0, substeps: 10, iterations: 3, ..bare },
    ]
}

/// Colliders with a flat top, each with the height of its top [m].
fn flat_colliders() -> Vec<(f32, ColliderDesc)> {
    let wide = Vec3::new(20.0, 0.5, 20.0);
    let flat = ColliderDesc {
        shape: Shape::Mesh,
        positions: [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
            .map(|(x, z)| Vec3::new(20.0 * x, 0.0, 20.0 * z))
            .to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Default::default()
    };
    vec![
        (0.0, ColliderDesc::default()),
        (0.5, ColliderDesc { shape: Shape::Box, half_extents: wide, ..Default::default() }),
        (0.0, flat),
    ]
}

#[test]
fn a_sheet_slides_exactly_when_the_slope_exceeds_the_friction_angle() {
    for settings in settings_variants() {
        for friction in [0.1_f32, 0.3, 0.6, 1.0] {
            for (top, desc) in flat_colliders() {
                let desc = ColliderDesc { friction, ..desc };
                for (step, slides) in [(-0.5, false), (0.5, true)] {
                    let degrees = friction.atan().to_degrees() + step;
                    let mut cloth = sheet_on_slope(degrees, &desc, top, &settings, 6);
                    let start = cloth.positions()[14];
                    let ticks = (5.0 / settings.tick).round() as u32;
                    cloth.step(ticks);
                    let slid = (cloth.positions()[14] - start).length();
                    let case = format!("{:?}, µ {friction} at {degrees}°: {slid} m", desc.shape);
                    assert!(slid < 1.0e-3 || slides, "creeps: {case} in {settings:?}");
                    assert!(slid > 0.1 || !slides, "sticks: {case} in {settings:?}");
                }
            }
        }
    }
}

#[test]
fn a_sliding_sheet_obeys_coulomb_friction() {
    for settings in settings_variants() {
        for nodes in [6, 12] {
            for (top, desc) in flat_colliders() {
                let desc = ColliderDesc { friction: 0.3, ..desc };
                let mut cloth = sheet_on_slope(30.0, &desc, top, &settings, nodes);
                let start = cloth.positions()[7];
                let ticks = (1.0 / settings.tick).round() as u32;
                cloth.step(ticks);
                let slid = (cloth.positions()[7] - start).length();
                let exact = 0.5 * 9.81 * (0.5 - 0.3 * 0.75_f32.sqrt());
                let case = format!("{:?}, {nodes} nodes, {settings:?}", desc.shape);
                assert!((slid / exact - 1.0).abs() < 0.03, "{slid} of {exact} m: {case}");

                let mut cloth = sheet_on_slope(0.0, &desc, top, &settings, nodes);
                let start = cloth.positions()[7];
                let count = cloth.positions().len() as u32;
                (0..count).for_each(|i| cloth.set_velocity(i, Vec3::X * 2.0).unwrap());
                cloth.step(2 * ticks);
                let slid = (cloth.positions()[7] - start).length();
                let exact = 4.0 / (2.0 * 0.3 * 9.81);
                assert!((slid / exact - 1.0).abs() < 0.05, "{slid} of {exact} m: {case}");
            }
        }
    }
}

#[test]
fn a_sheet_rebounds_to_the_height_given_by_restitution() {
    for settings in settings_variants() {
        for (restitution, (top, desc)) in [0.0, 0.5]
            .into_iter()
            .flat_map(|e| flat_colliders().into_iter().map(move |collider| (e, collider)))
        {
            let desc = ColliderDesc { restitution, ..desc };
            let mut grid = free_sheet(8, 0.35, top + 0.5);
            grid.origin.y += grid.material.thickness;
            grid.settings = settings.clone();
            let mut cloth = Cloth::grid(&grid).unwrap();
            cloth.add_collider(&desc).unwrap();
            let (mut rebound, mut has_hit) = (0.0_f32, false);
            for _ in 0..(0.9 / settings.tick) as u32 {
                cloth.step(1);
                has_hit |=
                    cloth.velocity(27).unwrap().y > -0.5 && cloth.positions()[27].y < top + 0.1;
                if has_hit {
                    rebound = rebound.max(cloth.positions()[27].y - top);
                }
            }
            let exact = restitution * restitution * 0.5;
            let case = format!("{:?}, e {restitution}: {rebound} m, exact {exact} m", desc.shape);
            assert!((rebound - exact).abs() < 0.02 * 0.5, "{case} in {settings:?}");
        }
    }
}

#[test]
fn tangential_and_normal_restitution_scale_the_velocity_after_an_impact() {
    // Without gravity the velocity stays in the substeps after the impact.
    let gravity = Vec3::ZERO;
    let settings =
        Settings { substeps: 1, iterations: 1, damping: 0.0, gravity, ..Settings::default() };
    let floor = ColliderDesc {
        friction: 0.0,
        restitution: 0.2,
        tangential_restitution: 0.8,
        ..Default::default()
    };
    let mut cloth = sheet_on_slope(0.0, &floor, 0.0, &settings, 6);
    (0..36).for_each(|i| cloth.set_velocity(i, Vec3::new(2.0, -3.0, 0.0)).unwrap());
    cloth.step(1);
    let after = cloth.velocity(14).unwrap();
    let exact = Vec3::new(1.6, 0.2 * 3.0, 0.0);
    assert!((after - exact).length() < 0.02, "{after}, expected {exact}");
    assert!(cloth.positions().iter().all(|x| x.y >= 0.0), "a particle is below the floor");
}

#[test]
fn a_collider_receives_the_weight_of_a_resting_sheet() {
    let mut all = flat_colliders();
    all.push((0.3, ColliderDesc { shape: Shape::Sphere, radius: 0.3, ..Default::default() }));
    // The tip of the octahedron is under the inside of a triangle.
    all.push((0.3, ColliderDesc { position: Vec3::new(0.004, 0.0, 0.011), ..octahedron(0.3) }));
    all.push((0.3, sphere_mesh(0.3, 6)));
    for (top, desc) in all {
        let mut cloth = Cloth::grid(&free_sheet(16, 0.5, top + 0.01)).unwrap();
        let ground = cloth.add_collider(&desc).unwrap();
        ticks_until_rest(&mut cloth, 2000);
        let weight = 9.81 * crate::common::total_mass(&cloth) as f32;
        let mut mean = Vec3::ZERO;
        for _ in 0..60 {
            cloth.step(1);
            mean += cloth.collider_impulse(ground).unwrap().linear;
        }
        // Sixty ticks are one second, so the summed impulse equals the mean force.
        assert!(
            (mean + Vec3::Y * weight).length() < 0.02 * weight,
            "{:?}: {mean} of {weight} N",
            desc.shape
        );
    }
}

#[test]
fn an_impact_transfers_linear_and_angular_momentum_to_the_collider() {
    let mut grid = free_sheet(8, 0.2, 0.5);
    grid.origin.x += 0.3;
    grid.settings.gravity = Vec3::ZERO;
    grid.settings.damping = 0.0;
    let mut cloth = Cloth::grid(&grid).unwrap();
    let half_extents = Vec3::new(1.0, 0.1, 1.0);
    let desc = ColliderDesc { shape: Shape::Box, half_extents, ..Default::default() };
    let table = cloth.add_collider(&desc).unwrap();
    (0..64).for_each(|i| cloth.set_velocity(i, Vec3::NEG_Y * 2.0).unwrap());
    let (mut linear, mut angular) = (Vec3::ZERO, Vec3::ZERO);
    for _ in 0..30 {
        cloth.step(1);
        let impulse = cloth.collider_impulse(table).unwrap();
        linear += impulse.linear;
        angular += impulse.angular;
    }
    let momentum = 2.0 * crate::common::total_mass(&cloth) as f32;
    assert!((linear + Vec3::Y * momentum).length() < 0.01 * momentum, "{linear}, had {momentum}");
    let turn = Vec3::NEG_Z * 0.3 * momentum;
    assert!((angular - turn).length() < 0.01 * momentum, "{angular}, exact {turn}");
    cloth.step(1);
    let after = cloth.collider_impulse(table).unwrap().linear;
    assert!(after.y.abs() < 0.01 * momentum, "{after}");
    cloth.remove_collider(table).unwrap();
    assert_eq!(cloth.collider_impulse(table), Err(Error::BadHandle { what: "collider" }));
}

#[test]
fn the_gap_at_rest_equals_the_collider_thickness() {
    for thickness in [0.0, 0.002, 0.01] {
        let mut cloth = Cloth::grid(&free_sheet(8, 0.2, 0.05)).unwrap();
        let half_extents = Vec3::new(1.0, 0.1, 1.0);
        let position = Vec3::Y * -0.1;
        let desc = ColliderDesc {
            shape: Shape::Box,
            half_extents,
            position,
            thickness,
            ..Default::default()
        };
        cloth.add_collider(&desc).unwrap();
        cloth.step(300);
        assert!(cloth.positions().iter().all(|x| (x.y - thickness).abs() < 1.0e-5));
    }
}

#[test]
fn particles_that_start_inside_a_collider_are_pushed_out_gently() {
    let cube =
        |half: Vec3| ColliderDesc { shape: Shape::Box, half_extents: half, ..Default::default() };
    let ball = |radius: f32| ColliderDesc { shape: Shape::Sphere, radius, ..Default::default() };
    let shapes = [
        (-0.02, ball(0.3)),
        (-0.02, ball(0.8)),
        (-0.02, ColliderDesc { shape: Shape::Capsule, radius: 0.2, ..Default::default() }),
        (-0.02, cube(Vec3::new(0.5, 0.1, 0.5))),
        (-0.02, cube(Vec3::splat(0.5))),
        (0.3, cube(Vec3::splat(0.5))),
        (-0.02, octahedron(0.4)),
        (0.3, octahedron(0.4)),
        (-0.02, hilly_heightfield(10, 2.0)),
    ];
    for (height, desc) in shapes {
        let mut cloth = Cloth::grid(&free_sheet(21, 0.8, height)).unwrap();
        cloth.add_collider(&desc).unwrap();
        cloth
            .add_collider(&ColliderDesc { position: Vec3::Y * -1.0, ..Default::default() })
            .unwrap();
        let mut fastest = 0.0_f32;
        for _ in 0..900 {
            cloth.step(1);
            fastest = fastest.max(rms_speed(&cloth));
        }
        let (vertex, _) = crate::common::shapes::vertex_and_face_clearance(&cloth, &desc);
        let case = format!("{:?} from {height} m", desc.shape);
        assert!(vertex > 0.0, "{case}: a vertex is still {} m inside", -vertex);
        // The limit leaves room for particles that fall to the floor.
        assert!(fastest < 4.5, "{case}: reached {fastest} m/s");
    }
}

#[test]
fn restored_and_cloned_cloths_keep_all_colliders_and_the_same_bits() {
    let mut cloth = Cloth::grid(&free_sheet(16, 0.9, 0.5)).unwrap();
    let all = [sphere_mesh(0.2, 6), octahedron(0.25), hilly_heightfield(8, 2.0)];
    let handles = all.map(|desc| cloth.add_collider(&desc).unwrap());
    let capsule = ColliderDesc { shape: Shape::Capsule, top_radius: 0.1, ..Default::default() };
    cloth.add_collider(&capsule).unwrap();
    for i in 0..40 {
        cloth.move_collider(handles[0], Vec3::X * 0.01 * i as f32, Quat::IDENTITY).unwrap();
        cloth.step(1);
    }
    cloth.move_collider(handles[1], Vec3::Y * 0.01, Quat::IDENTITY).unwrap();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    assert_eq!(restored.collider_impulse(handles[0]), cloth.collider_impulse(handles[0]));
    let mut copy = cloth.clone();
    for cloth in [&mut cloth, &mut restored, &mut copy] {
        cloth.step(30);
        cloth.move_collider(handles[2], Vec3::new(-1.0, 0.02, -1.0), Quat::IDENTITY).unwrap();
        cloth.step(30);
    }
    assert_eq!(restored.state_hash(), cloth.state_hash());
    assert_eq!(copy.state_hash(), cloth.state_hash());
}

#[test]
fn the_state_hash_depends_on_the_shape_and_thickness_of_a_collider() {
    let hash = |desc: &ColliderDesc| {
        let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
        cloth.add_collider(desc).unwrap();
        cloth.state_hash()
    };
    let one = sphere_mesh(0.2, 6);
    let mut other = one.clone();
    other.positions[9].x += 0.25;
    assert_ne!(hash(&one), hash(&other));
    assert_ne!(hash(&one), hash(&ColliderDesc { thickness: 0.5, ..one.clone() }));
    assert_eq!(hash(&one), hash(&one));
}

#[test]
fn invalid_colliders_are_refused_and_change_nothing() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    let before = cloth.state_hash();
    let shape = |shape| ColliderDesc { shape, ..Default::default() };
    let (ball, capsule, cuboid) = (shape(Shape::Sphere), shape(Shape::Capsule), shape(Shape::Box));
    let (convex, mesh, field) = (octahedron(1.0), sphere_mesh(1.0, 3), hilly_heightfield(3, 1.0));
    let mut bad: Vec<(&str, ColliderDesc)> = Vec::new();
    for radius in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        bad.push(("collider.radius", ColliderDesc { radius, ..ball.clone() }));
        bad.push(("collider.radius", ColliderDesc { radius, ..capsule.clone() }));
        let half_extents = Vec3::new(1.0, radius, 1.0);
        bad.push(("collider.half_extents", ColliderDesc { half_extents, ..cuboid.clone() }));
        bad.push(("collider.spacing", ColliderDesc { spacing: radius, ..field.clone() }));
        if radius != -1.0 {
            bad.push((
                "collider.top_radius",
                ColliderDesc { top_radius: radius, ..capsule.clone() },
            ));
        }
        if radius != 0.0 {
            let half_height = radius;
            bad.push(("collider.half_height", ColliderDesc { half_height, ..capsule.clone() }));
        }
    }
    for thickness in [-0.5, f32::NAN, f32::INFINITY] {
        bad.push(("collider.thickness", ColliderDesc { thickness, ..ball.clone() }));
    }
    let far = Vec3::X * f32::INFINITY;
    let nan = Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0);
    bad.push(("collider.position", ColliderDesc { position: far, ..ball.clone() }));
    bad.push(("collider.rotation", ColliderDesc { rotation: nan, ..ball.clone() }));
    for positions in
        [vec![], vec![Vec3::ZERO; 3], vec![Vec3::ONE; 9], vec![far; 6], vec![Vec3::X; 1025]]
    {
        bad.push(("collider.positions", ColliderDesc { positions, ..convex.clone() }));
    }
    for indices in [vec![], vec![0, 1], vec![0, 1, 2, 3], vec![4, 4, 4, 4, 4, 4]] {
        bad.push(("collider.indices", ColliderDesc { indices, ..mesh.clone() }));
    }
    let count = mesh.positions.len() as u32;
    for indices in [vec![0, 1, count], vec![u32::MAX; 3]] {
        bad.push(("collider.indices", ColliderDesc { indices, ..mesh.clone() }));
    }
    let mut positions = mesh.positions.clone();
    positions[5].y = f32::NAN;
    bad.push(("collider.positions", ColliderDesc { positions, ..mesh }));
    bad.push(("collider.columns", ColliderDesc { columns: 1, ..field.clone() }));
    bad.push(("collider.rows", ColliderDesc { rows: 5000, ..field.clone() }));
    bad.push(("collider.heights", ColliderDesc { rows: 5, ..field.clone() }));
    let mut heights = field.heights.clone();
    heights[2] = f32::NAN;
    bad.push(("collider.heights", ColliderDesc { heights, ..field }));
    for (name, desc) in bad {
        match cloth.add_collider(&desc) {
            Err(Error::BadValue { field, .. } | Error::BadIndex { field, .. }) => {
                assert_eq!(field, name, "{desc:?}");
            }
            other => panic!("{other:?} for a bad {name}: {desc:?}"),
        }
    }
    assert_eq!(cloth.state_hash(), before);
}

#[test]
fn a_cloth_that_is_reset_while_it_pushes_a_collider_moves_like_a_new_one() {
    let mut cloth = Cloth::grid(&free_sheet(8, 0.2, 0.5)).unwrap();
    let half_extents = Vec3::new(1.0, 0.1, 1.0);
    let desc = ColliderDesc { shape: Shape::Box, half_extents, ..Default::default() };
    let table = cloth.add_collider(&desc).unwrap();
    let fall = |cloth: &mut Cloth| {
        (0..8).for_each(|i| cloth.set_velocity(i * 7, Vec3::new(0.5, 0.3, -0.2)).unwrap());
        cloth.step(60);
        cloth.positions().to_vec()
    };
    let new = fall(&mut cloth);
    assert!(cloth.collider_impulse(table).unwrap().linear.y < 0.0);
    cloth.reset();
    assert_eq!(cloth.collider_impulse(table).unwrap().linear, Vec3::ZERO);
    assert_eq!(fall(&mut cloth), new);
}
