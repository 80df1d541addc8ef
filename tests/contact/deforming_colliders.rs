//! Mesh colliders that deform: the bodies of characters.

use crate::common::shapes::{Tube, swung, tube};
use muslin::glam::{Quat, Vec3};
use muslin::{
    Cloth, Collider, ColliderDesc, Error, GridDesc, MeshDesc, PinMode, SelfCollision, Settings,
    Shape,
};
use std::f32::consts::TAU;

const TICK: f32 = 1.0 / 60.0;

/// A square plate of `count` x `count` vertices around the origin, in the plane y = 0, with sides of
/// `size` m.
fn plate(count: u32, size: f32) -> (Vec<Vec3>, Vec<u32>) {
    let at = |i: u32| (i as f32 / (count - 1) as f32 - 0.5) * size;
    let positions = (0..count * count).map(|v| Vec3::new(at(v % count), 0.0, at(v / count)));
    let cells = (0..count - 1).flat_map(|z| (0..count - 1).map(move |x| z * count + x));
    let indices =
        cells.flat_map(|a| [a, a + count, a + 1, a + 1, a + count, a + count + 1]).collect();
    (positions.collect(), indices)
}

fn mesh_body((positions, indices): (Vec<Vec3>, Vec<u32>)) -> ColliderDesc {
    ColliderDesc {
        shape: Shape::Mesh,
        positions,
        indices,
        friction: 0.6,
        ..ColliderDesc::default()
    }
}

/// A sheet of 16 x 16 particles that lies 4 cm above y = 0, with sides of 0.45 m.
fn lying_sheet(self_collision: SelfCollision) -> Cloth {
    let desc = GridDesc {
        columns: 16,
        rows: 16,
        spacing: 0.03,
        origin: Vec3::new(-0.225, 0.04, -0.225),
        right: Vec3::X,
        down: Vec3::Z,
        pin_mode: PinMode::None,
        settings: Settings { self_collision, ..Settings::default() },
        ..GridDesc::default()
    };
    Cloth::grid(&desc).unwrap()
}

#[test]
fn a_surface_that_moves_as_a_whole_acts_as_a_collider_that_moves() {
    let shift = |tick: u32| {
        let angle = tick as f32 * 0.05;
        Vec3::new(0.6 * (1.0 - angle.cos()), 0.1 * angle.sin(), 0.2 * angle.sin())
    };
    let mut sheets = [lying_sheet(SelfCollision::None), lying_sheet(SelfCollision::None)];
    let body = mesh_body(plate(21, 1.0));
    let bodies = sheets.each_mut().map(|cloth| cloth.add_collider(&body).unwrap());
    for tick in 0..90 {
        let moved: Vec<Vec3> = body.positions.iter().map(|x| *x + shift(tick)).collect();
        sheets[0].move_collider(bodies[0], shift(tick), Quat::IDENTITY).unwrap();
        sheets[1].update_collider(bodies[1], &moved).unwrap();
        sheets.iter_mut().for_each(|cloth| cloth.step(1));
    }
    let [a, b] = sheets.each_ref().map(|cloth| cloth.positions());
    let farthest = a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    let carried = a.iter().map(|x| x.x).sum::<f32>() / a.len() as f32;
    assert!(carried > 0.5, "carried along by {carried} m");
    assert!(farthest < 0.003, "{farthest} m apart");
}

#[test]
fn a_sheet_stays_above_a_wave_that_runs_below_it() {
    for self_collision in [SelfCollision::None, SelfCollision::Surface] {
        let mut cloth = lying_sheet(self_collision);
        let (rest, indices) = plate(31, 1.2);
        let body = cloth.add_collider(&mesh_body((rest.clone(), indices))).unwrap();
        let height =
            |x: f32, time: f32| 0.06 * (time * 2.0).min(1.0) * (TAU * (x / 0.6 - 2.0 * time)).sin();
        for tick in 1..=120 {
            let time = tick as f32 * TICK;
            let now: Vec<Vec3> =
                rest.iter().map(|x| Vec3::new(x.x, height(x.x, time), x.z)).collect();
            cloth.update_collider(body, &now).unwrap();
            cloth.step(1);
            for (i, x) in cloth.positions().iter().enumerate() {
                // Between the lines of vertices at both sides: the surface is even along z.
                let column = ((x.x + 0.6) / 0.04).clamp(0.0, 29.9);
                let [from, to] =
                    [0.0, 1.0].map(|k| height((column.floor() + k) * 0.04 - 0.6, time));
                let ground = from + (to - from) * column.fract();
                let depth = ground - x.y;
                assert!(depth < 1.0e-4, "particle {i} at tick {tick}: {depth} m below");
            }
        }
        let mean = cloth.positions().iter().map(|x| x.y).sum::<f32>() / 256.0;
        assert!(mean < 0.07, "the sheet lies on the wave: {mean} m");
    }
}

#[test]
fn nothing_gets_into_a_kicking_leg() {
    for max_stretch in [0.0, 0.05] {
        let (leg, indices) = tube(40, 50, 0.15, [-0.6, 0.6]);
        let (skirt, skirt_indices) = tube(50, 26, 0.168, [-0.3, 0.25]);
        let desc = MeshDesc {
            positions: skirt,
            indices: skirt_indices,
            pinned: (1250..1300).collect(),
            settings: Settings { max_stretch, ..Settings::default() },
            ..MeshDesc::default()
        };
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let collider = cloth.add_collider(&mesh_body((leg.clone(), indices.clone()))).unwrap();
        let (mut fastest, mut last) = (0.0_f32, leg.clone());
        for tick in 1..=60 {
            let angle = 35.0_f32.to_radians() * (TAU * 1.5 * tick as f32 * TICK).sin();
            let now = swung(&leg, angle);
            let fast = now.iter().zip(&last).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            fastest = fastest.max(fast / TICK);
            cloth.update_collider(collider, &now).unwrap();
            cloth.step(1);
            let body = Tube::new(&now, &indices);
            let middle = now[1000..1040].iter().sum::<Vec3>() / 40.0;
            let depth = body.depth(middle);
            assert!(depth > 0.1, "the middle of a ring is {depth} m deep at tick {tick}");
            for (i, x) in cloth.positions().iter().enumerate() {
                let depth = body.depth(*x);
                assert!(depth < 2.0e-4, "particle {i} at tick {tick}: {depth} m deep");
            }
            last = now;
        }
        assert!(fastest > 3.5, "the leg moves at {fastest} m/s");
    }
}

#[test]
fn the_ticks_of_an_advance_share_the_way() {
    let (rest, indices) = plate(11, 1.0);
    let make = || {
        let mut cloth = lying_sheet(SelfCollision::None);
        let body = cloth.add_collider(&mesh_body((rest.clone(), indices.clone()))).unwrap();
        (cloth, body)
    };
    let target: Vec<Vec3> = rest.iter().map(|x| *x + Vec3::Y * (0.09 + 0.2 * x.x)).collect();
    let ((mut whole, body), (mut steps, body_of_steps)) = (make(), make());
    whole.update_collider(body, &target).unwrap();
    assert_eq!(whole.advance(3.0 * TICK).unwrap(), 3);
    for left in [3.0, 2.0, 1.0_f32] {
        let share = 1.0 - (left - 1.0) / 3.0;
        let now: Vec<Vec3> =
            rest.iter().zip(&target).map(|(a, b)| *a + (*b - *a) * share).collect();
        steps.update_collider(body_of_steps, &now).unwrap();
        steps.step(1);
    }
    let pairs = whole.positions().iter().zip(steps.positions());
    let farthest = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    assert!(farthest < 1.0e-5, "{farthest} m apart");
}

#[test]
fn a_saved_cloth_goes_on_in_the_middle_of_the_motion() {
    let (rest, indices) = plate(11, 1.0);
    let mut cloth = lying_sheet(SelfCollision::None);
    let body = cloth.add_collider(&mesh_body((rest.clone(), indices))).unwrap();
    let pose = |k: u32| -> Vec<Vec3> {
        rest.iter().map(|x| *x + Vec3::Y * (0.01 * k as f32 * (1.0 + x.x))).collect()
    };
    for k in 1..12 {
        cloth.update_collider(body, &pose(k)).unwrap();
        cloth.step(1);
    }
    cloth.update_collider(body, &pose(12)).unwrap();
    let mut copies = [Cloth::restore(&cloth.save()).unwrap(), cloth.clone()];
    assert_eq!(copies.each_ref().map(Cloth::state_hash), [cloth.state_hash(); 2]);
    let go_on = |cloth: &mut Cloth| {
        cloth.step(2);
        cloth.update_collider(body, &pose(14)).unwrap();
        cloth.step(5);
        cloth.state_hash()
    };
    let expected = go_on(&mut cloth);
    assert_eq!(copies.each_mut().map(go_on), [expected; 2]);
}

#[test]
fn a_wrong_update_is_refused_and_changes_nothing() {
    let mut cloth = lying_sheet(SelfCollision::None);
    let (rest, indices) = plate(5, 1.0);
    let body = cloth.add_collider(&mesh_body((rest.clone(), indices))).unwrap();
    let floor = cloth.add_collider(&ColliderDesc::default()).unwrap();
    let before = cloth.state_hash();
    let mut refused = |body: Collider, positions: &[Vec3], text: &str| {
        let error = cloth.update_collider(body, positions).unwrap_err();
        assert_eq!((error.to_string().as_str(), cloth.state_hash()), (text, before));
        error
    };
    let count = "`count` must be the number of vertices of the collider";
    refused(body, &rest[1..], count);
    refused(body, &[], count);
    refused(floor, &rest, "`collider` must be a mesh");
    let mut bad = rest.clone();
    bad[7].y = f32::NAN;
    let error = refused(body, &bad, "`positions[7]` must be between -1e6 and 1e6");
    assert!(matches!(error, Error::BadEntry { index: 7, .. }));
    cloth.remove_collider(body).unwrap();
    let error = cloth.update_collider(body, &rest).unwrap_err();
    assert!(matches!(error, Error::BadHandle { .. }), "{error}");
}

#[test]
fn a_surface_that_moves_wakes_a_sleeping_cloth() {
    let mut cloth = lying_sheet(SelfCollision::None);
    let settings = Settings { sleep_speed: 0.05, ..Settings::default() };
    cloth.set_settings(settings).unwrap();
    let (rest, indices) = plate(11, 1.0);
    let body = cloth.add_collider(&mesh_body((rest.clone(), indices))).unwrap();
    cloth.step(240);
    assert!(cloth.is_asleep());
    let raised: Vec<Vec3> = rest.iter().map(|x| *x + Vec3::Y * 0.02).collect();
    cloth.update_collider(body, &raised).unwrap();
    cloth.step(1);
    assert!(!cloth.is_asleep());
    let lowest = cloth.positions().iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
    assert!(lowest > 0.0199, "{lowest} m");
}

#[test]
fn a_surface_may_fold_flat_and_unfold() {
    let (rest, indices) = plate(9, 0.6);
    let mut cloth = lying_sheet(SelfCollision::None);
    let body = cloth.add_collider(&mesh_body((rest.clone(), indices))).unwrap();
    for share in [0.5, 0.0, 0.0, 1.0] {
        let now: Vec<Vec3> = rest.iter().map(|x| Vec3::new(x.x * share, x.y, x.z)).collect();
        cloth.update_collider(body, &now).unwrap();
        cloth.step(3);
    }
    let is_finite = |x: &Vec3| x.is_finite() && x.length() < 10.0;
    assert!(cloth.positions().iter().all(is_finite));
}

/// Returns the height of a triangle above a point, if its vertical projection covers it [m].
fn height_above(at: Vec3, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let area = |p: Vec3, q: Vec3| (p - at).cross(q - at).y;
    let weights = [area(b, c), area(c, a), area(a, b)];
    let whole: f32 = weights.iter().sum();
    let weights = weights.map(|weight| weight / whole);
    let covers = weights.iter().all(|weight| *weight >= 0.0);
    covers.then(|| a.y * weights[0] + b.y * weights[1] + c.y * weights[2] - at.y)
}

/// The bound of stretch and the layers are restored after the last substep. The surface is at rest
/// then: if it still counted as moving, cloth that it carries along would seem to have come from below
/// it.
#[test]
fn layers_stay_on_the_peaks_of_a_surface_that_sinks_fast() {
    let (rest, body_indices) = plate(15, 0.7);
    let peak = |v: usize| (v % 15) % 2 == 1 && (v / 15) % 2 == 1;
    let bumpy = |sunk: f32| -> Vec<Vec3> {
        let height = |v| if peak(v) { 0.03 } else { 0.0 };
        rest.iter().enumerate().map(|(v, x)| *x + Vec3::Y * (height(v) - sunk)).collect()
    };
    let (sheet, indices) = plate(16, 0.45);
    let layer = |height: f32| sheet.iter().map(move |x| *x + Vec3::Y * height);
    let mut cloth = Cloth::mesh(&MeshDesc {
        positions: layer(0.035).chain(layer(0.036)).collect(),
        indices: indices.iter().copied().chain(indices.iter().map(|i| i + 256)).collect(),
        settings: Settings {
            self_collision: SelfCollision::Surface,
            max_stretch: 0.03,
            ..Settings::default()
        },
        ..MeshDesc::default()
    })
    .unwrap();
    let body = cloth.add_collider(&mesh_body((bumpy(0.0), body_indices))).unwrap();
    for tick in 1..=100 {
        let time = (tick as f32 * TICK - 0.8).max(0.0);
        let now = bumpy(3.0 * time * time);
        cloth.update_collider(body, &now).unwrap();
        cloth.step(1);
        let x = cloth.positions();
        for (v, top) in now.iter().enumerate().filter(|(v, _)| peak(*v)) {
            for corners in cloth.indices().chunks_exact(3) {
                let triangle = [0, 1, 2].map(|k| x[corners[k] as usize]);
                let height = height_above(*top, triangle).unwrap_or(0.0);
                assert!(height > -1.0e-4, "vertex {v} at tick {tick}: {height} m above {top}");
            }
        }
    }
}
