//! Sewing: pairs meet and stay together, momentum stays, stitches tear at their force.

use crate::common::bare;
use muslin::glam::{DVec3, Vec3};
use muslin::{
    Cloth, ColliderDesc, Event, EventKind, MeshDesc, SelfCollision, Settings, SewDesc, SewKind,
    Shape, Wind,
};

/// Appends a panel of `columns` × `rows` particles, and returns the first of them.
fn add_panel(desc: &mut MeshDesc, [columns, rows]: [u32; 2], at: impl Fn(u32, u32) -> Vec3) -> u32 {
    let first = desc.positions.len() as u32;
    desc.positions.extend((0..rows * columns).map(|i| at(i % columns, i / columns)));
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = first + row * columns + column;
            let (b, c, d) = (a + 1, a + columns, a + columns + 1);
            let is_even = (row + column).is_multiple_of(2);
            desc.indices.extend(if is_even { [a, c, b, b, c, d] } else { [a, d, b, a, c, d] });
        }
    }
    first
}

/// Two flat panels of 9 × 9 particles and 0.4 m side in the x–y plane, `gap` apart in x, without
/// gravity, and the pairs of their inner borders.
fn two_panels(gap: f32) -> (MeshDesc, Vec<[u32; 2]>) {
    let (mut settings, material) = bare();
    settings.gravity = Vec3::ZERO;
    let mut desc = MeshDesc { settings, material, weld_distance: -1.0, ..MeshDesc::default() };
    let place = |left: f32, z: f32| {
        move |u: u32, v: u32| Vec3::new(left + 0.05 * u as f32, 0.05 * v as f32, z)
    };
    let a = add_panel(&mut desc, [9, 9], place(0.0, 0.0));
    let b = add_panel(&mut desc, [9, 9], place(0.4 + gap, 0.03));
    let pairs = (0..9).map(|row| [a + 9 * row + 8, b + 9 * row]).collect();
    (desc, pairs)
}

fn in_vacuum(desc: &MeshDesc) -> Cloth {
    let mut cloth = Cloth::mesh(desc).unwrap();
    cloth.set_wind(Wind { air_density: 0.0, ..Wind::default() }).unwrap();
    cloth
}

/// Total mass [kg], momentum [kg m/s] and angular momentum about the centre of mass [kg m²/s].
fn momenta(cloth: &Cloth) -> (f64, DVec3, DVec3) {
    let all = || {
        (0..cloth.particle_count()).map(|i| {
            let x = cloth.position(i).unwrap().as_dvec3();
            (f64::from(cloth.mass(i).unwrap()), x, cloth.velocity(i).unwrap().as_dvec3())
        })
    };
    let mass: f64 = all().map(|(m, ..)| m).sum();
    let center = all().map(|(m, x, _)| x * m).sum::<DVec3>() / mass;
    let momentum = all().map(|(m, _, v)| v * m).sum();
    (mass, momentum, all().map(|(m, x, v)| (x - center).cross(v) * m).sum())
}

fn assert_joined(cloth: &Cloth, pairs: &[[u32; 2]]) {
    for [a, b] in pairs {
        assert_eq!(cloth.position(*a), cloth.position(*b), "positions of {a} and {b}");
        assert_eq!(cloth.velocity(*a), cloth.velocity(*b), "velocities of {a} and {b}");
    }
}

fn events_of(cloth: &mut Cloth, kind: EventKind) -> Vec<Event> {
    core::iter::from_fn(|| cloth.next_event()).filter(|event| event.kind == kind).collect()
}

fn largest_gap(cloth: &Cloth, pairs: &[[u32; 2]]) -> f32 {
    let gap = |[a, b]: &[u32; 2]| cloth.position(*a).unwrap() - cloth.position(*b).unwrap();
    pairs.iter().map(|pair| gap(pair).length()).fold(0.0, f32::max)
}

#[test]
fn panels_are_drawn_together_at_the_given_speed_and_then_are_one() {
    let (desc, pairs) = two_panels(0.5);
    let mut cloth = in_vacuum(&desc);
    cloth.sew(&pairs, &SewDesc { speed: 1.0, ..SewDesc::default() }).unwrap();
    let start = largest_gap(&cloth, &pairs);
    for tick in 1..=240 {
        cloth.step(1);
        let expected = (start - tick as f32 / 60.0).max(0.0);
        let gap = largest_gap(&cloth, &pairs);
        // The panels' inertia lets the borders run ahead of the limit, never behind it.
        assert!(gap < expected + 1.0e-3, "tick {tick}: gap {gap}, not below {expected}");
        assert!(gap > expected - 0.2, "tick {tick}: gap {gap} instead of {expected}");
        if expected == 0.0 {
            assert_joined(&cloth, &pairs);
        }
        let (mass, p, l) = momenta(&cloth);
        assert!(p.length() < 1.0e-6 * mass, "tick {tick}: {} m/s", p.length() / mass);
        assert!(l.length() < 1.0e-3 * mass, "tick {tick}: spin {}", l.length() / mass);
    }
}

#[test]
fn a_max_stretch_keeps_joined_pairs_joined() {
    for self_collision in [SelfCollision::None, SelfCollision::Surface, SelfCollision::Particles] {
        let (mut desc, pairs) = two_panels(0.1);
        desc.settings = Settings {
            max_stretch: 0.02,
            gravity: Vec3::new(0.0, -9.81, 0.0),
            self_collision,
            ..desc.settings
        };
        desc.pinned = vec![72, 73, 74];
        let mut cloth = in_vacuum(&desc);
        cloth.sew(&pairs, &SewDesc::default()).unwrap();
        for tick in 0..300 {
            cloth.step(1);
            if tick > 20 {
                assert_joined(&cloth, &pairs);
            }
        }
        let stats = cloth.stats();
        assert!(stats.max_stretch < 0.0201, "{self_collision:?}: {}", stats.max_stretch);
        assert_eq!(stats.crossings, 0, "{self_collision:?}");
    }
}

/// Front and back panel of a tube around a capsule, sewn along both sides.
#[test]
fn panels_sewn_around_a_body_close_within_a_millimetre() {
    let (settings, material) = bare();
    let mut desc = MeshDesc { settings, material, ..MeshDesc::default() };
    (desc.settings.damping, desc.settings.self_collision) = (1.0, SelfCollision::Surface);
    desc.settings.gravity = Vec3::ZERO;
    (desc.material.friction, desc.weld_distance) = (0.4, -1.0);
    let width = 0.36;
    let place = |z: f32, flip: f32| {
        move |u: u32, v: u32| {
            Vec3::new(flip * width * (u as f32 / 14.0 - 0.5), 0.3 - 0.6 * v as f32 / 23.0, z)
        }
    };
    let front = add_panel(&mut desc, [15, 24], place(0.18, 1.0));
    let back = add_panel(&mut desc, [15, 24], place(-0.18, -1.0));
    let pairs: Vec<[u32; 2]> = (0..24)
        .flat_map(|row| {
            let at = 15 * row;
            [[front + at, back + at + 14], [front + at + 14, back + at]]
        })
        .collect();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let body = ColliderDesc {
        shape: Shape::Capsule,
        radius: 0.1,
        half_height: 0.5,
        ..ColliderDesc::default()
    };
    cloth.add_collider(&body).unwrap();
    let floor = ColliderDesc { position: Vec3::new(0.0, -0.35, 0.0), ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    cloth.sew(&pairs, &SewDesc { speed: 0.6, ..SewDesc::default() }).unwrap();
    let before = largest_gap(&cloth, &pairs);
    cloth.step(120);
    assert!(
        before > 0.35 && largest_gap(&cloth, &pairs) < 1.0e-3,
        "{}",
        largest_gap(&cloth, &pairs)
    );
    assert_joined(&cloth, &pairs);
    let stats = cloth.stats();
    assert_eq!((stats.free_inside, stats.crossings), (0, 0));
    let radii = cloth.positions().iter().map(|x| x.x.hypot(x.z));
    assert!(radii.fold(0.0, f32::max) < 0.2, "the tube is around the body");
}

/// A panel of mass M that hangs by one pair from a pinned particle loads it with M g.
#[test]
fn a_stitch_tears_above_its_force_and_says_so() {
    let torn = [0.8, 1.5].map(|share| {
        let (mut desc, pairs) = two_panels(0.0);
        desc.settings.gravity = Vec3::new(0.0, -9.81, 0.0);
        desc.settings.damping = 2.0;
        // The left panel is pinned; the right one hangs by its top inner corner.
        desc.pinned = (0..81).collect();
        desc.positions[81..].iter_mut().for_each(|x| x.z = 0.0);
        let mut cloth = in_vacuum(&desc);
        let weight: f32 = (81..162).map(|i| cloth.mass(i).unwrap() * 9.81).sum();
        let stitch =
            |tear_force| SewDesc { kind: SewKind::Stitch, tear_force, ..SewDesc::default() };
        cloth.sew(&pairs[8..], &stitch(0.0)).unwrap();
        cloth.step(600);
        assert_joined(&cloth, &pairs[8..]);
        // The same load on a second stitch at the same place, once the first has come to rest.
        cloth.sew(&pairs[8..], &stitch(share * weight)).unwrap();
        cloth.step(120);
        events_of(&mut cloth, EventKind::StitchTorn)
    });
    assert_eq!(torn[1], []);
    assert_eq!(torn[0].len(), 1);
    assert_eq!((torn[0][0].particle_a, torn[0][0].particle_b), (80, 153));
}

#[test]
fn a_row_of_stitches_that_is_too_weak_tears_off_and_the_panel_falls() {
    for self_collision in [SelfCollision::None, SelfCollision::Surface, SelfCollision::Particles] {
        let (mut desc, pairs) = two_panels(0.0);
        desc.settings =
            Settings { gravity: Vec3::new(0.0, -9.81, 0.0), self_collision, ..desc.settings };
        desc.pinned = (0..81).collect();
        let mut cloth = in_vacuum(&desc);
        let stitches = SewDesc { kind: SewKind::Stitch, tear_force: 0.01, ..SewDesc::default() };
        cloth.sew(&pairs, &stitches).unwrap();
        cloth.step(120);
        let events = events_of(&mut cloth, EventKind::StitchTorn);
        assert_eq!(events.len(), 9, "{self_collision:?}");
        let highest = (81..162).map(|i| cloth.position(i).unwrap().y).fold(f32::MIN, f32::max);
        assert!(highest < -1.0, "{self_collision:?}: it hangs at {highest}");
        assert_eq!(cloth.stats().crossings, 0, "{self_collision:?}");
    }
}

#[test]
fn two_pinned_particles_stay_apart_and_are_reported_once() {
    let (mut desc, pairs) = two_panels(0.2);
    desc.pinned = pairs[0].to_vec();
    let mut cloth = in_vacuum(&desc);
    cloth.sew(&pairs, &SewDesc { speed: 2.0, ..SewDesc::default() }).unwrap();
    cloth.step(60);
    assert_eq!(cloth.stats().over_stretched, 1);
    assert_joined(&cloth, &pairs[1..]);
    assert!(largest_gap(&cloth, &pairs[..1]) > 0.2);
    let events = events_of(&mut cloth, EventKind::HeldApart);
    assert_eq!(events.len(), 1);
    assert_eq!([events[0].particle_a, events[0].particle_b], pairs[0]);
    cloth.unpin_all();
    cloth.step(10);
    assert_joined(&cloth, &pairs);
    assert_eq!(cloth.stats().over_stretched, 0);
}

#[test]
fn particles_in_several_pairs_all_meet_at_one_place() {
    let (mut desc, pairs) = two_panels(0.1);
    let third = add_panel(&mut desc, [5, 9], |u, v| {
        Vec3::new(0.45, 0.05 * v as f32, 0.2 + 0.05 * u as f32)
    });
    let mut cloth = in_vacuum(&desc);
    let more: Vec<[u32; 2]> = (0..9).map(|row| [third + 5 * row, pairs[row as usize][1]]).collect();
    cloth.sew(&pairs, &SewDesc { speed: 1.0, ..SewDesc::default() }).unwrap();
    cloth.sew(&more, &SewDesc { speed: 0.4, ..SewDesc::default() }).unwrap();
    cloth.step(90);
    assert_joined(&cloth, &pairs);
    assert_joined(&cloth, &more);
    let (mass, p, _) = momenta(&cloth);
    assert!(p.length() < 1.0e-6 * mass);
}

#[test]
fn normals_are_smooth_across_a_weld_and_not_across_a_stitch() {
    for (kind, is_smooth) in [(SewKind::Weld, true), (SewKind::Stitch, false)] {
        let (mut desc, pairs) = two_panels(0.0);
        // The second panel stands upright on the border of the first.
        for x in &mut desc.positions[81..] {
            (x.x, x.z) = (0.4, x.x - 0.4);
        }
        let mut cloth = in_vacuum(&desc);
        cloth.sew(&pairs, &SewDesc { kind, ..SewDesc::default() }).unwrap();
        cloth.step(1);
        let normals = cloth.view().normals.to_vec();
        let [a, b] = pairs[4].map(|i| normals[i as usize]);
        assert_eq!(a == b, is_smooth, "{kind:?}: {a} and {b}");
        assert!(a.is_normalized() && b.is_normalized());
    }
}

#[test]
fn saves_clones_and_resets_carry_sewn_pairs() {
    let (desc, pairs) = two_panels(0.3);
    let mut cloth = in_vacuum(&desc);
    let without = cloth.state_hash();
    cloth.sew(&pairs[..5], &SewDesc { speed: 1.0, ..SewDesc::default() }).unwrap();
    let stitch = SewDesc { speed: 0.5, kind: SewKind::Stitch, tear_force: 2.0 };
    cloth.sew(&pairs[5..], &stitch).unwrap();
    assert_ne!(cloth.state_hash(), without);
    cloth.step(25);
    let mut copies = [cloth.clone(), Cloth::restore(&cloth.save()).unwrap()];
    cloth.step(40);
    for copy in &mut copies {
        copy.step(40);
        assert_eq!(copy.state_hash(), cloth.state_hash());
    }
    assert_joined(&cloth, &pairs[..5]);
    cloth.reset();
    assert!(largest_gap(&cloth, &pairs) > 0.3, "it starts apart again");
    cloth.step(65);
    assert_joined(&cloth, &pairs[..5]);
    let positions = |cloth: &Cloth| cloth.positions().to_vec();
    assert_eq!(positions(&cloth), positions(&copies[0]));
}

#[test]
fn a_sheet_sewn_to_itself_tears_beside_its_seam() {
    let (mut desc, pairs) = two_panels(0.05);
    desc.settings.tearing = true;
    (desc.material.tear_stretch, desc.extra_particles) = (1.3, 60);
    desc.pinned = (0..9).map(|row| 9 * row).collect();
    let mut cloth = in_vacuum(&desc);
    cloth.sew(&pairs, &SewDesc::default()).unwrap();
    cloth.step(30);
    let grab = cloth.grab_particle(81 + 9 * 4 + 8).unwrap();
    for tick in 0..240 {
        cloth.move_grab(grab, Vec3::new(0.9 + 0.01 * tick as f32, 0.2, 0.0)).unwrap();
        cloth.step(1);
        assert_joined(&cloth, &pairs);
    }
    assert!(cloth.particle_count() > 162, "it tore");
}

/// Two square panels that are sewn along their whole border enclose a volume, like a teabag: see
/// `pressure`. The winding of the second panel does not matter.
#[test]
fn two_panels_sewn_along_their_border_can_be_inflated() {
    for is_flipped in [false, true] {
        let (settings, material) = bare();
        let mut desc = MeshDesc { settings, material, weld_distance: -1.0, ..MeshDesc::default() };
        let place = |z: f32, flip: f32| {
            move |u: u32, v: u32| Vec3::new(flip * 0.025 * (u as f32 - 8.0), 0.025 * v as f32, z)
        };
        let front = add_panel(&mut desc, [17, 17], place(0.05, -1.0));
        let back_flip = if is_flipped { -1.0 } else { 1.0 };
        let back = add_panel(&mut desc, [17, 17], place(-0.05, back_flip));
        let is_border = |u: u32, v: u32| u == 0 || v == 0 || u == 16 || v == 16;
        let pairs: Vec<[u32; 2]> = (0..289)
            .map(|i| (i % 17, i / 17))
            .filter(|(u, v)| is_border(*u, *v))
            .map(|(u, v)| {
                let across = if is_flipped { u } else { 16 - u };
                [front + 17 * v + u, back + 17 * v + across]
            })
            .collect();
        desc.settings = Settings {
            gravity: Vec3::ZERO,
            pressure: 20.0,
            substeps: 8,
            damping: 3.0,
            ..desc.settings
        };
        (desc.material.bend_stiffness, desc.settings.max_stretch) = (0.0, 0.01);
        let mut cloth = in_vacuum(&desc);
        cloth.step(10);
        let depth = |cloth: &Cloth| {
            let z = |sign: f32| cloth.positions().iter().map(move |x| x.z * sign);
            z(1.0).fold(0.0, f32::max) + z(-1.0).fold(0.0, f32::max)
        };
        assert!((depth(&cloth) - 0.1).abs() < 1.0e-4, "open panels feel nothing");
        cloth.sew(&pairs, &SewDesc::default()).unwrap();
        cloth.step(590);
        assert_joined(&cloth, &pairs);
        let copy = Cloth::restore(&cloth.save()).unwrap();
        for mut cloth in [cloth.clone(), copy] {
            cloth.step(10);
            let (mass, p, _) = momenta(&cloth);
            assert!(p.length() < 1.0e-5 * mass, "it drifts at {} m/s", p.length() / mass);
            let depth = depth(&cloth);
            assert!((0.15..0.25).contains(&depth), "flipped {is_flipped}: {depth} m deep");
        }
    }
}
/// The pass that keeps layers from crossing once moved the two sides of a seam apart, and joining them
/// again put them through other layers.
#[test]
fn a_sewn_tube_that_crumples_around_a_body_does_not_cross_itself() {
    let (settings, material) = bare();
    let mut desc = MeshDesc { settings, material, ..MeshDesc::default() };
    (desc.settings.damping, desc.settings.self_collision) = (1.0, SelfCollision::Surface);
    (desc.material.friction, desc.weld_distance) = (0.4, -1.0);
    let place = |from: f32| {
        move |u: u32, v: u32| {
            let angle = core::f32::consts::PI * (from + u as f32 / 14.0);
            Vec3::new(0.12 * angle.cos(), 0.3 - 0.6 * v as f32 / 23.0, 0.12 * angle.sin())
        }
    };
    let front = add_panel(&mut desc, [15, 24], place(0.0));
    let back = add_panel(&mut desc, [15, 24], place(1.0));
    let pairs: Vec<[u32; 2]> = (0..24)
        .map(|row| 15 * row)
        .flat_map(|at| [[front + at, back + at + 14], [front + at + 14, back + at]])
        .collect();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let body = ColliderDesc {
        shape: Shape::Capsule,
        radius: 0.1,
        half_height: 0.5,
        ..ColliderDesc::default()
    };
    let floor = ColliderDesc { position: Vec3::new(0.0, -0.35, 0.0), ..ColliderDesc::default() };
    cloth.add_collider(&body).unwrap();
    cloth.add_collider(&floor).unwrap();
    cloth.sew(&pairs, &SewDesc::default()).unwrap();
    for _ in 0..18 {
        cloth.step(10);
        assert_joined(&cloth, &pairs);
        let stats = cloth.stats();
        assert_eq!((stats.free_inside, stats.crossings), (0, 0));
    }
    assert!(cloth.positions().iter().all(|x| x.y < 0.2), "it fell");
}
