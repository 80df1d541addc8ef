//! Cloths that take turns on one thread share its scratch buffers, and do not see each other in them.

use crate::common::irregular_mesh;
use crate::common::shapes::{free_sheet, hilly_heightfield, octahedron, sphere_mesh};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Preset, SelfCollision, Shape};

const TICKS: u32 = 40;

fn ball(x: f32, y: f32, z: f32) -> ColliderDesc {
    let position = Vec3::new(x, y, z);
    ColliderDesc { shape: Shape::Sphere, radius: 0.25, position, ..ColliderDesc::default() }
}

fn hung() -> Cloth {
    Cloth::grid(&GridDesc { columns: 16, rows: 16, ..GridDesc::default() }).unwrap()
}

fn hung_over_a_ball() -> Cloth {
    let mut cloth = hung();
    cloth.add_collider(&ball(0.4, -0.6, 0.15)).unwrap();
    cloth
}

fn stiff_sheet_on_flat_faces() -> Cloth {
    let mut desc = free_sheet(20, 0.9, 0.3);
    desc.material = muslin::Material::preset(Preset::Denim);
    desc.material.yield_angle = 0.05;
    desc.settings.self_collision = SelfCollision::Particles;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&octahedron(0.25)).unwrap();
    cloth.add_collider(&hilly_heightfield(8, 1.5)).unwrap();
    cloth
}

fn bounded_mesh() -> Cloth {
    let mut desc = irregular_mesh();
    (desc.settings.max_stretch, desc.material.stretch_damping) = (0.1, 0.01);
    let mut cloth = Cloth::mesh(&desc).unwrap();
    cloth.add_collider(&ball(0.3, -0.4, 0.1)).unwrap();
    cloth
}

fn tearing_layers() -> Cloth {
    let mut desc = GridDesc { columns: 24, rows: 12, ..GridDesc::default() };
    desc.pin_mode = PinMode::TopCorners;
    desc.settings.self_collision = SelfCollision::Surface;
    (desc.settings.tearing, desc.material.tear_stretch) = (true, 1.05);
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&sphere_mesh(0.3, 8)).unwrap();
    cloth
}

const MAKERS: [fn() -> Cloth; 5] =
    [hung, hung_over_a_ball, stiff_sheet_on_flat_faces, bounded_mesh, tearing_layers];

/// Runs one tick, and in some of them a call that uses the scratch buffers too.
fn play(cloth: &mut Cloth, tick: u32) -> u64 {
    match tick {
        11 => drop(cloth.tear_edge(100, 101)),
        17 => {
            drop(cloth.cut(Vec3::new(0.2, -9.0, -9.0), Vec3::new(0.2, 9.0, -9.0), Vec3::Z * 18.0));
        }
        23 => {
            let mut settings = cloth.settings().clone();
            settings.self_collision = SelfCollision::Surface;
            cloth.set_settings(settings).unwrap();
        }
        _ => (),
    }
    cloth.step(1);
    cloth.state_hash()
}

/// The hashes after each tick of a cloth that has a thread of its own.
fn hashes_alone(make: fn() -> Cloth) -> Vec<u64> {
    let play_all = move || {
        let mut cloth = make();
        (0..TICKS).map(|tick| play(&mut cloth, tick)).collect()
    };
    std::thread::spawn(play_all).join().unwrap()
}

#[test]
fn cloths_that_take_turns_on_a_thread_get_the_bits_of_each_alone() {
    let alone = MAKERS.map(hashes_alone);
    // The clones share their rest shape with the cloths.
    let mut cloths: Vec<Cloth> = MAKERS.iter().map(|make| make()).collect();
    cloths.extend(cloths.clone());
    for tick in 0..TICKS {
        // Another order in each tick, and some cloths twice in a row.
        for turn in 0..cloths.len() {
            let at = (turn * 3 + tick as usize) % cloths.len();
            let hash = play(&mut cloths[at], tick);
            assert_eq!(hash, alone[at % MAKERS.len()][tick as usize], "cloth {at}, tick {tick}");
        }
    }
}

#[test]
fn a_change_of_a_clone_does_not_reach_the_cloth_that_it_shares_with() {
    // `alone` shares with no other cloth.
    let (mut cloth, mut alone) = (hung(), hung());
    cloth.step(5);
    alone.step(5);
    let (mut torn, mut cut) = (cloth.clone(), cloth.clone());
    assert!(torn.tear_edge(100, 101).unwrap());
    assert!(
        cut.cut(Vec3::new(0.2, -9.0, -9.0), Vec3::new(0.2, 9.0, -9.0), Vec3::Z * 18.0).unwrap() > 0
    );
    for cloth in [&mut cloth, &mut alone, &mut torn, &mut cut] {
        cloth.step(20);
    }
    assert_eq!(cloth.indices(), alone.indices());
    assert_eq!(cloth.state_hash(), alone.state_hash());
}
