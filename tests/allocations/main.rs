//! After creation, stepping, tearing within the reserve and reading allocate no memory.

use muslin::glam::{Quat, Vec2, Vec3};
use muslin::{
    Attribute, Cloth, ColliderDesc, EventKind, GridDesc, Map, Material, MeshDesc, PinMode, Preset,
    SelfCollision, SewDesc, SewKind, Shape, Skin, Stream, VertexFormat, Wind, WriteDesc,
};
use std::cell::Cell;

#[path = "../common/mod.rs"]
mod common;
mod counting_allocator;
mod crowds;
mod layers;
mod memory;

use counting_allocator::allocation_count;

/// Drags a particle with a grab until edges tear, releases and unpins the cloth, and reads from it.
fn exercise(cloth: &mut Cloth, particle: u32) {
    let grab = cloth.grab_particle(particle).unwrap();
    let from = cloth.positions()[particle as usize];
    for tick in 1..=90 {
        cloth.move_grab(grab, from + Vec3::new(0.03, 0.0, 0.05) * tick as f32).unwrap();
        cloth.advance(1.0 / 60.0).unwrap();
        let view = cloth.view();
        assert_eq!(view.positions.len(), view.normals.len());
        while cloth.next_event().is_some() {}
    }
    cloth.release(grab).unwrap();
    cloth.set_position(particle, from).unwrap();
    cloth.pin(particle, None).unwrap();
    cloth.step(5);
    cloth.unpin_all();
    cloth.step(30);
    cloth.raycast(Vec3::new(0.5, -0.5, 3.0), Vec3::NEG_Z, 9.0).unwrap();
    assert!(cloth.stats().kinetic_energy >= 0.0 && cloth.state_hash() != 0);
}

/// Exercises a cloth and returns the number of allocations, except those of the first ray, which
/// builds the tree of rays.
fn exercise_after_a_ray(cloth: &mut Cloth, particle: u32) -> u32 {
    cloth.raycast(Vec3::ZERO, Vec3::NEG_Z, 9.0).unwrap();
    allocation_count(|| exercise(cloth, particle))
}

/// Asserts that a cloth, its clone and its restored copy allocate nothing while they are exercised.
fn assert_allocates_nothing(mut cloth: Cloth, particle: u32) {
    let before = cloth.positions().len();
    cloth.set_wind(Wind { velocity: Vec3::Z, turbulence: 0.5, ..Wind::default() }).unwrap();
    let floor = ColliderDesc { position: Vec3::new(0.0, -3.0, 0.0), ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    let mut copy = cloth.clone();
    for cloth in [&mut cloth, &mut copy] {
        assert_eq!(exercise_after_a_ray(cloth, particle), 0);
        assert!(cloth.positions().len() > before, "nothing tore");
    }
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    assert_eq!(exercise_after_a_ray(&mut restored, particle), 0);
}

#[test]
fn a_grid_allocates_nothing_after_creation() {
    let mut desc = GridDesc { columns: 20, rows: 20, ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    assert_allocates_nothing(Cloth::grid(&desc).unwrap(), 230);
}

#[test]
fn a_mesh_allocates_nothing_after_creation() {
    let mut desc: MeshDesc = common::irregular_mesh();
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    assert_allocates_nothing(Cloth::mesh(&desc).unwrap(), 20);
}

/// A ball that bursts when a grab pulls at it, sewn and stitched to a strip.
#[test]
fn pressure_and_sewn_pairs_allocate_nothing() {
    let mut desc: MeshDesc = common::skins::icosphere(2);
    desc.positions.iter_mut().for_each(|x| *x *= 0.3);
    let ball = desc.positions.len() as u32;
    for i in 0..8 {
        desc.positions.extend([0.0, 0.1].map(|z| Vec3::new(0.5, 0.1 * i as f32, z)));
        let at = ball + 2 * i;
        desc.indices.extend(if i < 7 {
            vec![at, at + 1, at + 2, at + 2, at + 1, at + 3]
        } else {
            vec![]
        });
    }
    (desc.settings.tearing, desc.settings.pressure) = (true, 100.0);
    (desc.settings.max_stretch, desc.material.tear_stretch) = (0.1, 1.3);
    for self_collision in [SelfCollision::None, SelfCollision::Particles] {
        desc.settings.self_collision = self_collision;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let pairs: Vec<[u32; 2]> = (0..6).map(|i| [i, ball + 2 * i]).collect();
        let stitch = SewDesc { kind: SewKind::Stitch, tear_force: 0.5, speed: 1.0 };
        cloth.sew(&pairs[..4], &SewDesc::default()).unwrap();
        cloth.sew(&pairs[4..], &stitch).unwrap();
        let mut copies = [cloth.clone(), Cloth::restore(&cloth.save()).unwrap(), cloth];
        for cloth in &mut copies {
            let grab = cloth.grab_particle(20).unwrap();
            let count = allocation_count(|| {
                for tick in 0..120 {
                    cloth.move_grab(grab, Vec3::new(0.02 * tick as f32, 0.0, 1.0)).unwrap();
                    cloth.step(1);
                }
            });
            assert_eq!(count, 0, "{self_collision:?}");
            assert!(cloth.particle_count() > 178, "nothing tore");
            let events = core::iter::from_fn(|| cloth.next_event());
            assert!(events.into_iter().any(|event| event.kind == EventKind::StitchTorn));
        }
    }
}

#[test]
fn painted_cloths_allocate_nothing_and_their_tears_extend_the_maps() {
    for self_collision in [SelfCollision::None, SelfCollision::Particles] {
        let mut grid = GridDesc { columns: 20, rows: 20, ..GridDesc::default() };
        let mut mesh: MeshDesc = common::irregular_mesh();
        for (material, settings) in
            [(&mut grid.material, &mut grid.settings), (&mut mesh.material, &mut mesh.settings)]
        {
            (settings.tearing, settings.self_collision) = (true, self_collision);
            *material = Material { tear_stretch: 1.2, ..Material::preset(Preset::Cotton) };
        }
        for (mut cloth, particle) in
            [(Cloth::grid(&grid).unwrap(), 230), (Cloth::mesh(&mesh).unwrap(), 20)]
        {
            paint(&mut cloth);
            assert_allocates_nothing(cloth, particle);
        }
    }
    let mut cloth = standing_sheet(SelfCollision::Surface);
    paint(&mut cloth);
    assert_eq!(allocation_count(|| cloth.step(90)), 0);
}

/// Sets all maps to scales about 1.
fn paint(cloth: &mut Cloth) {
    let scale = |i: u32| 0.75 + (i % 5) as f32 * 0.125;
    let scales: Vec<f32> = (0..cloth.particle_count()).map(scale).collect();
    Map::ALL.into_iter().for_each(|map| cloth.set_map(map, Some(&scales)).unwrap());
}

#[test]
fn hardening_folds_allocate_nothing() {
    let mut grid = GridDesc { columns: 20, rows: 20, ..GridDesc::default() };
    let mut mesh: MeshDesc = common::irregular_mesh();
    for (material, settings) in
        [(&mut grid.material, &mut grid.settings), (&mut mesh.material, &mut mesh.settings)]
    {
        settings.tearing = true;
        *material = Material { tear_stretch: 1.2, yield_angle: 0.05, ..material.clone() };
        (material.yield_hardening, material.yield_weakening) = (0.5, 2.0);
    }
    for (mut cloth, particle) in
        [(Cloth::grid(&grid).unwrap(), 230), (Cloth::mesh(&mesh).unwrap(), 20)]
    {
        let hash = cloth.state_hash();
        cloth.crease(Vec3::new(0.3, -9.0, 0.0), Vec3::new(0.35, 9.0, 0.0), 0.5).unwrap();
        assert_ne!(cloth.state_hash(), hash, "nothing was creased");
        assert_allocates_nothing(cloth, particle);
    }
}

#[test]
fn a_cut_grid_allocates_nothing_until_the_next_cut() {
    let mut desc = GridDesc { columns: 20, rows: 20, ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let (from, to) = (Vec3::new(-0.2, -0.33, -1.0), Vec3::new(0.61, -0.77, -1.0));
    assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 20);
    assert_allocates_nothing(cloth, 230);
}

#[test]
fn a_cloth_whose_origin_moves_allocates_nothing() {
    for self_collision in [SelfCollision::Particles, SelfCollision::Surface] {
        let mut desc = GridDesc { columns: 16, rows: 16, ..GridDesc::default() };
        (desc.pin_mode, desc.settings.self_collision) = (PinMode::None, self_collision);
        let mut cloth = Cloth::grid(&desc).unwrap();
        cloth.add_collider(&ColliderDesc { position: Vec3::NEG_Y, ..Default::default() }).unwrap();
        let edge: Vec<u32> = (0..16).collect();
        let train = cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY).unwrap();
        cloth.relative_positions();
        // The flag flutters in the first part, in which lists of pairs grow.
        let mut ride = |ticks: core::ops::Range<u32>| {
            for tick in ticks {
                let to = Vec3::X * (0.5 * tick as f32);
                cloth.move_attachment(train, to, Quat::IDENTITY).unwrap();
                cloth.step(1);
                assert_eq!(cloth.relative_positions().len(), 256);
            }
        };
        ride(1..180);
        assert_eq!(allocation_count(|| ride(180..360)), 0, "{self_collision:?}");
        assert!(cloth.origin().x > 160.0);
    }
}

#[test]
fn a_sheet_that_crumples_with_particle_collision_allocates_nothing() {
    let mut cloth = standing_sheet(SelfCollision::Particles);
    assert_eq!(allocation_count(|| cloth.step(90)), 0);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut cloth.clone(), &mut restored] {
        assert_eq!(exercise_after_a_ray(cloth, 300), 0);
        assert!(cloth.positions().len() > 24 * 24, "nothing tore");
    }
}

#[test]
fn pieces_that_collide_with_each_other_allocate_nothing() {
    let mut cloth = standing_sheet(SelfCollision::Particles);
    let (left, right) = (Vec3::new(-1.0, -0.51, -1.0), Vec3::new(4.0, -0.51, -1.0));
    assert!(cloth.cut(left, right, Vec3::Z * 2.0).unwrap() > 20);
    assert!(cloth.stats().pieces > 1, "the cut detached no piece");
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut cloth.clone(), &mut restored, &mut cloth] {
        assert_eq!(allocation_count(|| cloth.step(120)), 0);
    }
}

#[test]
fn a_sheet_that_crumples_with_surface_collision_allocates_nothing() {
    let mut cloth = standing_sheet(SelfCollision::Surface);
    assert_eq!(allocation_count(|| cloth.step(90)), 0);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut cloth.clone(), &mut restored] {
        assert_eq!(allocation_count(|| cloth.step(20)), 0);
    }
}

/// A sheet that stands on its edge over a floor and is about to crumple.
fn standing_sheet(self_collision: SelfCollision) -> Cloth {
    let mut desc = GridDesc { columns: 24, rows: 24, ..GridDesc::default() };
    desc.pin_mode = PinMode::None;
    desc.settings.self_collision = self_collision;
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let floor = ColliderDesc { position: Vec3::NEG_Y * 1.2, ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    for i in (0..24 * 24).step_by(7) {
        cloth.set_velocity(i, Vec3::Z * 0.05 * ((i % 5) as f32 - 2.0)).unwrap();
    }
    cloth
}

/// Addresses of the buffers that a renderer reads.
fn buffer_addresses(cloth: &mut Cloth) -> [usize; 5] {
    let (x, normals) = (cloth.positions().as_ptr(), cloth.normals().as_ptr());
    let (uvs, sources) = (cloth.uvs().as_ptr(), cloth.source_vertices().as_ptr());
    [
        x as usize,
        normals as usize,
        uvs as usize,
        sources as usize,
        cloth.indices().as_ptr() as usize,
    ]
}

#[test]
fn a_large_sheet_torn_to_pieces_allocates_nothing_within_its_reserve() {
    let side = 128;
    let mut desc = GridDesc { columns: side, rows: side, ..GridDesc::default() };
    desc.spacing = 2.0 / side as f32;
    desc.extra_particles = 6000;
    desc.settings.tearing = true;
    desc.settings.max_tears_per_tick = 64;
    desc.material.tear_stretch = 1.2;
    let mut cloth = Cloth::grid(&desc).unwrap();
    // A cut may allocate; the tears after it must not.
    let at = |x: f32| Vec3::new(x, -0.7, -1.0);
    assert!(cloth.cut(at(-1.0), at(0.9), Vec3::Z * 2.0).unwrap() > 100);
    cloth.step(10);
    let bottom: Vec<u32> = (side * (side - 1)..side * side).collect();
    let starts: Vec<Vec3> = bottom.iter().map(|i| cloth.positions()[*i as usize]).collect();
    let (before, bytes) = (cloth.positions().len(), cloth.stats().bytes);
    let addresses = buffer_addresses(&mut cloth);
    let mut torn_by_calls = 0;
    let count = allocation_count(|| {
        let mut pick = 1_u32;
        while cloth.positions().len() < before + 1800 {
            pick = pick.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let corner = (pick >> 8) as usize % cloth.indices().len();
            let triangle = corner - corner % 3;
            let (a, b) = (cloth.indices()[corner], cloth.indices()[triangle + (corner + 1) % 3]);
            cloth.tear_edge(a, b).unwrap();
            if pick.is_multiple_of(64) {
                cloth.step(1);
            }
        }
        torn_by_calls = cloth.positions().len();
        let mut targets = [Vec3::ZERO; 128];
        for tick in 1..=120 {
            for (target, start) in targets.iter_mut().zip(&starts) {
                *target = *start + Vec3::new(0.0, -0.02, 0.01) * tick as f32;
            }
            cloth.set_pin_targets(&bottom, &targets).unwrap();
            cloth.step(1);
            cloth.view();
            while cloth.next_event().is_some() {}
        }
    });
    assert_eq!(count, 0, "allocations");
    let after = cloth.positions().len();
    assert!(after > torn_by_calls + 200, "ticks tore {torn_by_calls} to {after}");
    assert!(after >= before + 2000, "{before} to {after} particles");
    assert_eq!(cloth.stats().bytes, bytes, "a buffer grew");
    assert_eq!(buffer_addresses(&mut cloth), addresses, "a buffer moved");
}

#[test]
fn writing_vertices_allocates_nothing_after_the_first_call() {
    let mut desc = GridDesc { columns: 20, rows: 20, ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.4;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let mut buffer = vec![0; 48 * cloth.view().vertex_capacity as usize];
    let bytes = Cell::from_mut(&mut buffer[..]).as_slice_of_cells();
    let mut at = 0;
    let streams = [Attribute::Position, Attribute::Normal, Attribute::Tangent, Attribute::Uv];
    let streams = streams.map(|attribute| {
        let format = VertexFormat::F32;
        let stream = Stream { attribute, format, stride: 48, bytes: &bytes[at..] };
        at += format.width(attribute).unwrap();
        stream
    });
    let write = |cloth: &mut Cloth, blend: f32| {
        cloth.write_vertices(&streams, &WriteDesc { blend, ..WriteDesc::default() }).unwrap();
    };
    write(&mut cloth, 0.5);
    let grab = cloth.grab_particle(210).unwrap();
    let before = cloth.positions().len();
    let count = allocation_count(|| {
        for tick in 1..=90 {
            cloth.move_grab(grab, Vec3::new(0.5, -0.5, 0.05 * tick as f32)).unwrap();
            cloth.step(1);
            write(&mut cloth, 0.25);
            write(&mut cloth, 1.0);
        }
    });
    assert_eq!(count, 0);
    assert!(cloth.positions().len() > before, "nothing tore");
}

#[test]
fn contact_with_colliders_of_every_shape_allocates_nothing() {
    let mut cloth = Cloth::grid(&common::shapes::free_sheet(24, 1.0, 0.4)).unwrap();
    let shape = |shape, x: f32, z: f32| ColliderDesc {
        shape,
        radius: 0.15,
        half_extents: Vec3::splat(0.15),
        half_height: 0.1,
        position: Vec3::new(x, 0.0, z),
        ..ColliderDesc::default()
    };
    let position = Vec3::new(0.25, 0.0, 0.25);
    let all = [
        shape(Shape::Plane, 0.0, 0.0),
        shape(Shape::Sphere, -0.25, -0.25),
        shape(Shape::Capsule, 0.25, -0.25),
        shape(Shape::Box, -0.25, 0.25),
        ColliderDesc { position, ..common::shapes::octahedron(0.2) },
        common::shapes::sphere_mesh(0.15, 6),
        common::shapes::hilly_heightfield(8, 1.5),
    ];
    let handles = all.each_ref().map(|desc| cloth.add_collider(desc).unwrap());
    let move_colliders_and_step = |cloth: &mut Cloth| {
        for i in 0..90 {
            for (desc, handle) in all.iter().zip(handles) {
                let position = desc.position + Vec3::Y * (0.002 * i as f32);
                cloth.move_collider(handle, position, desc.rotation).unwrap();
            }
            cloth.step(1);
        }
        assert!(
            handles.iter().any(|handle| cloth.collider_impulse(*handle).unwrap().linear.y < 0.0)
        );
    };
    assert_eq!(allocation_count(|| move_colliders_and_step(&mut cloth)), 0);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    assert_eq!(allocation_count(|| move_colliders_and_step(&mut restored)), 0);
}

#[test]
fn contact_with_a_mesh_that_deforms_allocates_nothing() {
    let mut cloth = Cloth::grid(&common::shapes::free_sheet(24, 1.0, 0.4)).unwrap();
    let mesh = common::shapes::sphere_mesh(0.25, 8);
    let body = cloth.add_collider(&mesh).unwrap();
    let poses: Vec<Vec<Vec3>> = (0..240)
        .map(|i| {
            let wave = |x: &Vec3| 1.0 + 0.2 * (0.3 * i as f32 + 9.0 * x.y).sin();
            mesh.positions.iter().map(|x| Vec3::new(x.x * wave(x), x.y, x.z * wave(x))).collect()
        })
        .collect();
    let mut deform_and_step = |poses: &[Vec<Vec3>]| {
        for pose in poses {
            cloth.update_collider(body, pose).unwrap();
            cloth.step(1);
        }
        assert!(cloth.collider_impulse(body).unwrap().linear.y < 0.0);
    };
    // The first contacts find how many pairs there are.
    deform_and_step(&poses[..120]);
    assert_eq!(allocation_count(|| deform_and_step(&poses[120..])), 0);
}

#[test]
fn attachments_anchors_and_moving_frames_allocate_nothing() {
    let mut desc =
        GridDesc { columns: 16, rows: 16, pin_mode: PinMode::None, ..GridDesc::default() };
    desc.material.tear_stretch = 1.3;
    (desc.settings.tearing, desc.settings.max_stretch) = (true, 0.1);
    let mut cloth = Cloth::grid(&desc).unwrap();
    let (edge, anchored) = ((0..16).collect::<Vec<u32>>(), (16..256).collect::<Vec<u32>>());
    let body = cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.set_pin_stiffness(&edge[4..12], 50.0).unwrap();
    cloth.set_max_distances(&anchored, &[0.9; 240]).unwrap();
    cloth.set_backstops(&anchored, &[0.2; 240], &[1.0; 240]).unwrap();
    let anchors: Vec<Vec3> = anchored.iter().map(|i| cloth.positions()[*i as usize]).collect();
    cloth.set_anchors(&anchored, &anchors, &[Vec3::Z; 240]).unwrap();
    cloth.set_mass_scales(&anchored[..16], &[3.0; 16]).unwrap();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    let mut copy = cloth.clone();
    for cloth in [&mut cloth, &mut copy, &mut restored] {
        let before = cloth.positions().len();
        let grab = cloth.grab_particle(136).unwrap();
        let from = cloth.positions()[136];
        let used = allocation_count(|| {
            for tick in 1..=60 {
                let to = Vec3::new(0.02, 0.0, 0.01) * tick as f32;
                cloth.move_attachment(body, -to, Quat::IDENTITY).unwrap();
                cloth.move_grab(grab, from + to).unwrap();
                cloth.step(1);
            }
            cloth.release(grab).unwrap();
            cloth.teleport(Vec3::X, Quat::IDENTITY).unwrap();
            cloth.step(30);
            cloth.move_frame(Vec3::Y, Quat::from_rotation_y(0.25), 0.5).unwrap();
            assert_eq!(cloth.advance(0.06).unwrap(), 3);
            cloth.detach(body).unwrap();
            cloth.step(10);
        });
        assert_eq!(used, 0);
        assert!(cloth.positions().len() > before, "nothing tore");
    }
}

#[test]
fn the_update_of_a_skin_allocates_nothing_while_triangles_stay() {
    let mut cloth =
        Cloth::grid(&GridDesc { columns: 20, rows: 20, ..GridDesc::default() }).unwrap();
    let desc = common::skins::sheet(60, 60, Vec3::ZERO, Vec2::new(0.95, -0.95));
    let mut skin = Skin::new(&cloth, &desc).unwrap();
    let mut words = vec![0_u32; 10 * skin.vertex_capacity() as usize];
    let mut follow = |skin: &mut Skin, cloth: &Cloth, blend| {
        skin.update(cloth).unwrap();
        // SAFETY: every bit pattern is a valid `u8` and a valid `u32`.
        let bytes = unsafe { words.align_to_mut::<u8>().1 };
        let bytes = Cell::from_mut(bytes).as_slice_of_cells();
        let stream = |attribute, first| Stream {
            attribute,
            format: VertexFormat::F32,
            stride: 40,
            bytes: &bytes[first..],
        };
        let streams = [
            stream(Attribute::Position, 0),
            stream(Attribute::Normal, 12),
            stream(Attribute::Tangent, 24),
        ];
        skin.write_vertices(cloth, &streams, &WriteDesc { blend, ..WriteDesc::default() }).unwrap();
    };
    follow(&mut skin, &cloth, 0.5);
    let allocations = allocation_count(|| {
        for tick in 0..20 {
            cloth.step(1);
            follow(&mut skin, &cloth, tick as f32 * 0.05);
        }
    });
    assert_eq!(allocations, 0);
    // A tear may add vertices.
    assert!(cloth.tear_edge(210, 211).unwrap());
    follow(&mut skin, &cloth, 1.0);
    assert!(skin.positions().len() > desc.positions.len());
    assert_eq!(allocation_count(|| follow(&mut skin, &cloth, 0.5)), 0);
}
