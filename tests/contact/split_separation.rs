//! Cuts and tears of a surface that keeps from itself: the two sides of a slit do not go through each other.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Event, GridDesc, Material, PinMode, SelfCollision, Settings};

use crate::common::crossings::crossing_count;

const SURFACE: SelfCollision = SelfCollision::Surface;

/// A sheet that stands on its edge over a floor and crumples, each `seed` another way.
fn crumpled(side: u32, seed: u32, ticks: u32) -> Cloth {
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
    assert_eq!(crossing_count(&cloth), 0, "it crosses itself before anything tears");
    let (low, high) = bounds(&cloth);
    assert!(high.y - low.y < 0.75, "it stands {} m high", high.y - low.y);
    cloth
}

fn bounds(cloth: &Cloth) -> (Vec3, Vec3) {
    let mut all = cloth.positions().iter();
    let first = *all.next().unwrap();
    all.fold((first, first), |(low, high), x| (low.min(*x), high.max(*x)))
}

/// Cuts a heap through from above, turned about the vertical and so far beside its middle.
fn slash(cloth: &mut Cloth, turn: f32, beside: f32) -> u32 {
    let (low, high) = bounds(cloth);
    let [along, across] = [Vec3::X, Vec3::Z].map(|axis| Quat::from_rotation_y(turn) * axis);
    let above = 0.5 * (low + high) + across * beside + Vec3::Y * (high.y - low.y + 0.1);
    cloth.cut(above - along * 0.45, above + along * 0.45, Vec3::NEG_Y * 3.0).unwrap()
}

/// Plays, and counts crossings before and after every tick. Twice in between a restored cloth must go on in the
/// same bits.
fn play(name: &str, cloth: &mut Cloth, ticks: u32, mut act: impl FnMut(&mut Cloth, u32)) {
    for tick in 0..ticks {
        act(cloth, tick);
        assert_eq!(crossing_count(cloth), 0, "{name}: as tick {tick} begins");
        let looks = tick == 1 || tick == ticks / 2;
        let restored = looks.then(|| Cloth::restore(&cloth.save()).unwrap());
        cloth.step(1);
        if let Some(mut restored) = restored {
            restored.step(1);
            assert_eq!(restored.state_hash(), cloth.state_hash(), "{name}, tick {tick}");
        }
        assert_eq!(crossing_count(cloth), 0, "{name}: after tick {tick}");
    }
    println!("{name}: {} particles", cloth.positions().len());
    let (low, high) = bounds(cloth);
    assert!((high - low).length() < 3.0, "{name}: it was flung from {low} to {high}");
}

fn pieces_detached(cloth: &mut Cloth) -> usize {
    let mut events: Vec<Event> = Vec::new();
    while let Some(event) = cloth.next_event() {
        events.push(event);
    }
    events.iter().filter(|event| event.kind == muslin::EventKind::PieceDetached).count()
}

/// One blade goes through many layers, so that pieces come off; then again at the same place, and across.
#[test]
fn a_crumpled_sheet_that_is_cut_does_not_cross_itself() {
    for (side, seed, at) in [(16, 1, 90), (20, 3, 60), (24, 1, 45), (24, 2, 90)] {
        let mut cloth = crumpled(side, seed, at);
        let turn = 0.4 * seed as f32;
        let opened = slash(&mut cloth, turn, 0.01);
        assert!(opened > side, "only {opened} edges opened");
        assert_eq!(crossing_count(&cloth), 0, "as it is cut");
        slash(&mut cloth, turn, 0.01);
        let name = format!("cut {side} {seed} {at}");
        play(&name, &mut cloth, 36, |cloth, tick| {
            if tick == 12 {
                slash(cloth, turn, 0.01);
            }
            if tick == 20 {
                assert!(slash(cloth, turn + 1.5, 0.0) > 5);
            }
        });
        assert!(pieces_detached(&mut cloth) > 0, "{name}: nothing came off");
    }
}

/// Edges all over it are torn by hand, some beside each other, until the reserve is used up.
#[test]
fn a_crumpled_sheet_that_is_torn_by_hand_does_not_cross_itself() {
    for (side, seed, at) in [(16, 2, 45), (20, 5, 130), (24, 1, 90)] {
        let mut cloth = crumpled(side, seed, at);
        let before = cloth.positions().len();
        play(&format!("torn {side} {seed} {at}"), &mut cloth, 50, |cloth, tick| {
            let first = (seed * 31 + tick * 53) % (side * (side - 1));
            for a in first..first + 3 {
                let b = if tick % 2 == 0 { a + 1 } else { a + side };
                // An edge that is torn already, or none, is refused.
                let _ = cloth.tear_edge(a, b);
            }
        });
        let torn = cloth.positions().len() - before;
        assert!(torn > 60, "only {torn} more particles");
    }
}

/// A corner is held and the middle of another border pulled out of the heap, until the sheet rips.
#[test]
fn a_crumpled_sheet_that_is_ripped_by_hands_does_not_cross_itself() {
    for (side, seed, at) in [(16, 0, 90), (20, 4, 60), (20, 5, 60), (24, 0, 90)] {
        let mut cloth = crumpled(side, seed, at);
        cloth.set_settings(Settings { tearing: true, ..*cloth.settings() }).unwrap();
        cloth.set_material(Material { tear_stretch: 1.15, ..*cloth.material() }).unwrap();
        let (before, particle) = (cloth.positions().len(), side / 2);
        let grab = cloth.grab_particle(particle).unwrap();
        cloth.grab_particle(side * side - 1).unwrap();
        let held = cloth.positions()[particle as usize];
        play(&format!("ripped {side} {seed} {at}"), &mut cloth, 75, |cloth, tick| {
            let by = Vec3::new(0.006, 0.01, 0.018) * tick as f32;
            cloth.move_grab(grab, held + by).unwrap();
        });
        let torn = cloth.positions().len() - before;
        assert!(torn > 3, "only {torn} more particles");
    }
}

/// What is held goes where hands say; layers in its way go along.
#[test]
fn what_is_pulled_through_a_heap_takes_along_what_is_in_its_way() {
    let (side, particle) = (24, 12);
    let mut cloth = crumpled(side, 0, 90);
    let grab = cloth.grab_particle(particle).unwrap();
    cloth.grab_particle(side * side - 1).unwrap();
    let held = cloth.positions()[particle as usize];
    let by = |tick: u32| Vec3::new(0.006, 0.01, 0.018) * tick as f32;
    play("pulled", &mut cloth, 45, |cloth, tick| {
        cloth.move_grab(grab, held + by(tick)).unwrap();
    });
    assert_eq!(cloth.positions()[particle as usize], held + by(44));
}

/// A sheet in free flight, wrinkled and turning, each row another way.
fn flying(self_collision: SelfCollision) -> Cloth {
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

/// Where the mass is in the mean, and its momentum.
fn sums(cloth: &Cloth) -> (Vec3, Vec3) {
    let count = cloth.positions().len();
    let mass = |i: usize| cloth.mass(i as u32).unwrap();
    let all: f32 = (0..count).map(mass).sum();
    let middle: Vec3 = (0..count).map(|i| cloth.positions()[i] * mass(i)).sum();
    let momentum: Vec3 = (0..count).map(|i| cloth.velocity(i as u32).unwrap() * mass(i)).sum();
    (middle * (1.0 / all), momentum)
}

#[test]
fn sides_part_by_a_hair_and_keep_their_momentum() {
    let cut = |self_collision| {
        let mut cloth = flying(self_collision);
        let (from, to) = (Vec3::new(-0.1, -0.21, -1.0), Vec3::new(0.61, -0.37, -1.0));
        assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 8);
        assert!(cloth.tear_edge(10, 11).unwrap());
        cloth
    };
    let (apart, together) = (cut(SURFACE), cut(SelfCollision::None));
    let (after, plain) = (sums(&apart), sums(&together));
    assert!((after.0 - plain.0).length() < 1.0e-6, "{} is {}", after.0, plain.0);
    assert!((after.1 - plain.1).length() < 1.0e-6, "{} is {}", after.1, plain.1);
    let (x, at) = (apart.positions(), together.positions());
    assert_eq!(x.len(), at.len());
    let most = x.iter().zip(at).map(|(x, at)| x.distance(*at)).fold(0.0, f32::max);
    assert!(most > 0.0 && most < 1.0e-4, "sides went {most} m");
    // Without it they begin at the very same place.
    let same = |x: &[Vec3]| (145..x.len()).filter(|i| x[..*i].contains(&x[*i])).count();
    assert!(same(at) > 5 && same(x) == 0, "{} and {} at the same place", same(at), same(x));
}

#[test]
fn pins_hold_both_sides_of_a_cut_where_they_were() {
    let mut cloth = flying(SURFACE);
    let pinned = [60, 61, 62, 63].map(|i| (i, cloth.positions()[i as usize]));
    pinned.iter().for_each(|(i, _)| cloth.pin(*i, None).unwrap());
    let (from, to) = (pinned[0].1 - Vec3::X * 0.4, pinned[3].1 + Vec3::X * 0.4);
    let level = |x: Vec3| Vec3::new(x.x, pinned[0].1.y, -1.0);
    assert!(cloth.cut(level(from), level(to), Vec3::Z * 2.0).unwrap() > 5);
    play("pinned", &mut cloth, 20, |_, _| ());
    for (i, at) in pinned {
        let here = cloth.positions().iter().filter(|x| **x == at).count();
        assert_eq!((cloth.positions()[i as usize], here), (at, 2), "particle {i}");
    }
}

/// What was cut before surfaces kept apart parts when they begin to.
#[test]
fn slits_part_when_surfaces_begin_to_keep_apart() {
    let mut cloth = crumpled(16, 1, 90);
    let settings = cloth.settings().clone();
    let none = Settings { self_collision: SelfCollision::None, ..settings.clone() };
    cloth.set_settings(none).unwrap();
    assert!(slash(&mut cloth, 0.4, 0.01) > 16);
    cloth.set_settings(settings).unwrap();
    play("cut before", &mut cloth, 30, |_, _| ());
}
