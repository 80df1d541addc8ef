//! Scenes with panels that are sewn together, and with closed pieces under pressure.

use super::along;
use crate::Trace;
use muslin::glam::{Quat, Vec3};
use muslin::{
    Cloth, ColliderDesc, EventKind, Material, MeshDesc, Preset, Result, SelfCollision, Settings,
    SewDesc, SewKind, Shape,
};

/// Appends a panel of `columns` x `rows` vertices from `start`, with sides along x and `down`, and
/// returns the index of its first vertex. `is_front` sets the side that its triangles face.
fn push_panel(
    desc: &mut MeshDesc,
    [columns, rows]: [u32; 2],
    (start, down): (Vec3, Vec3),
    is_front: bool,
) -> u32 {
    let first = desc.positions.len() as u32;
    for row in 0..rows {
        for column in 0..columns {
            let at = Vec3::new(column as f32, 0.0, 0.0) * 0.0625;
            desc.positions.push(start + at + down * (row as f32 * 0.0625));
        }
    }
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = first + row * columns + column;
            let (b, c, d) = (a + 1, a + columns, a + columns + 1);
            desc.indices.extend(if is_front { [a, c, b, b, c, d] } else { [a, b, c, b, d, c] });
        }
    }
    first
}

/// Front and back of a tunic are sewn around a body of two capsules, which then moves and turns;
/// the stitches of one side tear.
pub fn panels_sewn_on_a_body(trace: &mut Trace) -> Result<()> {
    let mut desc = MeshDesc::default();
    let (columns, rows) = (11, 14);
    let at = |z: f32| (Vec3::new(-0.3125, 0.5, z), Vec3::NEG_Y);
    push_panel(&mut desc, [columns, rows], at(0.25), true);
    let back = push_panel(&mut desc, [columns, rows], at(-0.25), false);
    desc.material = Material { friction: 0.5, ..Material::preset(Preset::Cotton) };
    let mut cloth = Cloth::mesh(&desc)?;
    let capsule = ColliderDesc {
        shape: Shape::Capsule,
        radius: 0.125,
        half_height: 0.375,
        ..ColliderDesc::default()
    };
    let trunk = cloth.add_collider(&capsule)?;
    let across = Quat::from_xyzw(0.0, 0.0, 0.70703125, 0.70703125);
    let shoulders = ColliderDesc { radius: 0.09375, half_height: 0.1875, ..capsule };
    let place = Vec3::Y * 0.375;
    let shoulders =
        cloth.add_collider(&ColliderDesc { position: place, rotation: across, ..shoulders })?;
    let pair = |particle: u32| [particle, back + particle];
    let neck: Vec<[u32; 2]> = [0, 1, 2, 3, 7, 8, 9, 10].map(pair).to_vec();
    let side = |column: u32| (4..rows).map(move |row| row * columns + column);
    let left: Vec<[u32; 2]> = side(0).map(pair).collect();
    let right: Vec<[u32; 2]> = side(columns - 1).map(pair).collect();
    let weld = SewDesc { speed: 1.0, ..SewDesc::default() };
    cloth.sew(&neck, &weld)?;
    cloth.sew(&left, &weld)?;
    cloth.sew(&right, &SewDesc { kind: SewKind::Stitch, tear_force: 2.0, ..weld })?;
    trace.step(&mut cloth, 60);
    for [a, b] in neck.iter().chain(&left) {
        assert_eq!(cloth.position(*a), cloth.position(*b), "a pair is open");
    }
    let mut restored = Cloth::restore(&cloth.save())?;
    for i in 1..=30 {
        let to = along(Vec3::ZERO, Vec3::new(0.015625, 0.0, 0.0078125), i);
        // Nearly of unit length; the cloth normalises it.
        let w = 1.0 - (i * i) as f32 / 32768.0;
        let turn = Quat::from_xyzw(0.0, i as f32 * 0.0078125, 0.0, w);
        cloth.move_collider(trunk, to, turn)?;
        cloth.move_collider(shoulders, to + place, across)?;
        trace.step(&mut cloth, 1);
    }
    let grab = cloth.grab_particle(10 * columns + columns - 1)?;
    for i in 1..=30 {
        cloth.move_grab(grab, along(Vec3::new(0.75, -0.125, 0.25), Vec3::X * 0.03125, i))?;
        trace.step(&mut cloth, 1);
    }
    trace.step(&mut restored, 10);
    trace.record_outputs(&mut cloth);
    let torn = trace.count_of(EventKind::StitchTorn);
    assert!(torn > 0, "no stitch tore");
    Ok(())
}

/// The volume of a closed mesh [m³].
fn volume(cloth: &Cloth) -> f32 {
    let corners = |t: &[u32]| [0, 1, 2].map(|k| cloth.positions()[t[k] as usize]);
    let part = |[a, b, c]: [Vec3; 3]| a.dot(b.cross(c)) / 6.0;
    cloth.indices().chunks_exact(3).map(|t| part(corners(t))).sum()
}

/// A cube of fabric is inflated to a balloon, falls on a floor and bounces, loses its pressure, and
/// bursts at a cut.
pub fn balloon(trace: &mut Trace) -> Result<()> {
    let mut desc = MeshDesc { weld_distance: 1.0 / 1024.0, ..MeshDesc::default() };
    let size = 0.375;
    // Six sides of 7 x 7 vertices, welded along the edges.
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let (u, v) = (axes[(axis + 1) % 3] * sign, axes[(axis + 2) % 3]);
            let start = (axes[axis] * sign - u - v) * (0.5 * size);
            let first = desc.positions.len() as u32;
            for i in 0..49 {
                let (x, y) = ((i % 7) as f32 * 0.0625, (i / 7) as f32 * 0.0625);
                desc.positions.push(start + u * x + v * y);
            }
            for cell in 0..36 {
                let a = first + cell / 6 * 7 + cell % 6;
                desc.indices.extend([a, a + 1, a + 7, a + 1, a + 8, a + 7]);
            }
        }
    }
    desc.material = Material {
        stretch_stiffness_warp: 200.0,
        stretch_stiffness_weft: 200.0,
        restitution: 0.5,
        ..Material::default()
    };
    desc.settings = Settings { pressure: 40.0, damping: 0.25, ..Settings::default() };
    let mut cloth = Cloth::mesh(&desc)?;
    assert_eq!(cloth.particle_count(), 218);
    let floor = ColliderDesc { position: Vec3::Y * -0.5, ..ColliderDesc::default() };
    cloth.add_collider(&floor)?;
    let flat = volume(&cloth);
    trace.step(&mut cloth, 60);
    assert!(volume(&cloth) > 1.25 * flat, "{} m³, was {flat} m³", volume(&cloth));
    let mut restored = Cloth::restore(&cloth.save())?;
    trace.step(&mut restored, 10);
    cloth.set_settings(Settings { pressure: 10.0, ..cloth.settings().clone() })?;
    trace.step(&mut cloth, 40);
    let center = cloth.positions()[0].y;
    let from = Vec3::new(-1.0, (center * 64.0).floor() / 64.0 + 0.0078125, -1.0);
    trace.record_word(u64::from(cloth.cut(from, from + Vec3::X * 2.0, Vec3::Z * 1.0)?));
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// Two sheets are sewn along their borders above a ball, inflated once they are closed, and fall on
/// it, with surface collision.
pub fn cushion(trace: &mut Trace) -> Result<()> {
    let mut desc = MeshDesc::default();
    let count = 9;
    let at = |y: f32| (Vec3::new(-0.25, y, -0.25), Vec3::Z);
    push_panel(&mut desc, [count; 2], at(0.03125), true);
    let below = push_panel(&mut desc, [count; 2], at(0.0), false);
    desc.material = Material {
        stretch_stiffness_warp: 500.0,
        stretch_stiffness_weft: 500.0,
        thickness: 0.001953125,
        ..Material::preset(Preset::Cotton)
    };
    desc.settings =
        Settings { self_collision: SelfCollision::Surface, pressure: 30.0, ..Settings::default() };
    let mut cloth = Cloth::mesh(&desc)?;
    cloth.add_collider(&ColliderDesc {
        shape: Shape::Sphere,
        position: Vec3::new(0.0625, -0.75, 0.0),
        radius: 0.375,
        ..ColliderDesc::default()
    })?;
    let is_border =
        |i: &u32| (i / count).is_multiple_of(count - 1) || (i % count).is_multiple_of(count - 1);
    let border: Vec<[u32; 2]> =
        (0..count * count).filter(is_border).map(|i| [i, below + i]).collect();
    cloth.sew(&border, &SewDesc { speed: 0.5, ..SewDesc::default() })?;
    trace.step(&mut cloth, 30);
    for [a, b] in &border {
        assert_eq!(cloth.position(*a), cloth.position(*b), "a pair is open");
    }
    let middle = count * count / 2;
    let height =
        cloth.positions()[middle as usize].y - cloth.positions()[(below + middle) as usize].y;
    assert!(height > 0.0625, "the cushion is {height} m thick");
    trace.step(&mut cloth, 60);
    let mut restored = Cloth::restore(&cloth.save())?;
    trace.step(&mut restored, 10);
    trace.record_outputs(&mut cloth);
    Ok(())
}
