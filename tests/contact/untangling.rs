//! Untangling: surfaces that already intersect are separated, whatever the kind of intersection,
//! and come to rest.

use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Settings};

use crate::common::crossings::crossing_count;
use crate::common::garments::{moebius_strip, shirt};

/// Particles along a side of a sheet, and the length of a side [m].
const SIDE: u32 = 20;
const SIZE: f32 = 0.5;

fn settings_with(self_collision: SelfCollision) -> Settings {
    Settings { self_collision, ..Settings::default() }
}

/// Two sheets in one mesh. The first lies at height 0, its border pinned if `is_pinned`. `place`
/// gives the positions of the second from coordinates that run from 0 to 1 along its sides.
fn two_sheets(is_pinned: bool, place: impl Fn(f32, f32) -> Vec3) -> MeshDesc {
    let settings = settings_with(SelfCollision::Surface);
    let mut desc = MeshDesc { settings, ..MeshDesc::default() };
    let at = |k: u32| k as f32 / (SIDE - 1) as f32;
    for sheet in 0..2 {
        let first = desc.positions.len() as u32;
        for (row, column) in (0..SIDE * SIDE).map(|k| (k / SIDE, k % SIDE)) {
            let (u, v) = (at(column), at(row));
            let lies = Vec3::new(u * SIZE, 0.0, v * SIZE);
            desc.positions.push(if sheet == 0 { lies } else { place(u, v) });
            let is_border = [row, column].iter().any(|k| *k == 0 || *k == SIDE - 1);
            if is_pinned && sheet == 0 && is_border {
                desc.pinned.push(first + row * SIDE + column);
            }
            if row < SIDE - 1 && column < SIDE - 1 {
                let a = first + row * SIDE + column;
                desc.indices.extend([a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1]);
            }
        }
    }
    desc
}

/// Runs `ticks` ticks, and returns the last one that ended with intersections. Looks at each of the
/// first `most`, of the last half second, and at every tenth between them.
fn ticks_until_untangled(name: &str, cloth: &mut Cloth, most: u32, ticks: u32) -> u32 {
    let before = crossing_count(cloth);
    assert!(before >= 8, "{name}: only {before} intersections at the start");
    let mut last = 0;
    for tick in 1..=ticks {
        cloth.step(1);
        let counts = tick <= most + 1 || tick % 10 == 0 || tick + 30 > ticks;
        if counts && crossing_count(cloth) > 0 {
            last = tick;
        }
    }
    let speed = cloth.stats().max_speed;
    println!("{name}: {before} intersections, none after {last} ticks; {speed:.5} m/s at most");
    last
}

/// Runs `ticks` ticks; asserts that the last intersection disappears before tick `most` and that
/// none comes back, up to and including the last half second.
fn assert_untangles(name: &str, cloth: &mut Cloth, most: u32, ticks: u32) {
    let last = ticks_until_untangled(name, cloth, most, ticks);
    let now = crossing_count(cloth);
    assert!(last < most, "{name}: {now} intersections, the last after {last} ticks");
}

#[test]
fn a_bump_pushed_through_a_sheet_is_untangled() {
    for depth in [0.02, 0.06, 0.12] {
        let bump = |u: f32, v: f32| {
            let square = (u - 0.47).powi(2) + (v - 0.52).powi(2);
            Vec3::new(u * SIZE, 0.01 - (0.01 + depth) * (-square / 0.02).exp(), v * SIZE)
        };
        let mut cloth = Cloth::mesh(&two_sheets(true, bump)).unwrap();
        assert_untangles(&format!("a bump {depth} m deep"), &mut cloth, 20, 120);
        let speed = cloth.stats().max_speed;
        assert!(speed < 0.02, "after two seconds the highest speed is {speed} m/s");
        let low = cloth.positions()[(SIDE * SIDE) as usize..].iter().map(|x| x.y);
        let low = low.fold(f32::INFINITY, f32::min);
        assert!(low > -0.1, "the upper sheet is at {low} m");
    }
}

#[test]
fn a_corner_pushed_through_a_sheet_is_untangled() {
    for share in [0.1, 0.25, 0.45] {
        let corner = |u: f32, v: f32| {
            let across = 0.251 + (u - v) * SIZE * 0.5;
            Vec3::new(across, ((u + v) * 0.7 - share) * SIZE, 0.2533 + 0.05 * (u + v))
        };
        let mut cloth = Cloth::mesh(&two_sheets(true, corner)).unwrap();
        assert_untangles(&format!("a corner, {share}"), &mut cloth, 45, 120);
    }
}

#[test]
fn a_sheet_that_stands_through_another_is_untangled() {
    let most = 60;
    let shares = [0.1, 0.24, 0.28, 0.3, 0.32, 0.36, 0.45, 0.5];
    let ticks = shares.map(|share| {
        let standing = |u: f32, v: f32| {
            let x = 0.1513 + u * SIZE * 0.6;
            Vec3::new(x, (v - share) * SIZE * 0.6, 0.2533 + 0.02 * v)
        };
        let mut cloth = Cloth::mesh(&two_sheets(true, standing)).unwrap();
        ticks_until_untangled(&format!("a sheet, {share}"), &mut cloth, most, 90)
    });
    // One place along the sheet may take far longer than the others.
    let mean = ticks.iter().sum::<u32>() as f32 / ticks.len() as f32;
    assert!(mean <= 15.0 && ticks.iter().all(|last| *last < most), "{ticks:?}, {mean} on average");
}

/// Two sheets that intersect along a line that starts at a border of each, like interleaved cards:
/// neither has an enclosed part on the wrong side.
fn interleaved_sheets() -> MeshDesc {
    let mut desc = two_sheets(false, |u, v| {
        Vec3::new(0.2513 + u * SIZE, v * SIZE - 0.2533, 0.2533 + 0.02 * v)
    });
    desc.settings.gravity = Vec3::ZERO;
    (desc.material.drag, desc.material.lift) = (0.0, 0.0);
    desc
}

/// Centre of mass [m].
fn centre_of_mass(cloth: &Cloth) -> Vec3 {
    let count = cloth.positions().len() as u32;
    let all = (0..count).map(|at| (cloth.mass(at).unwrap(), cloth.position(at).unwrap()));
    let (mass, sum) = all.fold((0.0, Vec3::ZERO), |(mass, sum), (m, x)| (mass + m, sum + x * m));
    sum / mass
}

#[test]
fn interleaved_sheets_are_untangled_and_keep_their_centre_of_mass() {
    let mut cloth = Cloth::mesh(&interleaved_sheets()).unwrap();
    let before = centre_of_mass(&cloth);
    assert_untangles("interleaved sheets", &mut cloth, 60, 120);
    let moved = centre_of_mass(&cloth).distance(before);
    assert!(moved < 1.0e-4, "the centre of mass moved by {moved} m");
}

/// A garment that hung for ten seconds without self-collision, with surface collision just switched
/// on.
fn garment_with_late_collision(desc: MeshDesc) -> Cloth {
    let mut cloth =
        Cloth::mesh(&MeshDesc { settings: settings_with(SelfCollision::None), ..desc }).unwrap();
    cloth.step(600);
    cloth.set_settings(settings_with(SelfCollision::Surface)).unwrap();
    cloth
}

#[test]
fn garments_that_hung_without_self_collision_are_untangled() {
    for (name, desc) in [("shirt", shirt()), ("moebius strip", moebius_strip())] {
        assert_untangles(name, &mut garment_with_late_collision(desc), 90, 240);
    }
}

/// A sheet that fell on its edge and crumpled with `mode`, with surface collision just switched on.
fn crumpled_heap(seed: u32, mode: SelfCollision) -> Cloth {
    let spacing = 1.0 / SIDE as f32;
    let desc = GridDesc { columns: SIDE, rows: SIDE, spacing, ..GridDesc::default() };
    let desc = GridDesc { pin_mode: PinMode::None, settings: settings_with(mode), ..desc };
    let mut cloth = Cloth::grid(&desc).unwrap();
    let floor = ColliderDesc { position: Vec3::Y * -1.05, ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    for i in (seed..SIDE * SIDE).step_by(7) {
        cloth.set_velocity(i, Vec3::Z * 0.05 * (((i + seed) % 5) as f32 - 2.0)).unwrap();
    }
    cloth.step(90);
    cloth.set_settings(settings_with(SelfCollision::Surface)).unwrap();
    cloth
}

#[test]
fn a_heap_that_crumpled_with_particle_collision_is_untangled() {
    for seed in 0..4 {
        let mut cloth = crumpled_heap(seed, SelfCollision::Particles);
        assert_untangles(&format!("heap {seed}"), &mut cloth, 60, 120);
    }
}

#[test]
fn a_heap_that_crumpled_without_self_collision_is_untangled() {
    for seed in 0..2 {
        let mut cloth = crumpled_heap(seed, SelfCollision::None);
        assert_untangles(&format!("heap {seed}"), &mut cloth, 400, 460);
    }
}

#[test]
fn a_corner_placed_through_the_sheet_by_set_position_is_untangled() {
    let spacing = SIZE / (SIDE - 1) as f32;
    let settings = settings_with(SelfCollision::Surface);
    let desc = GridDesc { columns: SIDE, rows: SIDE, spacing, settings, ..GridDesc::default() };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(30);
    // Fold the right part over the rest at a slight angle and place its corner through the sheet.
    let hinge = 12;
    for at in 0..SIDE * SIDE {
        let (row, column) = (at / SIDE, at % SIDE);
        if column > hinge {
            let over = (column - hinge) as f32 * spacing;
            let x = cloth.position(row * SIDE + hinge).unwrap();
            let off = 0.02 - 0.05 * (row as f32 / SIDE as f32).powi(3) * over / 0.15;
            cloth.set_position(at, x + Vec3::new(-over, 0.0, off * over / 0.15)).unwrap();
        }
    }
    assert_untangles("a lapel", &mut cloth, 60, 120);
}

#[test]
fn pinned_sheets_moved_through_each_other_are_untangled_after_unpinning() {
    let standing =
        |u: f32, v: f32| Vec3::new(0.1513 + u * SIZE * 0.6, 0.02 + v * 0.3, 0.2533 + 0.02 * v);
    let mut desc = two_sheets(false, standing);
    desc.pinned = (0..2 * SIDE * SIDE).collect();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let upper: Vec<u32> = (SIDE * SIDE..2 * SIDE * SIDE).collect();
    for tick in 1..=30 {
        let down = Vec3::NEG_Y * 0.004 * tick as f32;
        let targets: Vec<Vec3> =
            upper.iter().map(|at| desc.positions[*at as usize] + down).collect();
        cloth.set_pin_targets(&upper, &targets).unwrap();
        cloth.step(1);
    }
    // While all particles are pinned, the sheets keep intersecting.
    cloth.step(30);
    assert!(crossing_count(&cloth) > 0);
    upper.iter().for_each(|at| cloth.unpin(*at).unwrap());
    assert_untangles("a sheet moved through", &mut cloth, 60, 120);
}

#[test]
fn a_cloth_restored_while_it_untangles_continues_with_the_same_bits() {
    let mut all = [
        ("interleaved sheets", Cloth::mesh(&interleaved_sheets()).unwrap()),
        ("shirt", garment_with_late_collision(shirt())),
        ("heap", crumpled_heap(0, SelfCollision::None)),
    ];
    for (name, cloth) in &mut all {
        for _ in 0..4 {
            assert!(crossing_count(cloth) > 0, "{name} is untangled too early");
            let mut restored = Cloth::restore(&cloth.save()).unwrap();
            assert_eq!(restored.state_hash(), cloth.state_hash(), "{name}");
            cloth.step(1);
            restored.step(1);
            assert_eq!(restored.state_hash(), cloth.state_hash(), "{name}");
        }
    }
}
