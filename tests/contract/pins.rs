//! Attachments to moving transforms, soft pins, and teleports.

use crate::common::{bare_grid, irregular_mesh};
use muslin::glam::{Quat, Vec3};
use muslin::{
    Attachment, Cloth, ColliderDesc, Error, EventKind, GridDesc, Material, PinMode, Preset, Shape,
};

/// Columns and rows of the cape.
const CAPE_SIZE: (u32, u32) = (20, 30);
/// Turns of the body per second.
const TURNS_PER_SECOND: f32 = 2.0;

/// Speed of the body [m/s].
const BODY_SPEED: f32 = 10.0;

/// A cotton cape without pins; its top edge runs from shoulder to shoulder.
fn cape(change: impl FnOnce(&mut GridDesc)) -> Cloth {
    let mut desc = GridDesc {
        columns: CAPE_SIZE.0,
        rows: CAPE_SIZE.1,
        spacing: 0.03,
        origin: Vec3::new(-0.285, 1.5, -0.15),
        pin_mode: PinMode::None,
        material: Material::preset(Preset::Cotton),
        ..GridDesc::default()
    };
    change(&mut desc);
    Cloth::grid(&desc).unwrap()
}

/// Particles of the top edge.
fn top_edge() -> Vec<u32> {
    (0..CAPE_SIZE.0).collect()
}

/// Pose of the body at `time` [s]: it moves along x and rotates about y.
fn body_pose(time: f32) -> (Vec3, Quat) {
    let turn = Quat::from_rotation_y(core::f32::consts::TAU * TURNS_PER_SECOND * time);
    (Vec3::new(BODY_SPEED * time, 0.0, 0.0), turn)
}

/// Moves the attachment with the body for `ticks` ticks and calls `check` after each.
fn run_with_body(
    cloth: &mut Cloth,
    body: Attachment,
    ticks: u32,
    mut check: impl FnMut(&Cloth, Vec3, Quat),
) {
    for tick in 1..=ticks {
        let (position, rotation) = body_pose(tick as f32 / 60.0);
        cloth.move_attachment(body, position, rotation).unwrap();
        cloth.step(1);
        check(cloth, position, rotation);
    }
}

#[test]
fn attached_particles_stay_exact_on_a_body_that_moves_and_rotates() {
    for max_stretch in [0.0, 0.05] {
        let mut cloth = cape(|desc| desc.settings.max_stretch = max_stretch);
        let (edge, start) = (top_edge(), cloth.positions().to_vec());
        let body = cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY).unwrap();
        assert!(cloth.attached(body).unwrap().eq(edge.iter().copied()));
        assert!(cloth.pinned().eq(edge.iter().copied()));
        let (mut farthest, mut fastest, mut longest) = (0.0_f32, 0.0_f32, 0.0_f32);
        run_with_body(&mut cloth, body, 300, |cloth, position, rotation| {
            for particle in &edge {
                let target = position + rotation * start[*particle as usize];
                let off = cloth.positions()[*particle as usize].distance(target);
                // At the end the body is 50 m away, where the resolution of f32 is 4e-6 m.
                farthest = farthest.max(off);
            }
            fastest = fastest.max(cloth.stats().max_speed);
            longest = longest.max(cloth.stats().max_stretch);
            assert_eq!(cloth.stats().over_stretched, 0);
        });
        println!("error {farthest:.1e} m, fastest {fastest:.1} m/s, stretch {longest:.3}");
        assert!(farthest < 2e-5, "{farthest} m from its target");
        // The hem of the fully extended cape is 1.2 m from the axis.
        assert!(
            fastest < BODY_SPEED + TURNS_PER_SECOND * core::f32::consts::TAU * 1.2 + 2.0,
            "{fastest} m/s"
        );
        // Without a strain limit, 20 m/s of air speed and 14 g stretch the soft shear links of
        // cotton.
        let most = if max_stretch > 0.0 { max_stretch * 1.00001 } else { 0.8 };
        assert!(longest < most, "stretched by {longest}");
        assert!(core::iter::from_fn(|| cloth.next_event()).all(|e| e.kind != EventKind::Recovered));
    }
}

#[test]
fn a_cape_comes_to_rest_after_its_body_stops() {
    let mut cloth = cape(|desc| desc.settings.damping = 1.0);
    let body = cloth.attach(&top_edge(), Vec3::ZERO, Quat::IDENTITY).unwrap();
    run_with_body(&mut cloth, body, 120, |_, _, _| ());
    cloth.step(60);
    let soon = cloth.stats().kinetic_energy;
    cloth.step(900);
    let late = cloth.stats();
    println!("kinetic energy {soon:.2e} J after 1 s, {:.2e} J after 16 s", late.kinetic_energy);
    assert!(late.kinetic_energy < 1e-4 * soon, "{} J of {soon} J", late.kinetic_energy);
}

#[test]
fn an_attached_pin_moves_along_the_arc_of_the_rotation() {
    // A quarter turn in one tick with an arm of 1 m: the midpoint of the path lies on the arc.
    let mut desc = bare_grid(2, 2, 0.1, PinMode::None);
    (desc.origin, desc.settings.substeps) = (Vec3::X, 2);
    desc.settings.gravity = Vec3::ZERO;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let arm = cloth.attach(&[0], Vec3::ZERO, Quat::IDENTITY).unwrap();
    let quarter = Quat::from_rotation_y(core::f32::consts::FRAC_PI_2);
    cloth.move_attachment(arm, Vec3::ZERO, quarter).unwrap();
    cloth.step(1);
    let h = 1.0 / 120.0;
    // The second substep moves the pin from the middle of the arc to its end.
    let middle = Quat::from_rotation_y(core::f32::consts::FRAC_PI_4) * Vec3::X;
    let step = quarter * Vec3::X - middle;
    let v = (step * 1.5 - (middle - Vec3::X) * 0.5) / h;
    let off = cloth.velocity(0).unwrap() - v;
    assert!(off.length() < 1e-2 * v.length(), "{} m/s instead of {v}", cloth.velocity(0).unwrap());
}

#[test]
fn grabs_set_position_and_pin_change_an_attachment_as_documented() {
    let mut cloth = cape(|_| ());
    let body = cloth.attach(&top_edge(), Vec3::ZERO, Quat::IDENTITY).unwrap();
    // A grab overrides the attachment; after release the particle returns within one tick.
    let grab = cloth.grab_particle(3).unwrap();
    let target = cloth.positions()[3] + Vec3::Y * 0.05;
    cloth.move_grab(grab, target).unwrap();
    cloth.step(5);
    assert!(cloth.positions()[3].distance(target) < 1e-6);
    cloth.release(grab).unwrap();
    let (position, rotation) = (Vec3::new(0.1, 0.0, 0.0), Quat::from_rotation_y(0.1));
    cloth.move_attachment(body, position, rotation).unwrap();
    cloth.step(1);
    let rest = Vec3::new(-0.285 + 3.0 * 0.03, 1.5, -0.15);
    assert!(cloth.positions()[3].distance(position + rotation * rest) < 1e-6);
    // `set_position` changes the attached position.
    let other = position + rotation * (rest + Vec3::Y * 0.01);
    cloth.set_position(3, other).unwrap();
    cloth.move_attachment(body, Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.step(1);
    assert!(cloth.positions()[3].distance(rest + Vec3::Y * 0.01) < 1e-6);
    // A new pin target or `unpin` ends the attachment of a particle.
    cloth.pin(3, None).unwrap();
    cloth.unpin(4).unwrap();
    assert_eq!(cloth.attached(body).unwrap().count(), 18);
    let pinned_at = cloth.positions()[3];
    cloth.move_attachment(body, Vec3::Y * 0.05, Quat::IDENTITY).unwrap();
    cloth.step(1);
    assert_eq!(cloth.positions()[3], pinned_at);
    cloth.detach(body).unwrap();
    assert!(cloth.pinned().eq([3]));
    assert_eq!(cloth.detach(body), Err(Error::BadHandle { what: "attachment" }));
    let start_height = cloth.positions()[10].y;
    cloth.step(10);
    assert!(cloth.positions()[10].y < start_height - 0.01, "a detached particle must fall");
}

#[test]
fn attachments_survive_save_and_clone_but_not_reset() {
    let mut cloth = cape(|_| ());
    let body = cloth.attach(&top_edge(), Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.set_pin_stiffness(&[0, 19], 50.0).unwrap();
    run_with_body(&mut cloth, body, 20, |_, _, _| ());
    let (position, rotation) = body_pose(0.4);
    cloth.move_attachment(body, position, rotation).unwrap();
    let mut others = [Cloth::restore(&cloth.save()).unwrap(), cloth.clone()];
    assert_eq!(others[0].save(), cloth.save());
    cloth.step(1);
    for other in &mut others {
        other.step(1);
        assert_eq!(other.state_hash(), cloth.state_hash());
        let (position, rotation) = body_pose(0.5);
        other.move_attachment(body, position, rotation).unwrap();
        other.step(10);
    }
    assert_eq!(others[0].state_hash(), others[1].state_hash());
    cloth.reset();
    assert_eq!(cloth.pinned().count(), 0);
    let stale = cloth.move_attachment(body, Vec3::ZERO, Quat::IDENTITY);
    assert_eq!(stale, Err(Error::BadHandle { what: "attachment" }));
    let mut new = cape(|_| ());
    [&mut cloth, &mut new].into_iter().for_each(|cloth| cloth.step(10));
    assert_eq!(cloth.state_hash(), new.state_hash());
}

#[test]
fn a_cut_keeps_both_sides_attached_and_splits_the_pin_stiffness_by_mass() {
    let mut cloth = cape(|_| ());
    let body = cloth.attach(&top_edge(), Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.set_pin_stiffness(&[8], 40.0).unwrap();
    let x = cloth.positions()[8].x;
    let from = Vec3::new(x, 2.0, -1.0);
    assert!(cloth.cut(from, from - Vec3::Y * 0.7, Vec3::Z * 2.0).unwrap() > 5);
    let attached: Vec<u32> = cloth.attached(body).unwrap().collect();
    assert_eq!(attached.len(), 21, "{attached:?}");
    let twin = attached[20];
    assert_eq!(cloth.source_vertices()[twin as usize], 8);
    let stiffness = [8, twin].map(|pin| cloth.pin_stiffness(pin).unwrap().unwrap());
    assert!((stiffness[0] + stiffness[1] - 40.0).abs() < 1e-4, "{stiffness:?}");
    let mass = [8, twin].map(|pin| cloth.mass(pin).unwrap());
    assert!((stiffness[0] * mass[1] - stiffness[1] * mass[0]).abs() < 1e-6);
    run_with_body(&mut cloth, body, 60, |_, _, _| ());
    assert_eq!(cloth.stats().over_stretched, 0);
}

#[test]
fn a_moved_attachment_wakes_a_sleeping_cloth() {
    let mut cloth = cape(|desc| {
        (desc.settings.sleep_speed, desc.settings.damping) = (0.005, 2.0);
    });
    let body = cloth.attach(&top_edge(), Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.step(3000);
    assert!(cloth.stats().asleep);
    cloth.move_attachment(body, Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.step(1);
    assert!(cloth.stats().asleep, "an unchanged pose must not wake the cloth");
    cloth.move_attachment(body, Vec3::ZERO, Quat::from_rotation_y(0.01)).unwrap();
    cloth.step(1);
    assert!(!cloth.stats().asleep);
}

/// Mean distance below the targets [m] and load per pin [N] of a sheet at rest on soft pins.
fn sag_and_load(desc: &GridDesc, stiffness: f32) -> (f32, f32) {
    let mut cloth = Cloth::grid(desc).unwrap();
    let pins: Vec<u32> = cloth.pinned().collect();
    let start = cloth.positions().to_vec();
    cloth.set_pin_stiffness(&pins, stiffness).unwrap();
    cloth.step(1800);
    let below: f32 =
        pins.iter().map(|p| start[*p as usize].y - cloth.positions()[*p as usize].y).sum();
    let count = cloth.stats().particles;
    let mass: f32 = (0..count).map(|i| cloth.mass(i).unwrap()).sum();
    (below / pins.len() as f32, mass * 9.81 / pins.len() as f32)
}

#[test]
fn a_soft_pin_sags_by_load_over_stiffness() {
    for preset in [Preset::Cotton, Preset::Leather] {
        for (columns, rows, iterations) in [(2, 2, 2), (12, 16, 2), (12, 16, 1), (16, 24, 3)] {
            for stiffness in [2.0, 30.0, 2000.0] {
                let mut desc = GridDesc { columns, rows, spacing: 0.03, ..GridDesc::default() };
                desc.material = Material::preset(preset);
                (desc.settings.iterations, desc.settings.damping) = (iterations, 3.0);
                let (below, load) = sag_and_load(&desc, stiffness);
                let (exact, at) =
                    (load / stiffness, format!("{columns} x {rows}, {stiffness} N/m"));
                println!("{preset:?} {at} {iterations}: {below:.6} m, exactly {exact:.6} m");
                assert!((below / exact - 1.0).abs() < 0.03, "{at}: {below} m, not {exact} m");
            }
        }
    }
}

#[test]
fn soft_pins_of_a_mesh_sag_by_load_over_stiffness() {
    for bend_stiffness in [0.0, 1e-3] {
        let mut desc = irregular_mesh();
        (desc.settings.damping, desc.material.bend_stiffness) = (3.0, bend_stiffness);
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let start = cloth.positions().to_vec();
        cloth.set_pin_stiffness(&[0, 2], 60.0).unwrap();
        cloth.step(3600);
        let below: f32 = [0, 2].iter().map(|p| start[*p].y - cloth.positions()[*p].y).sum();
        let mass: f32 = (0..start.len() as u32).map(|i| cloth.mass(i).unwrap()).sum();
        let exact = mass * 9.81 / 60.0;
        println!("a mesh: {below:.6} m in all, exactly {exact:.6} m");
        assert!((below / exact - 1.0).abs() < 0.03, "{below} m, not {exact} m");
    }
}

#[test]
fn a_mass_on_a_soft_pin_oscillates_with_the_period_of_a_spring() {
    // T = 2π √(m / k): four particles on soft pins whose stiffness is shared by mass.
    let mut desc = bare_grid(2, 2, 0.05, PinMode::None);
    desc.settings.substeps = 20;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let mass: f32 = (0..4).map(|i| cloth.mass(i).unwrap()).sum();
    (0..4).for_each(|i| cloth.pin(i, None).unwrap());
    let period = 0.5;
    let stiffness = mass * (core::f32::consts::TAU / period).powi(2);
    for i in 0..4 {
        let share = cloth.mass(i).unwrap() / mass;
        cloth.set_pin_stiffness(&[i], stiffness * share).unwrap();
    }
    let mut heights = Vec::new();
    for _ in 0..600 {
        cloth.step(1);
        heights.push(cloth.positions()[0].y);
    }
    let mean = -9.81 / (core::f32::consts::TAU / period).powi(2);
    let crossings: Vec<usize> =
        (1..600).filter(|i| heights[i - 1] > mean && heights[*i] <= mean).collect();
    let measured = (crossings[crossings.len() - 1] - crossings[0]) as f32
        / (crossings.len() - 1) as f32
        / 60.0;
    println!("period {measured:.4} s, exactly {period} s");
    assert!((measured / period - 1.0).abs() < 0.01, "{measured} s");
}

#[test]
fn the_strain_limit_holds_at_soft_pins_but_not_at_hard_pins() {
    let stretch_between_pins = |stiffness: f32| {
        let mut desc = GridDesc { columns: 9, rows: 12, spacing: 0.05, ..GridDesc::default() };
        desc.pin_mode = PinMode::None;
        desc.settings.max_stretch = 0.05;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let pins: Vec<u32> = (0..9).chain(99..108).collect();
        pins.iter().for_each(|pin| cloth.pin(*pin, None).unwrap());
        cloth.set_pin_stiffness(&pins, stiffness).unwrap();
        let low: Vec<Vec3> = (99..108).map(|i| cloth.positions()[i] - Vec3::Y * 0.3).collect();
        for step in 1..=60 {
            let part = step as f32 / 60.0;
            let targets: Vec<Vec3> =
                low.iter().map(|x| *x + Vec3::Y * 0.3 * (1.0 - part)).collect();
            cloth.set_pin_targets(&pins[9..], &targets).unwrap();
            cloth.step(1);
        }
        cloth.step(60);
        (cloth.stats().max_stretch, cloth.stats().over_stretched)
    };
    let (stretch, over) = stretch_between_pins(200.0);
    assert!(over == 0 && stretch <= 0.0501, "{stretch}, {over} links at soft pins");
    let (stretch, over) = stretch_between_pins(0.0);
    assert!(over > 0 && stretch > 0.3, "{stretch}, {over} links at hard pins");
}

#[test]
fn invalid_attachment_calls_are_refused_and_change_nothing() {
    let mut cloth = cape(|_| ());
    let body = cloth.attach(&[0, 1], Vec3::ZERO, Quat::IDENTITY).unwrap();
    let before = cloth.save();
    let bad = |field, must| Error::BadValue { field, must };
    let turned = Quat::from_xyzw(0.0, 0.0, 0.0, 2.0);
    let unit = "be a unit quaternion";
    assert_eq!(cloth.attach(&[2], Vec3::NAN, Quat::IDENTITY), Err(bad("position", "be finite")));
    assert_eq!(cloth.attach(&[2], Vec3::ZERO, turned), Err(bad("rotation", unit)));
    let index = Error::BadIndex { field: "particles", index: 600, count: 600 };
    assert_eq!(cloth.attach(&[2, 600], Vec3::ZERO, Quat::IDENTITY), Err(index.clone()));
    let moved = cloth.move_attachment(body, Vec3::INFINITY, Quat::IDENTITY);
    assert_eq!(moved, Err(bad("position", "be finite")));
    assert_eq!(cloth.move_attachment(body, Vec3::ZERO, turned), Err(bad("rotation", unit)));
    let made_up = Attachment::from_bits(7);
    let stale = Err(Error::BadHandle { what: "attachment" });
    assert_eq!(cloth.move_attachment(made_up, Vec3::ZERO, Quat::IDENTITY), stale);
    assert_eq!(cloth.detach(made_up), stale);
    assert!(cloth.attached(made_up).is_err());
    for stiffness in [-1.0, f32::NAN, f32::INFINITY] {
        let refused = cloth.set_pin_stiffness(&[0], stiffness);
        assert_eq!(refused, Err(bad("stiffness", "be at least 0 and finite")));
    }
    assert_eq!(cloth.set_pin_stiffness(&[0, 2], 1.0), Err(bad("particles", "be pinned")));
    assert_eq!(cloth.set_pin_stiffness(&[0, 600], 1.0), Err(index));
    assert_eq!(cloth.save(), before);
    let mut cloth = cape(|_| ());
    for _ in 0..64 {
        cloth.attach(&[], Vec3::ZERO, Quat::IDENTITY).unwrap();
    }
    let full = cloth.attach(&[0], Vec3::ZERO, Quat::IDENTITY);
    assert_eq!(full, Err(Error::Full { what: "another attachment" }));
    assert_eq!(cloth.pinned().count(), 0);
}

/// Positions of the particles in the frame of the body.
fn positions_in_body_frame(cloth: &Cloth, position: Vec3, rotation: Quat) -> Vec<Vec3> {
    let inward = rotation.inverse();
    cloth.positions().iter().map(|x| inward * (*x - position)).collect()
}

#[test]
fn teleporting_body_and_cape_together_does_not_disturb_the_cape() {
    let mut cloth = cape(|desc| desc.settings.max_stretch = 0.05);
    let shape = Shape::Sphere;
    let back =
        ColliderDesc { shape, radius: 0.1, position: Vec3::Y * 1.1, ..ColliderDesc::default() };
    let back = cloth.add_collider(&back).unwrap();
    let body = cloth.attach(&top_edge(), Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.set_max_distances(&[450, 451], &[0.2, 0.3]).unwrap();
    let grab = cloth.grab_particle(599).unwrap();
    cloth.set_velocity(300, Vec3::new(0.5, 0.0, 0.25)).unwrap();
    cloth.step(30);
    // The rotation is about the vertical, so gravity stays the same. One cloth teleports, one
    // stays.
    let mut stays = cloth.clone();
    let (position, rotation) = (Vec3::new(30.0, 2.0, -7.0), Quat::from_rotation_y(2.5));
    cloth.set_frame(Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.teleport(position, rotation).unwrap();
    let place = position + rotation * Vec3::Y * 1.1;
    cloth.teleport_collider(back, place, rotation).unwrap();
    cloth.move_attachment(body, position, rotation).unwrap();
    let energy = [cloth.stats().kinetic_energy, stays.stats().kinetic_energy];
    assert!((energy[0] / energy[1] - 1.0).abs() < 1e-3, "{energy:?}");
    let (mut worst, mut first) = (0.0_f32, 0.0_f32);
    for _ in 0..60 {
        [&mut cloth, &mut stays].into_iter().for_each(|cloth| cloth.step(1));
        let local = positions_in_body_frame(&cloth, position, rotation);
        let off = local.iter().zip(stays.positions()).map(|(a, b)| a.distance(*b));
        worst = off.fold(worst, f32::max);
        first = if first == 0.0 { worst } else { first };
    }
    println!(
        "error {worst:.1e} m one second after a jump of 30 m, {first:.1e} m one tick after it"
    );
    // Positions 30 m away have coarser rounding, and a freely swinging cape amplifies it.
    assert!(first < 1e-4, "the jump moved the cape by {first} m against the body");
    assert!(worst < 0.05, "the jump moved the cape by {worst} m against the body");
    // Teleport back from the current frame.
    let before = positions_in_body_frame(&cloth, position, rotation);
    cloth.teleport(Vec3::ZERO, Quat::IDENTITY).unwrap();
    let after = cloth.positions();
    assert!(before.iter().zip(after).all(|(a, b)| a.distance(*b) < 1e-5));
    cloth.release(grab).unwrap();
    let before = cloth.save();
    assert!(cloth.teleport(Vec3::NAN, Quat::IDENTITY).is_err());
    assert!(cloth.teleport(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, 2.0)).is_err());
    assert!(cloth.set_frame(Vec3::INFINITY, Quat::IDENTITY).is_err());
    assert!(cloth.teleport_collider(back, Vec3::NAN, Quat::IDENTITY).is_err());
    assert_eq!(cloth.save(), before);
    // The save includes the frame.
    let mut restored = Cloth::restore(&before).unwrap();
    for cloth in [&mut cloth, &mut restored] {
        cloth.teleport(Vec3::X, rotation).unwrap();
    }
    assert_eq!(restored.state_hash(), cloth.state_hash());
}
