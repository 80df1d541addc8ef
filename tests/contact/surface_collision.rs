//! Surface collision: triangles never intersect, sheets rest on each other at the rest gap,
//! momentum is conserved, and pins and grabs keep their targets.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Settings, Shape};

use crate::common::crossings::crossing_count;
use crate::common::rms_speed;

/// Default settings with surface collision.
fn surface_settings() -> Settings {
    Settings { self_collision: SelfCollision::Surface, ..Settings::default() }
}

/// A horizontal grid of `side` × `side` particles, centred over the origin at `height` [m].
fn horizontal_sheet(side: u32, size: f32, height: f32) -> GridDesc {
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
        settings: surface_settings(),
        ..GridDesc::default()
    }
}

/// `count` sheets of `side` × `side` particles in one mesh; `place` gives their positions.
fn stacked_sheets(count: u32, side: u32, size: f32, place: impl Fn(u32, Vec3) -> Vec3) -> MeshDesc {
    let mut desc = MeshDesc { settings: surface_settings(), ..MeshDesc::default() };
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

fn floor_at(height: f32) -> ColliderDesc {
    ColliderDesc { position: Vec3::Y * height, ..ColliderDesc::default() }
}

fn sphere_at(radius: f32, position: Vec3) -> ColliderDesc {
    ColliderDesc { shape: Shape::Sphere, radius, position, ..ColliderDesc::default() }
}

/// Runs `act` and one step per tick; returns the largest and the last number of intersecting
/// triangle pairs, counted every fifth tick.
fn most_and_last_crossings(
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
        "{name}: {most} at most, {last} at the end; rms {:.2} mm/s, {:.2} ms a tick, at most {:.2}",
        1.0e3 * rms_speed(cloth),
        1.0e3 * spent / f64::from(ticks),
        1.0e3 * worst
    );
    (most, last)
}

/// The vertices lie above each other, so pairs of edges meet at their ends.
#[test]
fn stacked_sheets_rest_one_thickness_apart() {
    let (sheets, side) = (5, 16);
    let count = (side * side) as usize;
    let mut desc =
        stacked_sheets(sheets, side, 0.5, |sheet, x| x + Vec3::Y * (0.02 + 0.05 * sheet as f32));
    desc.material.thickness = 0.002;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    cloth.add_collider(&floor_at(0.0)).unwrap();
    let name = format!("{sheets} sheets of {side} x {side}");
    let (most, _) = most_and_last_crossings(&name, &mut cloth, 180, |_, _| ());
    assert_eq!(most, 0, "{name}");
    let all: Vec<f32> = cloth.positions().iter().map(|x| x.y).collect();
    let heights: Vec<f32> =
        all.chunks(count).map(|of| of.iter().sum::<f32>() / count as f32).collect();
    println!("heights {heights:?}");
    for pair in heights.windows(2) {
        let gap = (pair[1] - pair[0]) / 0.002;
        assert!((0.98..1.02).contains(&gap), "{name}: {gap} thicknesses");
    }
    assert!(rms_speed(&cloth) < 2.0e-4, "{name}: {} m/s", rms_speed(&cloth));
}

/// Contacts that had pushed before the stack landed rebounded, so a stack of eight layers bounced on
/// its floor for ever.
#[test]
fn a_stack_of_eight_sheets_rests() {
    for (thickness, shift) in [(0.002, 0.0), (0.0003, 0.0037)] {
        let mut desc = stacked_sheets(8, 9, 0.22, |sheet, x| {
            let aside = Vec3::new(1.0, 0.0, 0.37) * shift * sheet as f32;
            x + aside + Vec3::Y * (0.02 + 0.01 * sheet as f32)
        });
        desc.material.thickness = thickness;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        cloth.add_collider(&floor_at(0.0)).unwrap();
        cloth.step(200);
        let name = format!("sheets of {thickness} m, shifted by {shift} m");
        let speed = rms_speed(&cloth);
        println!("{name}: {speed} m/s");
        assert!(speed < 1.0e-3, "{name}: {speed} m/s");
    }
}

#[test]
fn a_sheet_that_falls_on_its_edge_crumples_without_self_intersection() {
    let mut cloth = standing_sheet(32, 0);
    let (most, last) = most_and_last_crossings("edge", &mut cloth, 400, |_, _| ());
    assert_eq!((most, last), (0, 0));
    assert!(rms_speed(&cloth) < 1.5e-3, "the heap moves at {} m/s", rms_speed(&cloth));
}

/// A row of cells can fold over completely within one substep and land on the next row.
#[test]
fn cells_that_fold_over_within_one_substep_do_not_intersect() {
    let (most, last) =
        most_and_last_crossings("landing", &mut standing_sheet(64, 5), 32, |_, _| ());
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_sheet_draped_over_a_ball_and_a_floor_does_not_intersect_itself() {
    let mut cloth = Cloth::grid(&horizontal_sheet(64, 1.6, 0.5)).unwrap();
    cloth.add_collider(&sphere_at(0.3, Vec3::Y * 0.1)).unwrap();
    cloth.add_collider(&floor_at(-0.3)).unwrap();
    let (most, last) = most_and_last_crossings("ball", &mut cloth, 120, |_, _| ());
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_sheet_on_a_turning_ball_does_not_intersect_itself() {
    let mut cloth = Cloth::grid(&horizontal_sheet(40, 1.4, 0.45)).unwrap();
    let ball = cloth.add_collider(&sphere_at(0.3, Vec3::Y * 0.1)).unwrap();
    cloth.add_collider(&floor_at(-0.25)).unwrap();
    let (most, last) = most_and_last_crossings("turning", &mut cloth, 240, |cloth, tick| {
        let turn = Quat::from_rotation_y((tick as f32 - 60.0).max(0.0) * 0.04);
        cloth.move_collider(ball, Vec3::Y * 0.1, turn).unwrap();
    });
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_curtain_that_falls_over_a_ball_does_not_intersect_itself() {
    let desc = GridDesc {
        columns: 40,
        rows: 40,
        spacing: 0.03,
        origin: Vec3::new(-0.6, 1.6, 0.0),
        settings: surface_settings(),
        pin_mode: PinMode::TopEdge,
        ..GridDesc::default()
    };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&sphere_at(0.25, Vec3::new(0.0, 0.3, 0.05))).unwrap();
    cloth.add_collider(&floor_at(0.0)).unwrap();
    let (most, last) = most_and_last_crossings("curtain", &mut cloth, 150, |cloth, tick| {
        if tick == 40 {
            cloth.unpin_all();
        }
    });
    assert_eq!((most, last), (0, 0));
}

/// Pins `edge`, turns it by π about `axis` at `height` [m] between the ticks `from` and `to`, and
/// unpins it.
fn fold_edge_over(
    cloth: &mut Cloth,
    tick: u32,
    [from, to]: [u32; 2],
    edge: &[u32],
    axis: Vec3,
    height: f32,
) {
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
fn a_sheet_folded_once_and_released_does_not_intersect_itself() {
    let side = 33;
    let mut cloth = Cloth::grid(&horizontal_sheet(side, 0.8, 0.001)).unwrap();
    cloth.add_collider(&floor_at(0.0)).unwrap();
    let left: Vec<u32> = (0..side).map(|k| k * side).collect();
    let (most, last) = most_and_last_crossings("fold", &mut cloth, 200, |cloth, tick| {
        fold_edge_over(cloth, tick, [10, 100], &left, Vec3::NEG_Z, 0.004);
    });
    assert_eq!((most, last), (0, 0));
}

#[test]
fn a_sheet_folded_twice_and_released_stays_folded_without_self_intersection() {
    let side = 33;
    let mut cloth = Cloth::grid(&horizontal_sheet(side, 0.8, 0.001)).unwrap();
    cloth.add_collider(&floor_at(0.0)).unwrap();
    let left: Vec<u32> = (0..side).map(|k| k * side).collect();
    let back: Vec<u32> = (0..side).collect();
    let (most, last) = most_and_last_crossings("fold twice", &mut cloth, 300, |cloth, tick| {
        fold_edge_over(cloth, tick, [10, 100], &left, Vec3::NEG_Z, 0.004);
        fold_edge_over(cloth, tick, [120, 210], &back, Vec3::X, 0.006);
    });
    assert_eq!((most, last), (0, 0));
    let (low, high) = bounds(&cloth);
    let size = high - low;
    assert!(size.x < 0.6 && size.z < 0.6 && size.y < 0.1, "the folded sheet measures {size} m");
}

#[test]
fn sheets_that_collide_in_free_flight_conserve_momentum_and_do_not_intersect() {
    let mut desc = stacked_sheets(2, 16, 0.5, |sheet, x| {
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
    let momenta = |cloth: &Cloth| {
        let mass = |i: usize| cloth.mass(i as u32).unwrap();
        let of = |i: usize| cloth.velocity(i as u32).unwrap() * mass(i);
        let linear: Vec3 = (0..512).map(of).sum();
        let angular: Vec3 = (0..512).map(|i| cloth.positions()[i].cross(of(i))).sum();
        (linear, angular)
    };
    let start = momenta(&cloth);
    let (most, _) = most_and_last_crossings("flight", &mut cloth, 60, |_, _| ());
    let end = momenta(&cloth);
    println!("{start:?} {end:?}");
    assert_eq!(most, 0);
    let one = 0.18 * 0.25;
    assert!((end.0 - start.0).length() < 1.0e-3 * one, "{:?} was {:?}", end.0, start.0);
}

/// A sheet that stands on its edge over a floor and is about to crumple; `seed` varies the initial
/// velocities.
fn standing_sheet(side: u32, seed: u32) -> Cloth {
    let spacing = 1.0 / side as f32;
    let desc = GridDesc { columns: side, rows: side, spacing, ..GridDesc::default() };
    let desc = GridDesc { pin_mode: PinMode::None, settings: surface_settings(), ..desc };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&floor_at(-1.05)).unwrap();
    for i in (seed..side * side).step_by(7) {
        cloth.set_velocity(i, Vec3::Z * 0.05 * (((i + seed) % 5) as f32 - 2.0)).unwrap();
    }
    cloth
}

/// A restored cloth rebuilds its pair cache at another tick, which must not change the result.
#[test]
fn a_cloth_restored_while_it_crumples_continues_with_the_same_bits() {
    let mut cloth = standing_sheet(16, 0);
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
fn a_sheet_without_self_collision_intersects_itself() {
    let mut cloth = standing_sheet(24, 0);
    let settings = Settings { self_collision: SelfCollision::None, ..surface_settings() };
    cloth.set_settings(settings).unwrap();
    let (most, _) = most_and_last_crossings("none", &mut cloth, 120, |_, _| ());
    assert!(most > 50, "{most} crossings");
}

#[test]
fn a_flat_sheet_with_a_cut_does_not_collide_with_itself() {
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
        println!("flat: moved by {most:e} m, {:e} m/s at the end", rms_speed(&cloth));
        // The sides of the cut separate by a few thousandths of the spacing and return by less.
        assert!(most < 3.0e-4, "the sheet moved by {most} m, at a distance of {distance} m");
        assert!(rms_speed(&cloth) < 1.0e-3, "the sheet still moves at {} m/s", rms_speed(&cloth));
        assert_eq!(crossing_count(&cloth), 0);
    }
}

#[test]
fn pinned_particles_keep_their_positions_in_surface_contact() {
    let mut desc = stacked_sheets(2, 12, 0.4, |sheet, x| x + Vec3::Y * (0.1 * sheet as f32));
    desc.pinned = vec![0, 11, 132, 143];
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let before: Vec<Vec3> = desc.pinned.iter().map(|i| cloth.positions()[*i as usize]).collect();
    let (most, _) = most_and_last_crossings("pinned", &mut cloth, 120, |_, _| ());
    assert_eq!(most, 0);
    let after: Vec<Vec3> = desc.pinned.iter().map(|i| cloth.positions()[*i as usize]).collect();
    assert_eq!(before, after);
}

#[test]
fn a_dragged_sheet_with_a_stretch_limit_tears_and_stays_finite() {
    let mut desc =
        GridDesc { columns: 12, rows: 12, settings: surface_settings(), ..GridDesc::default() };
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

/// Cuts a sheet and tears it by a grabbed corner; asserts that it never intersects itself and that
/// restored cloths continue with the same bits.
fn assert_rip_and_cut_without_crossings(name: &str, mut cloth: Cloth, ticks: u32) {
    let (low, high) = bounds(&cloth);
    let middle = 0.5 * (low + high);
    let wide = Vec3::X * (0.3 * (high.x - low.x));
    let (from, to) = (middle - wide, middle + wide + Vec3::Y * 0.02);
    let opened = cloth.cut(from - Vec3::Z, to - Vec3::Z, Vec3::Z * 2.0).unwrap();
    assert!(opened > 5, "{name}: the cut opened {opened} edges");
    let before = cloth.positions().len();
    let grab = cloth.grab_particle(0).unwrap();
    let start = cloth.positions()[0];
    let (most, last) = most_and_last_crossings(name, &mut cloth, ticks, |cloth, tick| {
        if tick == 10 {
            assert!(cloth.tear_edge(before as u32 / 2, before as u32 / 2 + 1).unwrap());
        }
        cloth.move_grab(grab, start + Vec3::new(0.004, 0.006, 0.012) * tick as f32).unwrap();
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

/// Lower and upper corner of the bounding box [m].
fn bounds(cloth: &Cloth) -> (Vec3, Vec3) {
    let mut all = cloth.positions().iter();
    let first = *all.next().unwrap();
    all.fold((first, first), |(low, high), x| (low.min(*x), high.max(*x)))
}

#[test]
fn a_hanging_sheet_that_is_torn_and_cut_does_not_intersect_itself() {
    let mut desc =
        GridDesc { columns: 20, rows: 20, settings: surface_settings(), ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.15;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(30);
    assert_rip_and_cut_without_crossings("hanging rip", cloth, 90);
}

/// The max distance to the anchor holds at the end of a tick; surfaces in the path give way.
#[test]
fn particles_led_by_anchors_push_other_surfaces_along() {
    let mut desc = stacked_sheets(2, 12, 0.4, |sheet, x| x + Vec3::Y * (0.02 * sheet as f32));
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.max_stretch = 0.1;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let anchored: Vec<u32> = (144..288).collect();
    let (start, max_distance) = (cloth.positions()[144..].to_vec(), 0.001);
    cloth.set_max_distances(&anchored, &[max_distance; 144]).unwrap();
    let mut anchors = start.clone();
    let (most, _) = most_and_last_crossings("anchored", &mut cloth, 60, |cloth, tick| {
        for (anchor, at) in anchors.iter_mut().zip(&start) {
            let slope = 0.3 * at.x;
            *anchor = *at - Vec3::Y * ((0.004 + 0.01 * slope.abs()) * tick as f32);
        }
        cloth.set_anchors(&anchored, &anchors, &[]).unwrap();
    });
    let off = cloth.positions()[144..].iter().zip(&anchors).map(|(x, at)| x.distance(*at));
    let off = off.fold(0.0, f32::max);
    println!("anchored: {most} crossings, at most {off:.6} m from the anchors");
    assert_eq!(most, 0);
    assert!(off < max_distance + 1e-5, "{off} m from an anchor");
    let lower = cloth.positions()[..144].iter().map(|x| x.y).fold(f32::MIN, f32::max);
    assert!(lower < -0.15, "the sheet below is at {lower} m");
}
