//! A scene with painted maps on a body that deforms.

use crate::Trace;
use muslin::glam::Vec3;
use muslin::{
    Cloth, ColliderDesc, EventKind, GridDesc, Map, Material, PinMode, Preset, Result, Settings,
    Shape,
};

/// Vertices around and rings of the body.
const BODY: [u32; 2] = [8, 9];

/// The body: an octagonal tube whose rings are wider or narrower by `swell`.
fn body(swell: impl Fn(u32) -> f32) -> Vec<Vec3> {
    const OCTAGON: [[f32; 2]; 8] = [
        [1.0, 0.0],
        [0.75, 0.75],
        [0.0, 1.0],
        [-0.75, 0.75],
        [-1.0, 0.0],
        [-0.75, -0.75],
        [0.0, -1.0],
        [0.75, -0.75],
    ];
    let [around, rings] = BODY;
    let position = |v: u32| {
        let ([x, z], ring) = (OCTAGON[(v % around) as usize], v / around);
        let radius = 0.25 + swell(ring);
        Vec3::new(0.40625 + x * radius, ring as f32 * -0.125, z * radius - 0.3125)
    };
    (0..around * rings).map(position).collect()
}

/// A coat with a stiff collar, limp sleeves, a weak seam, slippery and thick parts hangs on a body
/// that breathes and bends; its seam tears, and it loses its maps one after the other.
pub fn coat_with_painted_maps(trace: &mut Trace) -> Result<()> {
    let (columns, rows) = (14, 18);
    let mut cloth = Cloth::grid(&GridDesc {
        columns,
        rows,
        spacing: 0.0625,
        pin_mode: PinMode::TopEdge,
        material: Material {
            tear_stretch: 1.5,
            stretch_stiffness_warp: 400.0,
            stretch_stiffness_weft: 400.0,
            ..Material::preset(Preset::Denim)
        },
        settings: Settings { tearing: true, ..Settings::default() },
        ..GridDesc::default()
    })?;
    let paint = |scale: &dyn Fn(u32, u32) -> f32| -> Vec<f32> {
        (0..columns * rows).map(|i| scale(i % columns, i / columns)).collect()
    };
    let collar = paint(&|_, row| if row < 4 { 8.0 } else { 1.0 });
    let limp = paint(&|column, _| column as f32 * 0.125);
    let seam = paint(&|_, row| if row == 9 { 0.125 } else { 4.0 });
    let slippery = paint(&|column, row| if (column + row) % 4 < 2 { 0.0 } else { 2.0 });
    let thick = paint(&|_, row| 1.0 + row as f32 * 0.25);
    let dragged = paint(&|column, _| if column < 7 { 0.5 } else { 3.0 });
    let all = [
        (Map::Stretch, &collar),
        (Map::Bend, &limp),
        (Map::Tear, &seam),
        (Map::Friction, &slippery),
        (Map::Thickness, &thick),
        (Map::Drag, &dragged),
    ];
    for (map, scales) in all {
        cloth.set_map(map, Some(scales))?;
    }
    let [around, rings] = BODY;
    let cell = |v: u32| {
        let (a, b) = (v, v / around * around + (v + 1) % around);
        [a, b, a + around, b, b + around, a + around]
    };
    let body_mesh = ColliderDesc {
        shape: Shape::Mesh,
        positions: body(|_| 0.0),
        indices: (0..around * (rings - 1)).flat_map(cell).collect(),
        friction: 0.5,
        thickness: 0.0078125,
        ..ColliderDesc::default()
    };
    let collider = cloth.add_collider(&body_mesh)?;
    for tick in 1..=60 {
        // A wave that runs down the body.
        let swell = |ring: u32| {
            let phase = (tick + 8 * (8 - ring)) % 64;
            (if phase < 32 { phase } else { 64 - phase }) as f32 * 0.001953125
        };
        let share = if tick < 16 { tick as f32 * 0.0625 } else { 1.0 };
        cloth.update_collider(collider, &body(|ring| swell(ring) * share))?;
        trace.step(&mut cloth, 1);
    }
    let push = cloth.collider_impulse(collider)?.linear.length();
    assert!(push > 0.0, "the coat must touch the body");
    let grab = cloth.grab_particle(14 * columns + 7)?;
    for i in 1..=30 {
        cloth.move_grab(grab, Vec3::new(0.4375, -0.875, i as f32 * 0.03125))?;
        trace.step(&mut cloth, 1);
    }
    cloth.release(grab)?;
    let mut restored = Cloth::restore(&cloth.save())?;
    trace.step(&mut restored, 10);
    for (map, _) in all {
        cloth.set_map(map, None)?;
        trace.step(&mut cloth, 5);
    }
    trace.record_outputs(&mut cloth);
    let torn = trace.count_of(EventKind::EdgeTorn);
    assert!(torn >= 5, "only {torn} edges of the seam tore");
    Ok(())
}
