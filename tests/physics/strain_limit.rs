//! Tests of the strain limit (`max_stretch`): no link exceeds it after any tick, at any resolution,
//! tick length, density and load.

use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, EventKind, GridDesc, Material, PinMode, Preset, Wind};

/// Returns the largest ratio of length to rest length of all links.
fn max_length_ratio(cloth: &Cloth, rest: &[Vec3]) -> f32 {
    let (x, source) = (cloth.positions(), cloth.source_vertices());
    let at = |v: u32| rest[source[v as usize] as usize];
    let ratio = |(a, b, _)| {
        let span: Vec3 = x[b as usize] - x[a as usize];
        span.length() / (at(b) - at(a)).length()
    };
    cloth.links().map(ratio).fold(0.0, f32::max)
}

/// A strong wind with gusts and turbulence.
fn storm_wind() -> Wind {
    Wind { velocity: Vec3::new(4.0, 1.0, 12.0), gust: 1.0, turbulence: 0.5, ..Wind::default() }
}

/// A square grid of 1 m with a strain limit.
fn strain_limited_grid(
    columns: u32,
    pin_mode: PinMode,
    material: Material,
    max_stretch: f32,
) -> GridDesc {
    let spacing = 1.0 / (columns - 1) as f32;
    let mut desc = GridDesc { columns, rows: columns, spacing, pin_mode, ..GridDesc::default() };
    desc.material = material;
    desc.settings.max_stretch = max_stretch;
    desc
}

/// Simulates 3 s of storm and checks the strain limit after every tick.
fn assert_strain_limit_holds(desc: &GridDesc) {
    let mut cloth = Cloth::grid(desc).unwrap();
    let rest = cloth.positions().to_vec();
    cloth.set_wind(storm_wind()).unwrap();
    for tick in 0..(3.0 / desc.settings.tick) as u32 {
        cloth.step(1);
        let (max_ratio, most) = (max_length_ratio(&cloth, &rest), 1.0 + desc.settings.max_stretch);
        assert!(
            max_ratio <= most * 1.00001,
            "ratio {max_ratio} over {most} in tick {tick} of {desc:?}"
        );
        assert_eq!(
            cloth.stats().over_stretched,
            0,
            "ratio {max_ratio} over {most} in tick {tick} of {desc:?}"
        );
    }
    assert!(cloth.next_event().is_none());
}

#[test]
fn a_storm_stretches_no_link_past_the_strain_limit() {
    for material in [Material::default(), Material::preset(Preset::Silk)] {
        for (columns, pin_mode) in
            [(24, PinMode::TopEdge), (40, PinMode::TopCorners), (56, PinMode::TopCorners)]
        {
            assert_strain_limit_holds(&strain_limited_grid(
                columns,
                pin_mode,
                material.clone(),
                0.02,
            ));
        }
    }
}

#[test]
fn the_strain_limit_holds_at_any_tick_length_and_density() {
    for tick in [1.0 / 30.0, 1.0 / 240.0] {
        for density in [0.02, 3.0] {
            let material = Material { density, ..Material::preset(Preset::Cotton) };
            let mut desc = strain_limited_grid(24, PinMode::TopCorners, material, 0.01);
            desc.settings.tick = tick;
            assert_strain_limit_holds(&desc);
        }
    }
}

#[test]
fn a_breeze_stretches_a_sheet_without_strain_limit_by_less_than_two_percent() {
    for (pin_mode, most) in [(PinMode::TopEdge, 0.01), (PinMode::TopCorners, 0.02)] {
        let mut cloth = Cloth::grid(&GridDesc { pin_mode, ..GridDesc::default() }).unwrap();
        cloth.set_wind(Wind { velocity: Vec3::Z * 2.0, ..Wind::default() }).unwrap();
        for tick in 0..600 {
            cloth.step(1);
            let stretch = cloth.stats().max_stretch;
            assert!(stretch < most, "{pin_mode:?}: {stretch} in tick {tick}");
        }
    }
}

#[test]
fn a_cloth_held_apart_sends_one_event_and_recovers_after_release() {
    let desc = strain_limited_grid(24, PinMode::TopCorners, Material::preset(Preset::Cotton), 0.02);
    let mut cloth = Cloth::grid(&desc).unwrap();
    let rest = cloth.positions().to_vec();
    let grab = cloth.grab_particle(23 * 24 + 12).unwrap();
    cloth.move_grab(grab, Vec3::new(0.5, -2.0, 0.0)).unwrap();
    cloth.step(120);
    assert!(cloth.stats().over_stretched > 0);
    let events: Vec<_> = std::iter::from_fn(|| cloth.next_event()).collect();
    assert_eq!(events.len(), 1);
    assert_eq!(events[0].kind, EventKind::HeldApart);
    cloth.release(grab).unwrap();
    for _ in 0..120 {
        cloth.step(1);
        assert!(max_length_ratio(&cloth, &rest) <= 1.0201);
    }
    assert_eq!(cloth.stats().over_stretched, 0);
    assert!(cloth.next_event().is_none());
}

#[test]
fn fast_moving_pins_stretch_no_link_past_the_strain_limit() {
    let desc = strain_limited_grid(40, PinMode::TopEdge, Material::default(), 0.02);
    let mut cloth = Cloth::grid(&desc).unwrap();
    let rest = cloth.positions().to_vec();
    let top: Vec<u32> = (0..40).collect();
    for tick in 0..180 {
        let t = tick as f32 * 0.15;
        let shift = Vec3::new(t.sin(), 0.5 * (1.7 * t).sin(), (0.8 * t).cos() - 1.0) * 0.6;
        let targets: Vec<Vec3> = rest[..40].iter().map(|x| *x + shift).collect();
        cloth.set_pin_targets(&top, &targets).unwrap();
        cloth.step(1);
        let max_ratio = max_length_ratio(&cloth, &rest);
        assert!(max_ratio <= 1.0201, "ratio {max_ratio} in tick {tick}");
    }
}

#[test]
fn a_cloth_released_from_a_large_stretch_does_not_fly_up() {
    for (pin_mode, max_stretch) in
        [(PinMode::TopEdge, 0.0), (PinMode::TopCorners, 0.0), (PinMode::TopCorners, 0.02)]
    {
        let mut cloth =
            Cloth::grid(&strain_limited_grid(40, pin_mode, Material::default(), max_stretch))
                .unwrap();
        let top = cloth.positions()[0].y;
        let grabs = [(1380, -1.5), (1420, 1.5)].map(|(particle, dx)| {
            let grab = cloth.grab_particle(particle).unwrap();
            let to = cloth.positions()[particle as usize] + Vec3::new(dx, -0.3, 0.1);
            cloth.move_grab(grab, to).unwrap();
            grab
        });
        cloth.step(180);
        assert!(cloth.stats().max_stretch > 0.3, "{}", cloth.stats().max_stretch);
        grabs.into_iter().for_each(|grab| cloth.release(grab).unwrap());
        for tick in 0..60 {
            cloth.step(1);
            let highest = cloth.positions().iter().map(|x| x.y).fold(top, f32::max);
            assert!(
                highest < top + 0.25,
                "{pin_mode:?} {max_stretch}: {} m above the pins in tick {tick}",
                highest - top
            );
        }
        assert_eq!(
            cloth.stats().over_stretched,
            0,
            "{pin_mode:?} {max_stretch}: links stay over-stretched"
        );
    }
}

#[test]
fn a_particle_pulled_far_out_returns_within_the_strain_limit_after_release() {
    let desc = strain_limited_grid(40, PinMode::TopCorners, Material::default(), 0.02);
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(60);
    let particle = 20 * 40 + 20;
    let grab = cloth.grab_particle(particle).unwrap();
    let start = cloth.positions()[particle as usize];
    for tick in 0..120 {
        let displacement = Vec3::new(0.02, -0.02, 0.01) * tick as f32;
        cloth.move_grab(grab, start + displacement).unwrap();
        cloth.step(1);
    }
    assert!(cloth.stats().over_stretched > 0);
    cloth.release(grab).unwrap();
    cloth.step(5);
    assert_eq!(cloth.stats().over_stretched, 0);
    cloth.step(120);
    assert!(cloth.stats().max_stretch <= 0.0201, "{}", cloth.stats().max_stretch);
}

/// In a heap of folds, some links cannot meet their rest length and the strain limit at once. The
/// cloth must come to rest nevertheless.
#[test]
fn a_heap_on_the_floor_comes_to_rest_within_the_strain_limit() {
    for max_stretch in [0.02, 0.05] {
        let mut cloth =
            Cloth::grid(&strain_limited_grid(24, PinMode::None, Material::default(), max_stretch))
                .unwrap();
        let floor = ColliderDesc { position: Vec3::Y * -1.6, ..ColliderDesc::default() };
        cloth.add_collider(&floor).unwrap();
        for (i, x) in cloth.positions().to_vec().into_iter().enumerate() {
            let twist = Vec3::new(0.3 * x.y, 0.0, 0.5 * (3.0 * x.x).sin());
            cloth.set_velocity(i as u32, twist).unwrap();
        }
        cloth.step(900);
        let mass: f32 = (0..cloth.positions().len() as u32).map(|i| cloth.mass(i).unwrap()).sum();
        for _ in 0..60 {
            cloth.step(1);
            let stats = cloth.stats();
            let speed = (2.0 * stats.kinetic_energy / mass).sqrt();
            assert!(speed < 1.0e-3, "{speed} m/s at {max_stretch}");
            assert!(stats.max_stretch <= max_stretch && stats.over_stretched == 0);
        }
    }
}

/// When the strain limit cannot be met within a tick, the shape of the cloth is rolled back, but
/// its centre of mass continues on the free-fall parabola.
#[test]
fn a_free_cloth_falls_at_g_while_the_strain_limit_acts() {
    for (max_stretch, ticks) in [(0.005, 40), (0.02, 60)] {
        let material = Material { drag: 0.0, lift: 0.0, ..Material::preset(Preset::Paper) };
        let mut desc = strain_limited_grid(20, PinMode::None, material, max_stretch);
        (desc.settings.tethers, desc.settings.damping) = (false, 0.0);
        let mut cloth = Cloth::grid(&desc).unwrap();
        let center = |cloth: &Cloth| {
            let count = cloth.positions().len() as u32;
            let each = |i: u32| (cloth.mass(i).unwrap(), cloth.positions()[i as usize]);
            let (mass, sum) = (0..count)
                .map(each)
                .fold((0.0, Vec3::ZERO), |(mass, sum), (m, x)| (mass + m, sum + x * m));
            sum * (1.0 / mass)
        };
        let start = center(&cloth);
        // Alternating velocities crumple the sheet, so that the strain limit rolls back far.
        for (i, x) in cloth.positions().to_vec().into_iter().enumerate() {
            let push = Vec3::new(-4.0 * (x.x - start.x), 0.0, 6.0 * (9.0 * x.x).sin());
            cloth.set_velocity(i as u32, push).unwrap();
        }
        let moved = center(&cloth) - start;
        assert_eq!(moved, Vec3::ZERO);
        for tick in 1..=ticks {
            cloth.step(1);
            assert!(
                cloth.stats().max_stretch <= max_stretch * 1.0001,
                "over-stretched at tick {tick}"
            );
        }
        let time = ticks as f32 / 60.0;
        let fallen = (center(&cloth) - start).y / (-0.5 * 9.81 * time * time);
        assert!(
            (0.95..1.03).contains(&fallen),
            "fell {fallen} of the exact height with limit {max_stretch}"
        );
    }
}
