//! Surfaces that keep apart: nothing crosses, layers rest on each other, and what moved them stays what it was.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Settings, Shape};

use crate::common::crossings::crossing_count;

fn surface() -> Settings {
    Settings { self_collision: SelfCollision::Surface, ..Settings::default() }
}

/// A grid of `side` particles a side in the x–z plane, its middle over the origin at a height.
fn lying(side: u32, size: f32, height: f32) -> GridDesc {
    let origin = Vec3::new(-0.5 * size, height, -0.5 * size);
    let spacing = size / (side - 1) as f32;
    let down = Vec3::Z;
    GridDesc {
        columns: side,
        rows: side,
        spacing,
        origin,
        down,
        pin_mode: PinMode::None,
        settings: surface(),
        ..GridDesc::default()
    }
}

/// Sheets over each other as one mesh, of `side` particles a side each.
fn sheets(count: u32, side: u32, size: f32, place: impl Fn(u32, Vec3) -> Vec3) -> MeshDesc {
    let mut desc = MeshDesc { settings: surface(), ..MeshDesc::default() };
    for sheet in 0..count {
        let first = desc.positions.len() as u32;
        let at = |k: u32| size * (k as f32 / (side - 1) as f32 - 0.5);
        for row in 0..side {
            desc.positions
                .extend((0..side).map(|column| place(sheet, Vec3::new(at(column), 0.0, at(row)))));
        }
        for cell in 0..(side - 1) * (side - 1) {
            let a = first + cell / (side - 1) * side + cell % (side - 1);
            desc.indices.extend([a, a + side, a + 1, a + 1, a + side, a + side + 1]);
        }
    }
    desc
}

fn floor(height: f32) -> ColliderDesc {
    ColliderDesc { position: Vec3::Y * height, ..ColliderDesc::default() }
}

fn ball(radius: f32, position: Vec3) -> ColliderDesc {
    ColliderDesc { shape: Shape::Sphere, radius, position, ..ColliderDesc::default() }
}

/// Plays, and tells the most crossings on the way and how many are left.
fn watch(
    name: &str,
    cloth: &mut Cloth,
    ticks: u32,
    mut act: impl FnMut(&mut Cloth, u32),
) -> (usize, usize) {
    let (mut most, mut last) = (0, 0);
    let mut spent = 0.0;
    let mut worst = 0.0_f64;
    for tick in 0..ticks {
        act(cloth, tick);
        let start = cpu_time::ThreadTime::now();
        cloth.step(1);
        let took = start.elapsed().as_secs_f64();
        spent += took;
        worst = worst.max(took);
        if tick % 5 == 4 || tick + 1 == ticks {
            last = crossing_count(cloth);
            most = most.max(last);
        }
    }
    println!(
        "{name}: {most} at most, {last} at the end; rms {:.2} mm/s, {:.2} ms a tick, {:.2} at worst",
        1.0e3 * speed(cloth),
        1.0e3 * spent / f64::from(ticks),
        1.0e3 * worst
    );
    (most, last)
}

/// Root of the mean square speed [m/s].
fn speed(cloth: &Cloth) -> f32 {
    let count = cloth.positions().len();
    ((0..count as u32).map(|i| cloth.velocity(i).unwrap().length_squared()).sum::<f32>()
        / count as f32)
        .sqrt()
}

#[test]
fn five_sheets_dropped_in_turn_lie_a_thickness_apart() {
    let mut desc = sheets(5, 20, 0.5, |sheet, x| x + Vec3::Y * (0.02 + 0.05 * sheet as f32));
    desc.material.thickness = 0.002;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    cloth.add_collider(&floor(0.0)).unwrap();
    let (most, _) = watch("stack", &mut cloth, 180, |_, _| ());
    assert_eq!(most, 0);
    let mean = |sheet: usize| {
        let of = &cloth.positions()[400 * sheet..400 * (sheet + 1)];
        of.iter().map(|x| x.y).sum::<f32>() / 400.0
    };
    let heights: Vec<f32> = (0..5).map(mean).collect();
    println!("heights {heights:?}");
    for pair in heights.windows(2) {
        let gap = (pair[1] - pair[0]) / 0.002;
        assert!((0.8..1.5).contains(&gap), "{gap} thicknesses");
    }
    assert!(speed(&cloth) < 1.0e-3, "{} m/s", speed(&cloth));
}

#[test]
fn a_sheet_on_its_edge_crumples_without_a_crossing() {
    let mut cloth = standing(32, 0);
    let (most, last) = watch("edge", &mut cloth, 400, |_, _| ());
    assert_eq!((most, last), (0, 0));
    assert!(speed(&cloth) < 1.5e-3, "the heap moves at {} m/s", speed(&cloth));
}

/// Cells fold over while a substep goes by: a row that lands lies on the next one, which stood before.
#[test]
fn what_folds_over_in_one_substep_does_not_cross() {
    for seed in [0, 1, 5, 8] {
        let (most, last) = watch("landing", &mut standing(64, seed), 32, |_, _| ());
        assert_eq!((most, last), (0, 0), "seed {seed}");
    }
}

#[test]
fn a_sheet_over_a_ball_and_the_floor() {
    let mut cloth = Cloth::grid(&lying(64, 1.6, 0.5)).unwrap();
    cloth.add_collider(&ball(0.3, Vec3::Y * 0.1)).unwrap();
    cloth.add_collider(&floor(-0.3)).unwrap();
    let (most, last) = watch("ball", &mut cloth, 120, |_, _| ());
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_sheet_on_a_turning_ball() {
    let mut cloth = Cloth::grid(&lying(40, 1.4, 0.45)).unwrap();
    let ball = cloth.add_collider(&ball(0.3, Vec3::Y * 0.1)).unwrap();
    cloth.add_collider(&floor(-0.25)).unwrap();
    let (most, last) = watch("turning", &mut cloth, 240, |cloth, tick| {
        let turn = Quat::from_rotation_y((tick as f32 - 60.0).max(0.0) * 0.04);
        cloth.move_collider(ball, Vec3::Y * 0.1, turn).unwrap();
    });
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_curtain_falls_over_a_ball() {
    let desc = GridDesc {
        columns: 40,
        rows: 40,
        spacing: 0.03,
        origin: Vec3::new(-0.6, 1.6, 0.0),
        settings: surface(),
        pin_mode: PinMode::TopEdge,
        ..GridDesc::default()
    };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&ball(0.25, Vec3::new(0.0, 0.3, 0.05))).unwrap();
    cloth.add_collider(&floor(0.0)).unwrap();
    let (most, last) = watch("curtain", &mut cloth, 150, |cloth, tick| {
        if tick == 40 {
            cloth.unpin_all();
        }
    });
    assert_eq!((most, last), (0, 0));
}

/// Takes an edge over to the other side, about an axis at a height, and lets it go.
fn fold(cloth: &mut Cloth, tick: u32, [from, to]: [u32; 2], edge: &[u32], axis: Vec3, height: f32) {
    if tick == from {
        edge.iter().for_each(|i| cloth.pin(*i, None).unwrap());
    }
    if (from..to).contains(&tick) {
        let turn = |tick: u32| core::f32::consts::PI * (tick - from) as f32 / (to - from) as f32;
        let by = Quat::from_axis_angle(axis, turn(tick + 1))
            * Quat::from_axis_angle(axis, turn(tick)).inverse();
        let pivot = Vec3::Y * height;
        let at = |i: &u32| by * (cloth.positions()[*i as usize] - pivot) + pivot;
        let targets: Vec<Vec3> = edge.iter().map(at).collect();
        cloth.set_pin_targets(edge, &targets).unwrap();
    }
    if tick == to {
        edge.iter().for_each(|i| cloth.unpin(*i).unwrap());
    }
}

#[test]
fn a_sheet_is_folded_and_let_go() {
    let side = 33;
    let mut cloth = Cloth::grid(&lying(side, 0.8, 0.001)).unwrap();
    cloth.add_collider(&floor(0.0)).unwrap();
    let left: Vec<u32> = (0..side).map(|k| k * side).collect();
    let (most, last) = watch("fold", &mut cloth, 200, |cloth, tick| {
        fold(cloth, tick, [10, 100], &left, Vec3::NEG_Z, 0.004);
    });
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_sheet_is_folded_twice_and_let_go() {
    let side = 33;
    let mut cloth = Cloth::grid(&lying(side, 0.8, 0.001)).unwrap();
    cloth.add_collider(&floor(0.0)).unwrap();
    let left: Vec<u32> = (0..side).map(|k| k * side).collect();
    let back: Vec<u32> = (0..side).collect();
    let (most, last) = watch("fold twice", &mut cloth, 300, |cloth, tick| {
        fold(cloth, tick, [10, 100], &left, Vec3::NEG_Z, 0.004);
        fold(cloth, tick, [120, 210], &back, Vec3::X, 0.006);
    });
    assert_eq!((most, last), (0, 0));
    let (low, high) = bounds(&cloth);
    let size = high - low;
    assert!(size.x < 0.6 && size.z < 0.6 && size.y < 0.1, "it lies {size} m large");
}

#[test]
fn sheets_that_meet_in_free_flight_keep_momentum_and_do_not_cross() {
    let mut desc = sheets(2, 16, 0.5, |sheet, x| {
        Quat::from_rotation_z(0.2 * sheet as f32) * x + Vec3::Y * (0.08 * sheet as f32)
    });
    let (settings, material) = crate::common::bare();
    desc.settings =
        Settings { gravity: Vec3::ZERO, self_collision: SelfCollision::Surface, ..settings };
    desc.material = material;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    for i in 0..512 {
        cloth.set_velocity(i, Vec3::Y * if i < 256 { 1.0 } else { -1.0 }).unwrap();
    }
    let sums = |cloth: &Cloth| {
        let mass = |i: usize| cloth.mass(i as u32).unwrap();
        let of = |i: usize| cloth.velocity(i as u32).unwrap() * mass(i);
        let linear: Vec3 = (0..512).map(of).sum();
        let angular: Vec3 = (0..512).map(|i| cloth.positions()[i].cross(of(i))).sum();
        (linear, angular)
    };
    let start = sums(&cloth);
    let (most, _) = watch("flight", &mut cloth, 60, |_, _| ());
    let end = sums(&cloth);
    println!("{start:?} {end:?}");
    assert_eq!(most, 0);
    let one = 0.18 * 0.25;
    assert!((end.0 - start.0).length() < 1.0e-3 * one, "{:?} was {:?}", end.0, start.0);
}

/// A sheet that stands on its edge over a floor and is about to crumple, as a seed disturbs it.
fn standing(side: u32, seed: u32) -> Cloth {
    let spacing = 1.0 / side as f32;
    let desc = GridDesc { columns: side, rows: side, spacing, ..GridDesc::default() };
    let desc = GridDesc { pin_mode: PinMode::None, settings: surface(), ..desc };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&floor(-1.05)).unwrap();
    for i in (seed..side * side).step_by(7) {
        cloth.set_velocity(i, Vec3::Z * 0.05 * (((i + seed) % 5) as f32 - 2.0)).unwrap();
    }
    cloth
}

/// When pairs are listed makes no difference: a restored cloth lists them at another time.
#[test]
fn a_restored_cloth_goes_on_in_the_same_bits() {
    let mut cloth = standing(16, 0);
    for tick in 0..100 {
        if tick == 15 {
            let at = |x: f32| Vec3::new(x, -0.8, -1.0);
            assert!(cloth.cut(at(0.2), at(0.8), Vec3::Z * 2.0).unwrap() > 0);
        }
        if tick == 50 {
            assert!(cloth.tear_edge(120, 121).unwrap());
        }
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        cloth.step(1);
        restored.step(1);
        assert_eq!(restored.state_hash(), cloth.state_hash(), "tick {tick}");
    }
    assert!(cloth.positions().len() > 257, "nothing was cut and torn");
}

#[test]
fn without_it_layers_do_cross() {
    let mut cloth = standing(24, 0);
    let settings = Settings { self_collision: SelfCollision::None, ..surface() };
    cloth.set_settings(settings).unwrap();
    let (most, _) = watch("none", &mut cloth, 120, |_, _| ());
    assert!(most > 50, "{most} crossings");
}

#[test]
fn a_flat_sheet_and_its_cut_feel_nothing_of_themselves() {
    let mut desc = crate::common::bare_grid(9, 9, 0.1, PinMode::None);
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.self_collision = SelfCollision::Surface;
    for distance in [0.0, 0.05] {
        desc.settings.self_distance = distance;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let (from, to) = (Vec3::new(-0.1, -0.33, -1.0), Vec3::new(0.61, -0.37, -1.0));
        assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 5);
        let start = cloth.positions().to_vec();
        cloth.step(10);
        let most = cloth.positions().iter().zip(&start).map(|(x, at)| (x - at).length());
        let most = most.fold(0.0, f32::max);
        println!("flat: it moved by {most:e} m, {:e} m/s at last", speed(&cloth));
        // The sides of the cut parted by some thousandths of the spacing, and come back by less than that.
        assert!(most < 3.0e-4, "it moved by {most} m, at a distance of {distance} m");
        assert!(speed(&cloth) < 1.0e-3, "it moves on at {} m/s", speed(&cloth));
        assert_eq!(crossing_count(&cloth), 0);
    }
}

#[test]
fn what_is_pinned_stays_where_it_is_pinned() {
    let mut desc = sheets(2, 12, 0.4, |sheet, x| x + Vec3::Y * (0.1 * sheet as f32));
    desc.pinned = vec![0, 11, 132, 143];
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let before: Vec<Vec3> = desc.pinned.iter().map(|i| cloth.positions()[*i as usize]).collect();
    let (most, _) = watch("pinned", &mut cloth, 120, |_, _| ());
    assert_eq!(most, 0);
    let after: Vec<Vec3> = desc.pinned.iter().map(|i| cloth.positions()[*i as usize]).collect();
    assert_eq!(before, after);
}

#[test]
fn a_bounded_sheet_that_is_dragged_tears_and_keeps_from_itself() {
    let mut desc = GridDesc { columns: 12, rows: 12, settings: surface(), ..GridDesc::default() };
    (desc.settings.tearing, desc.settings.max_stretch) = (true, 0.5);
    desc.material.tear_stretch = 1.1;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let grab = cloth.grab_particle(100).unwrap();
    let from = cloth.positions()[100];
    for tick in 0..60 {
        cloth.move_grab(grab, from + Vec3::new(0.02, -0.03, 0.02) * tick as f32).unwrap();
        cloth.step(1);
    }
    assert!(cloth.positions().len() > 150, "only {} particles", cloth.positions().len());
    assert!(cloth.positions().iter().all(|x| x.is_finite()));
}

/// Rips a sheet by its grabbed corner and cuts it, restores it in between, and counts crossings all the while.
fn rip_and_cut(name: &str, mut cloth: Cloth, ticks: u32) {
    let (low, high) = bounds(&cloth);
    let middle = 0.5 * (low + high);
    let wide = Vec3::X * (0.3 * (high.x - low.x));
    let (from, to) = (middle - wide, middle + wide + Vec3::Y * 0.02);
    let opened = cloth.cut(from - Vec3::Z, to - Vec3::Z, Vec3::Z * 2.0).unwrap();
    assert!(opened > 5, "{name}: the cut opened {opened} edges");
    let before = cloth.positions().len();
    let grab = cloth.grab_particle(0).unwrap();
    let held = cloth.positions()[0];
    let (most, last) = watch(name, &mut cloth, ticks, |cloth, tick| {
        if tick == 10 {
            assert!(cloth.tear_edge(before as u32 / 2, before as u32 / 2 + 1).unwrap());
        }
        cloth.move_grab(grab, held + Vec3::new(0.004, 0.006, 0.012) * tick as f32).unwrap();
        if tick % 20 == 5 {
            let mut restored = Cloth::restore(&cloth.save()).unwrap();
            let mut straight = cloth.clone();
            restored.step(2);
            straight.step(2);
            assert_eq!(restored.state_hash(), straight.state_hash(), "{name}, tick {tick}");
        }
    });
    let torn = cloth.positions().len() - before;
    assert!(torn > 3, "{name}: only {torn} more particles");
    assert_eq!((most, last), (0, 0), "{name}");
}

fn bounds(cloth: &Cloth) -> (Vec3, Vec3) {
    let mut all = cloth.positions().iter();
    let first = *all.next().unwrap();
    all.fold((first, first), |(low, high), x| (low.min(*x), high.max(*x)))
}

#[test]
fn a_hanging_sheet_that_is_ripped_and_cut_does_not_cross_itself() {
    let mut desc = GridDesc { columns: 20, rows: 20, settings: surface(), ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.15;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(30);
    rip_and_cut("hanging rip", cloth, 90);
}

/// What a leash pulls at the end of a tick is where it is to be, and what lies there gives way.
#[test]
fn what_leashes_lead_pushes_other_layers_along() {
    let mut desc = sheets(2, 12, 0.4, |sheet, x| x + Vec3::Y * (0.02 * sheet as f32));
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.max_stretch = 0.1;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let led: Vec<u32> = (144..288).collect();
    let (start, most_off) = (cloth.positions()[144..].to_vec(), 0.001);
    cloth.set_max_distances(&led, &[most_off; 144]).unwrap();
    let mut anchors = start.clone();
    let (most, _) = watch("led", &mut cloth, 60, |cloth, tick| {
        for (anchor, at) in anchors.iter_mut().zip(&start) {
            let slope = 0.3 * at.x;
            *anchor = *at - Vec3::Y * ((0.004 + 0.01 * slope.abs()) * tick as f32);
        }
        cloth.set_anchors(&led, &anchors, &[]).unwrap();
    });
    let off = cloth.positions()[144..].iter().zip(&anchors).map(|(x, at)| x.distance(*at));
    let off = off.fold(0.0, f32::max);
    println!("led: {most} crossings, {off:.6} m off their anchors at most");
    assert_eq!(most, 0);
    assert!(off < most_off + 1e-5, "{off} m off an anchor");
    let lower = cloth.positions()[..144].iter().map(|x| x.y).fold(f32::MIN, f32::max);
    assert!(lower < -0.15, "the sheet below is at {lower} m");
}
