//! Cuts and tears with surface collision: the two sides of a fresh tear do not intersect.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Event, GridDesc, Material, PinMode, SelfCollision, Settings};

use crate::common::crossings::crossing_count;

const SURFACE: SelfCollision = SelfCollision::Surface;

/// A sheet that stood on its edge over a floor and crumpled; `seed` varies the initial velocities.
fn crumpled_sheet(side: u32, seed: u32, ticks: u32) -> Cloth {
    let spacing = 1.0 / side as f32;
    let settings = Settings { self_collision: SURFACE, ..Settings::default() };
    let desc = GridDesc { columns: side, rows: side, spacing, settings, ..GridDesc::default() };
    let desc = GridDesc { extra_particles: 2 * side * side, ..desc };
    let mut cloth = Cloth::grid(&GridDesc { pin_mode: PinMode::None, ..desc }).unwrap();
    let floor = ColliderDesc { position: Vec3::Y * -1.05, ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    for i in (seed..side * side).step_by(7) {
        let push = ((i + seed) % 5) as f32 - 2.0;
        cloth.set_velocity(i, Vec3::Z * 0.05 * push).unwrap();
    }
    cloth.step(ticks);
    assert_eq!(crossing_count(&cloth), 0, "the sheet intersects itself before any tear");
    let (low, high) = bounds(&cloth);
    assert!(high.y - low.y < 0.75, "the sheet is {} m high", high.y - low.y);
    cloth
}

/// Lower and upper corner of the bounding box [m].
fn bounds(cloth: &Cloth) -> (Vec3, Vec3) {
    let mut all = cloth.positions().iter();
    let first = *all.next().unwrap();
    all.fold((first, first), |(low, high), x| (low.min(*x), high.max(*x)))
}

/// Cuts through the whole heap from above, turned about the vertical by `turn` [rad] and offset
/// from its centre by `beside` [m]; returns the number of opened edges.
fn cut_from_above(cloth: &mut Cloth, turn: f32, beside: f32) -> u32 {
    let (low, high) = bounds(cloth);
    let [along, across] = [Vec3::X, Vec3::Z].map(|axis| Quat::from_rotation_y(turn) * axis);
    let above = 0.5 * (low + high) + across * beside + Vec3::Y * (high.y - low.y + 0.1);
    cloth.cut(above - along * 0.45, above + along * 0.45, Vec3::NEG_Y * 3.0).unwrap()
}

/// Runs `act` and one step per tick, and asserts that no triangles intersect before or after any
/// step. At two ticks it also asserts that a restored cloth continues with the same bits.
fn run_without_crossings(
    name: &str,
    cloth: &mut Cloth,
    ticks: u32,
    mut act: impl FnMut(&mut Cloth, u32),
) {
    for tick in 0..ticks {
        act(cloth, tick);
        assert_eq!(crossing_count(cloth), 0, "{name}: before tick {tick}");
        let checks_restore = tick == 1 || tick == ticks / 2;
        let restored = checks_restore.then(|| Cloth::restore(&cloth.save()).unwrap());
        cloth.step(1);
        if let Some(mut restored) = restored {
            restored.step(1);
            assert_eq!(restored.state_hash(), cloth.state_hash(), "{name}, tick {tick}");
        }
        assert_eq!(crossing_count(cloth), 0, "{name}: after tick {tick}");
    }
    println!("{name}: {} particles", cloth.positions().len());
    let (low, high) = bounds(cloth);
    assert!((high - low).length() < 3.0, "{name}: the sheet spreads from {low} to {high}");
}

/// Number of `PieceDetached` events; removes all pending events.
fn detached_piece_count(cloth: &mut Cloth) -> usize {
    let mut events: Vec<Event> = Vec::new();
    while let Some(event) = cloth.next_event() {
        events.push(event);
    }
    events.iter().filter(|event| event.kind == muslin::EventKind::PieceDetached).count()
}

/// One blade cuts through many folds, so that pieces are detached; further cuts follow at the same
/// place and across it.
#[test]
fn cutting_a_crumpled_sheet_causes_no_self_intersection() {
    for (side, seed, at) in [(16, 1, 90), (20, 3, 60), (24, 1, 45), (24, 2, 90)] {
        let mut cloth = crumpled_sheet(side, seed, at);
        let turn = 0.4 * seed as f32;
        let opened = cut_from_above(&mut cloth, turn, 0.01);
        assert!(opened > side, "only {opened} edges opened");
        assert_eq!(crossing_count(&cloth), 0, "right after the cut");
        cut_from_above(&mut cloth, turn, 0.01);
        let name = format!("cut {side} {seed} {at}");
        run_without_crossings(&name, &mut cloth, 36, |cloth, tick| {
            if tick == 12 {
                cut_from_above(cloth, turn, 0.01);
            }
            if tick == 20 {
                assert!(cut_from_above(cloth, turn + 1.5, 0.0) > 5);
            }
        });
        assert!(detached_piece_count(&mut cloth) > 0, "{name}: no piece was detached");
    }
}

/// `tear_edge` tears edges all over the sheet, some adjacent, until the reserve is used up.
#[test]
fn tearing_edges_of_a_crumpled_sheet_causes_no_self_intersection() {
    for (side, seed, at) in [(16, 2, 45), (20, 5, 130), (24, 1, 90)] {
        let mut cloth = crumpled_sheet(side, seed, at);
        let before = cloth.positions().len();
        run_without_crossings(
            &format!("torn {side} {seed} {at}"),
            &mut cloth,
            50,
            |cloth, tick| {
                let first = (seed * 31 + tick * 53) % (side * (side - 1));
                for a in first..first + 3 {
                    let b = if tick % 2 == 0 { a + 1 } else { a + side };
                    // The call refuses an edge that is torn already or does not exist.
                    let _ = cloth.tear_edge(a, b);
                }
            },
        );
        let torn = cloth.positions().len() - before;
        assert!(torn > 60, "only {torn} more particles");
    }
}

/// One grab holds a corner, another pulls the middle of a border out of the heap until the sheet
/// tears.
#[test]
fn ripping_a_crumpled_sheet_with_grabs_causes_no_self_intersection() {
    for (side, seed, at) in [(16, 2, 90), (20, 4, 60), (20, 5, 60), (24, 0, 90)] {
        let mut cloth = crumpled_sheet(side, seed, at);
        cloth.set_settings(Settings { tearing: true, ..*cloth.settings() }).unwrap();
        cloth.set_material(Material { tear_stretch: 1.1, ..*cloth.material() }).unwrap();
        let (before, particle) = (cloth.positions().len(), side / 2);
        let grab = cloth.grab_particle(particle).unwrap();
        cloth.grab_particle(side * side - 1).unwrap();
        let start = cloth.positions()[particle as usize];
        run_without_crossings(
            &format!("ripped {side} {seed} {at}"),
            &mut cloth,
            75,
            |cloth, tick| {
                let by = Vec3::new(0.006, 0.01, 0.018) * tick as f32;
                cloth.move_grab(grab, start + by).unwrap();
            },
        );
        let torn = cloth.positions().len() - before;
        assert!(torn > 4, "only {torn} more particles");
    }
}

/// A grabbed particle reaches its target exactly and pushes the surfaces in its path.
#[test]
fn a_particle_pulled_through_a_heap_pushes_the_surfaces_in_its_path() {
    let (side, particle) = (24, 12);
    let mut cloth = crumpled_sheet(side, 0, 90);
    let grab = cloth.grab_particle(particle).unwrap();
    cloth.grab_particle(side * side - 1).unwrap();
    let start = cloth.positions()[particle as usize];
    let by = |tick: u32| Vec3::new(0.006, 0.01, 0.018) * tick as f32;
    run_without_crossings("pulled", &mut cloth, 45, |cloth, tick| {
        cloth.move_grab(grab, start + by(tick)).unwrap();
    });
    assert_eq!(cloth.positions()[particle as usize], start + by(44));
}

/// A wrinkled sheet that rotates in free flight.
fn flying_sheet(self_collision: SelfCollision) -> Cloth {
    let mut desc = crate::common::bare_grid(12, 12, 0.05, PinMode::None);
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.self_collision = self_collision;
    let mut cloth = Cloth::grid(&desc).unwrap();
    for i in 0..144 {
        let x = cloth.positions()[i as usize];
        let wave = 0.01 * ((i * 7 % 5) as f32 - 2.0);
        cloth.set_position(i, x + Vec3::Z * wave).unwrap();
        cloth.set_velocity(i, Vec3::new(x.y, 1.0, -x.x)).unwrap();
    }
    cloth
}

/// Centre of mass [m] and linear momentum [kg m/s].
fn centre_and_momentum(cloth: &Cloth) -> (Vec3, Vec3) {
    let count = cloth.positions().len();
    let mass = |i: usize| cloth.mass(i as u32).unwrap();
    let all: f32 = (0..count).map(mass).sum();
    let middle: Vec3 = (0..count).map(|i| cloth.positions()[i] * mass(i)).sum();
    let momentum: Vec3 = (0..count).map(|i| cloth.velocity(i as u32).unwrap() * mass(i)).sum();
    (middle * (1.0 / all), momentum)
}

#[test]
fn split_separation_is_tiny_and_conserves_momentum() {
    let cut = |self_collision| {
        let mut cloth = flying_sheet(self_collision);
        let (from, to) = (Vec3::new(-0.1, -0.21, -1.0), Vec3::new(0.61, -0.37, -1.0));
        assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 8);
        assert!(cloth.tear_edge(10, 11).unwrap());
        cloth
    };
    let (separated, coincident) = (cut(SURFACE), cut(SelfCollision::None));
    let (after, plain) = (centre_and_momentum(&separated), centre_and_momentum(&coincident));
    assert!((after.0 - plain.0).length() < 1.0e-6, "{} is {}", after.0, plain.0);
    assert!((after.1 - plain.1).length() < 1.0e-6, "{} is {}", after.1, plain.1);
    let (x, at) = (separated.positions(), coincident.positions());
    assert_eq!(x.len(), at.len());
    let most = x.iter().zip(at).map(|(x, at)| x.distance(*at)).fold(0.0, f32::max);
    assert!(most > 0.0 && most < 1.0e-4, "the sides moved by {most} m");
    // Without surface collision the two sides start at the same position.
    let same = |x: &[Vec3]| (145..x.len()).filter(|i| x[..*i].contains(&x[*i])).count();
    assert!(same(at) > 5 && same(x) == 0, "{} and {} coincident particles", same(at), same(x));
}

#[test]
fn pinned_particles_on_a_cut_stay_at_their_targets_on_both_sides() {
    let mut cloth = flying_sheet(SURFACE);
    let pinned = [60, 61, 62, 63].map(|i| (i, cloth.positions()[i as usize]));
    pinned.iter().for_each(|(i, _)| cloth.pin(*i, None).unwrap());
    let (from, to) = (pinned[0].1 - Vec3::X * 0.4, pinned[3].1 + Vec3::X * 0.4);
    let level = |x: Vec3| Vec3::new(x.x, pinned[0].1.y, -1.0);
    assert!(cloth.cut(level(from), level(to), Vec3::Z * 2.0).unwrap() > 5);
    run_without_crossings("pinned", &mut cloth, 20, |_, _| ());
    for (i, at) in pinned {
        let here = cloth.positions().iter().filter(|x| **x == at).count();
        assert_eq!((cloth.positions()[i as usize], here), (at, 2), "particle {i}");
    }
}

/// A cut made without surface collision is separated when surface collision is switched on.
#[test]
fn split_separation_starts_when_surface_collision_is_switched_on() {
    let mut cloth = crumpled_sheet(16, 1, 90);
    let settings = cloth.settings().clone();
    let none = Settings { self_collision: SelfCollision::None, ..settings.clone() };
    cloth.set_settings(none).unwrap();
    assert!(cut_from_above(&mut cloth, 0.4, 0.01) > 16);
    cloth.set_settings(settings).unwrap();
    run_without_crossings("cut before", &mut cloth, 30, |_, _| ());
}

/// A cut separates its two sides at once, also when colliders came and went since the last tick.
#[test]
fn a_sheet_may_be_cut_right_after_colliders_were_added_or_removed() {
    for is_added in [true, false] {
        let mut cloth = crumpled_sheet(16, 1, 90);
        let post = ColliderDesc {
            shape: muslin::Shape::Sphere,
            radius: 0.1,
            position: Vec3::Y * -0.95,
            ..ColliderDesc::default()
        };
        let collider = cloth.add_collider(&post).unwrap();
        if !is_added {
            cloth.step(1);
            cloth.remove_collider(collider).unwrap();
        }
        assert!(cut_from_above(&mut cloth, 0.3, 0.0) > 4);
        cloth.step(2);
        assert!(cloth.positions().iter().all(|x| x.is_finite()));
    }
}
