//! Scenes with clothes on animated bodies: attachments, anchors, moving frames and mass scales.

use super::along;
use crate::Trace;
use muslin::glam::{Quat, Vec3};
use muslin::{
    Cloth, ColliderDesc, EventKind, GridDesc, Material, PinMode, Preset, Result, Settings, Shape,
    Wind,
};

/// Exact components of nearly unit quaternions, which the cloth normalises.
const TURNS: [[f32; 4]; 4] = [
    [0.0, 0.0, 0.0, 1.0],
    [0.0, 0.25, 0.0, 0.96875],
    [0.125, 0.484375, 0.0, 0.8671875],
    [0.0, 0.703125, 0.0625, 0.70703125],
];

/// The rotation with the index `i`, modulo the number of rotations.
fn turn(i: u32) -> Quat {
    Quat::from_array(TURNS[i as usize % 4])
}

fn cape(pin_mode: PinMode, max_stretch: f32) -> GridDesc {
    let mut desc =
        GridDesc { columns: 12, rows: 18, spacing: 0.0625, pin_mode, ..GridDesc::default() };
    desc.material = Material { tear_stretch: 1.5, ..Material::preset(Preset::Cotton) };
    desc.settings = Settings { max_stretch, tearing: true, ..Settings::default() };
    desc
}

/// A cape follows a body that moves and rotates, attached by hard and soft pins, with heavier
/// particles in its hem. It is cut up to its collar, saved, teleported and detached.
pub fn garment_on_a_moving_body(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&cape(PinMode::None, 0.0))?;
    let collar: Vec<u32> = (0..12).collect();
    let body = cloth.attach(&collar, Vec3::new(0.375, 0.0, -0.125), turn(0))?;
    let arm = cloth.attach(&[36, 37], Vec3::ZERO, turn(1))?;
    cloth.set_pin_stiffness(&[2, 3, 8, 9, 36], 24.0)?;
    cloth.set_mass_scales(&[204, 207, 211, 215], &[16.0, 0.25, 8.0, 16.0])?;
    let velocity = Vec3::new(0.5, 0.25, 3.0);
    cloth.set_wind(Wind { velocity, gust: 0.5, turbulence: 0.5, ..Wind::default() })?;
    let step = Vec3::new(0.125, 0.0078125, 0.03125);
    for i in 1..=60 {
        let to = along(Vec3::new(0.375, 0.0, -0.125), step, i);
        cloth.move_attachment(body, to, turn(i / 8))?;
        cloth.move_attachment(arm, along(Vec3::ZERO, step, i), turn(1 + i / 16))?;
        trace.step(&mut cloth, 1);
    }
    let at = along(Vec3::new(0.375, 0.5, -8.0), step, 60);
    trace.record_word(u64::from(cloth.cut(at, at - Vec3::Y * 1.5, Vec3::Z * 16.0)?));
    cloth.attached(body)?.for_each(|particle| trace.record_word(u64::from(particle)));
    let mut restored = Cloth::restore(&cloth.save())?;
    for cloth in [&mut cloth, &mut restored] {
        cloth.detach(arm)?;
        cloth.move_attachment(body, along(Vec3::new(0.375, 0.0, -0.125), step, 62), turn(3))?;
        trace.step(cloth, 20);
    }
    cloth.set_settings(Settings { substeps: 3, iterations: 1, ..cloth.settings().clone() })?;
    trace.step(&mut cloth, 20);
    cloth.set_frame(along(Vec3::ZERO, step, 62), turn(3))?;
    cloth.teleport(Vec3::new(-4.0, 1.0, 0.5), turn(2))?;
    trace.step(&mut cloth, 20);
    cloth.detach(body)?;
    trace.step(&mut cloth, 20);
    trace.record_outputs(&mut cloth);
    assert_eq!(trace.count_of(EventKind::Recovered), 0, "the cape must not trigger a recovery");
    Ok(())
}

/// A cape in the frame of a body that moves and rotates over a floor, with an inertia share of 1,
/// 1/4 and 0; a ball moves with the body.
pub fn cape_in_a_running_frame(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&cape(PinMode::None, 0.0625))?;
    let shoulders: Vec<u32> = (0..12).collect();
    let body = cloth.attach(&shoulders, Vec3::ZERO, turn(0))?;
    let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.1875, ..ColliderDesc::default() };
    let back = Vec3::new(0.34375, -0.5, -0.25);
    let back = cloth.add_collider(&ColliderDesc { position: back, ..ball })?;
    cloth.add_collider(&ColliderDesc {
        shape: Shape::Plane,
        position: Vec3::Y * -1.0,
        ..ColliderDesc::default()
    })?;
    let anchored: Vec<u32> = (60..72).collect();
    cloth.set_max_distances(&anchored, &[0.25; 12])?;
    for i in 1..=90 {
        let (to, turned) = (along(Vec3::ZERO, Vec3::new(0.125, 0.0, 0.0625), i), turn(i / 4));
        cloth.move_frame(to, turned, [1.0, 0.25, 0.0][i as usize / 31])?;
        cloth.move_attachment(body, to, turned)?;
        cloth.move_collider(back, to + Vec3::new(0.34375, -0.5, -0.25), turned)?;
        if i == 50 {
            cloth = Cloth::restore(&cloth.save())?;
        }
        trace.step(&mut cloth, 1);
    }
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// A cape on a body that gets one pose per frame, while frames run 0 to 5 ticks. Attachments, pins,
/// anchors, a grab, a collider and the frame move; the cape tears.
pub fn cape_at_low_frame_rates(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&cape(PinMode::None, 0.0))?;
    let body = cloth.attach(&[0, 1, 2, 3, 8, 9, 10, 11], Vec3::ZERO, turn(0))?;
    let anchored: Vec<u32> = (96..108).collect();
    cloth.set_max_distances(&anchored, &[0.125; 12])?;
    cloth.set_backstops(&anchored, &[0.015625; 12], &[0.5; 12])?;
    let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.1875, ..ColliderDesc::default() };
    let back = cloth.add_collider(&ColliderDesc { shape: Shape::Box, ..ball })?;
    let grab = cloth.grab_particle(210)?;
    let step = Vec3::new(0.0625, 0.0078125, 0.03125);
    for i in 1..=60 {
        let (to, turned) = (along(Vec3::ZERO, step, i), turn(i / 4));
        if i % 3 == 0 {
            cloth.move_frame(to, turned, 0.5)?;
        }
        cloth.move_attachment(body, to, turned)?;
        cloth.set_pin_targets(&[5, 6], &[5.0, 6.0].map(|x| to + Vec3::X * (x * 0.0625)))?;
        let anchors: Vec<Vec3> =
            (0..12).map(|x| to + Vec3::new(x as f32 * 0.0625, -0.5, 0.0)).collect();
        let normal = if i % 16 < 8 { Vec3::new(0.25, 0.0, -2.0) } else { -Vec3::Z };
        cloth.set_anchors(&anchored, &anchors, &[normal; 12])?;
        cloth.move_collider(back, to + Vec3::new(0.34375, -0.75, -0.375), turned)?;
        cloth.move_grab(grab, to + Vec3::new(0.5, -1.5, 0.25))?;
        if i == 30 {
            cloth = Cloth::restore(&cloth.save())?;
        }
        trace.advance(&mut cloth, (i % 6) as f32 / 64.0)?;
    }
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// A skirt with anchors, max distances, backstops and a strain limit, pulled by a grab.
pub fn skirt_on_leashes(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&cape(PinMode::TopEdge, 0.0625))?;
    let anchored: Vec<u32> = (12..216).collect();
    let rest: Vec<Vec3> = anchored
        .iter()
        .map(|i| Vec3::new((i % 12) as f32, -((i / 12) as f32), 0.0) * 0.0625)
        .collect();
    let distances: Vec<f32> = anchored.iter().map(|i| (i / 12) as f32 / 64.0).collect();
    cloth.set_max_distances(&anchored, &distances)?;
    cloth.set_backstops(&anchored[24..], &[0.015625; 180], &[0.5; 180])?;
    let waist: Vec<u32> = (0..12).collect();
    for i in 1..=80 {
        let to = along(Vec3::ZERO, Vec3::new(0.03125, 0.0, 0.0625), if i < 50 { i } else { 50 });
        let anchors: Vec<Vec3> = rest.iter().map(|x| *x + to).collect();
        let normal = if i % 16 < 8 { Vec3::new(0.25, 0.0, -2.0) } else { -Vec3::Z };
        let normals = vec![normal; if i % 4 == 0 { 0 } else { 204 }];
        cloth.set_anchors(&anchored, &anchors, &normals)?;
        let pins: Vec<Vec3> = waist.iter().map(|p| to + Vec3::X * (*p as f32 * 0.0625)).collect();
        cloth.set_pin_targets(&waist, &pins)?;
        if i == 40 {
            let grab = cloth.grab_particle(150)?;
            cloth.move_grab(grab, to + Vec3::new(0.5, -0.75, 0.75))?;
            trace.step(&mut cloth, 10);
            cloth.release(grab)?;
        }
        trace.step(&mut cloth, 1);
    }
    let from = along(Vec3::new(0.34375, -0.28125, -8.0), Vec3::new(0.03125, 0.0, 0.0625), 50);
    trace.record_word(u64::from(cloth.cut(from, from - Vec3::Y * 2.0, Vec3::Z * 16.0)?));
    let mut restored = Cloth::restore(&cloth.save())?;
    trace.step(&mut cloth, 20);
    trace.step(&mut restored, 20);
    cloth.clear_leashes();
    trace.step(&mut cloth, 20);
    trace.record_outputs(&mut cloth);
    Ok(())
}
