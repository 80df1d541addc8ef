//! Copies of a cloth, and many cloths that advance in one call.

use crate::common::irregular_mesh;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, PinMode, SelfCollision, Settings, Shape, Wind};

/// Returns constantly zero: with a clock a cloth runs all of its ticks, asleep or not.
fn stopped_clock() -> f64 {
    0.0
}

/// A sheet of 8 × 8 particles that sleeps when it is slower than `sleep_speed` [m/s].
fn sheet(sleep_speed: f32) -> Cloth {
    let desc = GridDesc {
        columns: 8,
        rows: 8,
        settings: Settings { sleep_speed, damping: 2.0, ..Settings::default() },
        ..GridDesc::default()
    };
    Cloth::grid(&desc).unwrap()
}

fn sleeping_sheet() -> Cloth {
    let mut cloth = sheet(0.01);
    cloth.step(300);
    assert!(cloth.is_asleep());
    cloth
}

/// Cloths of many kinds: asleep, in the wind, falling on a ball, torn, colliding with themselves.
fn crowd() -> Vec<Cloth> {
    let mut windy = sheet(0.01);
    windy.set_wind(Wind { velocity: Vec3::Z * 4.0, gust: 0.5, ..Wind::default() }).unwrap();
    let mut falling = sheet(0.01);
    falling.unpin_all();
    let (shape, position) = (Shape::Sphere, Vec3::NEG_Y);
    let ball = ColliderDesc { shape, position, radius: 0.2, ..ColliderDesc::default() };
    falling.add_collider(&ball).unwrap();
    let mut torn = Cloth::mesh(&irregular_mesh()).unwrap();
    torn.tear_edge(torn.indices()[0], torn.indices()[1]).unwrap();
    let mut folding = GridDesc { columns: 9, pin_mode: PinMode::None, ..GridDesc::default() };
    folding.settings.self_collision = SelfCollision::Surface;
    folding.rows = 9;
    let mut folding = Cloth::grid(&folding).unwrap();
    folding.add_collider(&ball).unwrap();
    let kinds = [sleeping_sheet(), windy, falling, torn, folding];
    // Whole blocks of sleeping cloths, and mixed ones.
    let mut crowd = vec![sleeping_sheet(); 40];
    crowd.extend(kinds.iter().cycle().take(20).cloned());
    for (at, cloth) in crowd.iter_mut().enumerate() {
        cloth.advance(0.001 * (at % 7) as f32).unwrap();
    }
    crowd
}

fn hashes(cloths: &[Cloth]) -> Vec<(u64, f32, f64)> {
    cloths.iter().map(|cloth| (cloth.state_hash(), cloth.blend(), cloth.time())).collect()
}

#[test]
fn a_duplicate_continues_with_the_same_bits_and_is_independent() {
    for mut cloth in crowd().into_iter().skip(40).take(5) {
        cloth.step(5);
        let grab = cloth.grab_particle(20).unwrap();
        let mut copy = cloth.duplicate();
        assert_eq!(copy.state_hash(), cloth.state_hash());
        for cloth in [&mut cloth, &mut copy] {
            cloth.move_grab(grab, Vec3::new(0.3, -0.2, 0.4)).unwrap();
            cloth.advance(0.1).unwrap();
        }
        assert_eq!(copy.state_hash(), cloth.state_hash());
        assert!(copy.positions() == cloth.positions() && copy.normals() == cloth.normals());
        let before = copy.state_hash();
        cloth.release(grab).unwrap();
        cloth.step(10);
        assert_eq!(copy.state_hash(), before);
        copy.release(grab).unwrap();
    }
}

#[test]
fn many_cloths_in_one_call_get_the_bits_of_separate_calls() {
    let (mut together, mut apart) = (crowd(), crowd());
    for frame in 0..60 {
        let seconds = [1.0 / 60.0, 0.0, 0.05, 0.004, 1.0][frame % 5];
        let ticks = Cloth::advance_many(&mut together, seconds).unwrap();
        let separate: Vec<u32> =
            apart.iter_mut().map(|cloth| cloth.advance(seconds).unwrap()).collect();
        assert_eq!(ticks, separate, "frame {frame}");
        assert_eq!(hashes(&together), hashes(&apart), "frame {frame}");
        if frame == 30 {
            for cloths in [&mut together, &mut apart] {
                cloths[17].set_velocity(30, Vec3::Z).unwrap();
            }
        }
    }
    assert!(together[0].is_asleep() && !together[41].is_asleep());
}

#[test]
fn references_to_cloths_advance_too_and_an_empty_list_does_nothing() {
    let (mut first, mut second) = (sheet(0.0), sleeping_sheet());
    let ticks = Cloth::advance_many(&mut [&mut first, &mut second], 0.035).unwrap();
    assert_eq!((ticks, first.ticks(), second.ticks()), (vec![2, 2], 2, 302));
    assert_eq!(Cloth::advance_many::<Cloth>(&mut [], 0.1).unwrap(), []);
}

#[test]
fn wrong_seconds_are_refused_for_all_cloths() {
    let mut cloths = crowd();
    let before = hashes(&cloths);
    for seconds in [-0.1, f32::NAN, f32::INFINITY] {
        let error = Cloth::advance_many(&mut cloths, seconds).unwrap_err();
        assert_eq!(error, Error::BadValue { field: "seconds", must: "be at least 0 and finite" });
    }
    assert_eq!(hashes(&cloths), before);
}

#[test]
fn a_cloth_that_skips_its_ticks_has_the_bits_of_one_that_runs_them() {
    type Change = fn(&mut Cloth);
    let changes: [Change; 9] = [
        |_| (),
        |cloth| cloth.pin(0, Some(Vec3::Y * 0.1)).unwrap(),
        |cloth| {
            let grab = cloth.grab_particle(60).unwrap();
            cloth.advance(0.5).unwrap();
            cloth.move_grab(grab, Vec3::Z * 0.1).unwrap();
        },
        |cloth| {
            let attachment = cloth.attach(&[0, 1], Vec3::ZERO, Quat::IDENTITY).unwrap();
            cloth.advance(0.1).unwrap();
            cloth.move_attachment(attachment, Vec3::Z * 0.2, Quat::IDENTITY).unwrap();
        },
        |cloth| {
            let floor = ColliderDesc { position: Vec3::NEG_Y * 3.0, ..ColliderDesc::default() };
            let floor = cloth.add_collider(&floor).unwrap();
            cloth.advance(1.0).unwrap();
            cloth.move_collider(floor, Vec3::NEG_Y * 0.2, Quat::IDENTITY).unwrap();
        },
        |cloth| {
            let settings = Settings { tick: 1.0 / 90.0, ..cloth.settings().clone() };
            cloth.set_settings(Settings { max_ticks_per_advance: 3, ..settings }).unwrap();
        },
        |cloth| cloth.set_wind(Wind { velocity: Vec3::Z, ..Wind::default() }).unwrap(),
        |cloth| cloth.teleport(Vec3::X, Quat::from_rotation_y(0.5)).unwrap(),
        Cloth::unpin_all,
    ];
    for (at, change) in changes.into_iter().enumerate() {
        let (mut idle, mut running) = (sleeping_sheet(), sleeping_sheet());
        running.set_clock(Some(stopped_clock));
        for cloth in [&mut idle, &mut running] {
            (0..4).for_each(|_| assert!(cloth.advance(0.03).is_ok()));
            cloth.step(3);
            change(cloth);
        }
        for frame in 0..30 {
            let ticks = [&mut idle, &mut running].map(|cloth| cloth.advance(0.03).unwrap());
            assert_eq!(ticks[0], ticks[1], "change {at}, frame {frame}");
            assert_eq!(idle.state_hash(), running.state_hash(), "change {at}, frame {frame}");
            assert_eq!(idle.save(), running.save(), "change {at}, frame {frame}");
            assert!(frame > 0 || idle.is_asleep() == (at == 0), "change {at}");
        }
    }
}
