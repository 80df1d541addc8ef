//! A cloth on several threads gives the same bits as on one thread, after every tick.
#![cfg(feature = "parallel")]

use muslin::glam::Vec3;
use muslin::{
    Cloth, ColliderDesc, Error, GridDesc, MeshDesc, PinMode, SelfCollision, Settings, Wind,
};

mod common;

/// A sheet of `side` × `side` particles, 2 m wide and high.
fn sheet(side: u32, pin_mode: PinMode) -> GridDesc {
    let spacing = 2.0 / (side - 1) as f32;
    GridDesc { columns: side, rows: side, spacing, pin_mode, ..GridDesc::default() }
}

/// Sets a gusty, turbulent wind.
fn set_gusty_wind(cloth: &mut Cloth) {
    let velocity = Vec3::new(0.5, 0.25, 3.0);
    let wind = Wind { velocity, turbulence: 0.5, gust: 0.5, ..Wind::default() };
    cloth.set_wind(wind).unwrap();
}

/// The same triangles and pins as a cloth made from a mesh.
fn mesh_cloth(desc: &GridDesc) -> Cloth {
    let grid = Cloth::grid(desc).unwrap();
    let mesh = Cloth::mesh(&MeshDesc {
        positions: grid.positions().to_vec(),
        indices: grid.indices().to_vec(),
        pinned: grid.pinned().collect(),
        material: desc.material.clone(),
        settings: desc.settings.clone(),
        ..MeshDesc::default()
    });
    mesh.unwrap()
}

/// Runs copies of a cloth on 1, 2 and 3 threads and asserts equal bits after every tick. Returns
/// the copy that ran on one thread.
fn assert_equal_bits_on_threads(
    cloth: &Cloth,
    ticks: u32,
    before: impl Fn(&mut Cloth, u32),
) -> Cloth {
    let mut copies = [1, 2, 3].map(|threads| {
        let mut copy = cloth.clone();
        copy.set_threads_eagerly(threads).unwrap();
        copy
    });
    for tick in 0..ticks {
        let [one, more @ ..] = &mut copies;
        for cloth in std::iter::once(&mut *one).chain(&mut *more) {
            before(cloth, tick);
            cloth.step(1);
        }
        for cloth in more {
            let threads = cloth.threads();
            assert_eq!(cloth.state_hash(), one.state_hash(), "tick {tick} on {threads} threads");
            assert!(
                cloth.normals() == one.normals(),
                "normals of tick {tick} on {threads} threads"
            );
        }
    }
    let [one, ..] = copies;
    one
}

#[test]
fn a_sheet_in_the_wind_has_the_same_bits_on_any_number_of_threads() {
    let mut cloth = Cloth::grid(&sheet(128, PinMode::TopCorners)).unwrap();
    set_gusty_wind(&mut cloth);
    assert_equal_bits_on_threads(&cloth, 60, |_, _| ());
}

#[test]
fn a_crumpling_sheet_has_the_same_bits_on_any_number_of_threads() {
    for self_collision in [SelfCollision::Particles, SelfCollision::Surface] {
        let mut desc = sheet(36, PinMode::None);
        desc.settings.self_collision = self_collision;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let position = Vec3::NEG_Y * 2.1;
        cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).unwrap();
        set_gusty_wind(&mut cloth);
        assert_equal_bits_on_threads(&cloth, 90, |_, _| ());
    }
}

#[test]
fn a_sheet_with_a_strain_limit_and_lift_has_the_same_bits_on_any_number_of_threads() {
    // An odd number of rows and columns, rigid links, one iteration.
    let mut desc = sheet(129, PinMode::TopEdge);
    desc.settings.max_stretch = 0.05;
    desc.settings.iterations = 1;
    desc.material.lift = 0.5;
    desc.material.bend_stiffness = 1.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    set_gusty_wind(&mut cloth);
    assert_equal_bits_on_threads(&cloth, 30, |_, _| ());
}

#[test]
fn a_mesh_in_the_wind_has_the_same_bits_on_any_number_of_threads() {
    let mut cloth = mesh_cloth(&sheet(128, PinMode::TopCorners));
    set_gusty_wind(&mut cloth);
    assert_equal_bits_on_threads(&cloth, 60, |_, _| ());
}

/// Pulls the middle of a cloth until it tears, and unpins a corner at tick 60.
fn pull_middle(cloth: &mut Cloth, tick: u32) {
    const MIDDLE: u32 = 32 * 64 + 32;
    if tick == 0 {
        cloth.pin(MIDDLE, None).unwrap();
    }
    let pulled = Vec3::new(0.0, -1.0, 0.03 * tick as f32);
    cloth.set_pin_targets(&[MIDDLE], &[Vec3::new(1.0, 0.0, 0.0) + pulled]).unwrap();
    if tick == 60 {
        cloth.unpin(0).unwrap();
    }
}

/// A sheet of `side` × `side` particles that tears.
fn tearing_sheet(side: u32) -> GridDesc {
    let mut desc = sheet(side, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    desc
}

#[test]
fn a_tearing_sheet_has_the_same_bits_on_any_number_of_threads() {
    let mut cloth = Cloth::grid(&tearing_sheet(64)).unwrap();
    set_gusty_wind(&mut cloth);
    let torn = assert_equal_bits_on_threads(&cloth, 90, pull_middle);
    assert!(torn.positions().len() > cloth.positions().len() + 20, "too few edges tore");
}

#[test]
fn a_tearing_mesh_has_the_same_bits_on_any_number_of_threads() {
    let mut cloth = mesh_cloth(&tearing_sheet(64));
    set_gusty_wind(&mut cloth);
    let torn = assert_equal_bits_on_threads(&cloth, 90, pull_middle);
    assert!(torn.positions().len() > cloth.positions().len() + 20, "too few edges tore");
}

#[test]
fn the_thread_count_is_one_by_default_and_survives_reset_and_clone() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    assert_eq!(cloth.threads(), 1);
    cloth.set_threads(3).unwrap();
    let refused = cloth.set_threads(0).unwrap_err();
    assert_eq!(refused, Error::BadValue { field: "threads", must: "be at least 1" });
    cloth.reset();
    assert_eq!((cloth.threads(), cloth.clone().threads()), (3, 3));
}

#[test]
fn the_thread_count_is_neither_hashed_nor_saved() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    let (hash, saved) = (cloth.state_hash(), cloth.save());
    cloth.set_threads(2).unwrap();
    assert_eq!(cloth.state_hash(), hash);
    assert_eq!(cloth.save(), saved);
    assert_eq!(Cloth::restore(&saved).unwrap().threads(), 1);
}

#[test]
fn many_cloths_have_the_same_bits_on_any_number_of_threads() {
    let mut cloths: Vec<Cloth> = (0..50)
        .map(|i| {
            let mut cloth = Cloth::grid(&sheet(6 + i % 5, PinMode::TopEdge)).unwrap();
            if i % 3 > 0 {
                set_gusty_wind(&mut cloth);
            }
            let settings = Settings { sleep_speed: 0.05, damping: 2.0, ..Settings::default() };
            cloth.set_settings(settings).unwrap();
            cloth
        })
        .collect();
    cloths[7].set_threads_eagerly(3).unwrap();
    let mut copies = [1, 2, 3, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        (pool, cloths.clone())
    });
    for frame in 0..90 {
        let seconds = [0.02, 0.0, 0.04][frame % 3];
        let separate: Vec<u32> =
            cloths.iter_mut().map(|cloth| cloth.advance(seconds).unwrap()).collect();
        for (pool, copies) in &mut copies {
            let ticks = pool.install(|| Cloth::advance_many(copies, seconds)).unwrap();
            assert_eq!(ticks, separate);
            for (copy, cloth) in copies.iter().zip(&cloths) {
                assert_eq!(copy.state_hash(), cloth.state_hash(), "frame {frame}");
            }
        }
    }
    assert!(cloths[0].is_asleep() && !cloths[1].is_asleep());
    assert_eq!(copies[1].1[7].threads(), 3);
}
