//! Tear strength and tear propagation: cases T1 to T4 and T7 of the validation list.

use crate::common::{assert_cut_invariants, bare, bare_grid, total_mass};
use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, EventKind, LinkKind, MeshDesc, PinMode};

/// The tear strain of the cloths in this file.
const LIMIT: f32 = 0.3;

/// The largest strain of the links that can tear.
fn max_strain(cloth: &Cloth) -> f32 {
    cloth.stats().max_stretch
}

/// Drains the events and returns whether an edge has torn.
fn has_torn(cloth: &mut Cloth) -> bool {
    let events = core::iter::from_fn(|| cloth.next_event());
    events.filter(|event| event.kind == EventKind::EdgeTorn).count() > 0
}

/// Returns a strip of 12 × 40 cells of 2 cm, narrowed to 7 cells in its middle, and the pinned
/// particles of its last row; the first row is pinned, too. All links are stretch links, so
/// `max_stretch` of `stats` is the strain of links that can tear.
fn narrowed_strip(tick: f32) -> (Cloth, Vec<u32>) {
    let (columns, rows) = (13_u32, 41_u32);
    let is_cell = |column: u32, row: u32| !(14..26).contains(&row) || (3..10).contains(&column);
    let mut numbers = vec![u32::MAX; (columns * rows) as usize];
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for (row, column) in
        (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (row, column)))
    {
        if !is_cell(column, row) {
            continue;
        }
        let at = row * columns + column;
        let corners = [at, at + columns, at + columns + 1, at + 1].map(|grid| {
            if numbers[grid as usize] == u32::MAX {
                numbers[grid as usize] = positions.len() as u32;
                positions.push(
                    Vec3::new((grid % columns) as f32, -((grid / columns) as f32), 0.0) * 0.02,
                );
            }
            numbers[grid as usize]
        });
        let [a, b, c, d] = corners;
        indices.extend(if (row + column) % 2 == 0 {
            [a, b, c, a, c, d]
        } else {
            [a, b, d, b, c, d]
        });
    }
    let (mut settings, mut material) = bare();
    settings.tick = tick;
    settings.tearing = true;
    settings.tethers = false;
    settings.gravity = Vec3::ZERO;
    settings.damping = 4.0;
    // Enough sweeps for the same strain along the whole strip at this slow pull.
    (settings.substeps, settings.iterations) = (16, 8);
    material.tear_stretch = 1.0 + LIMIT;
    material.tear_variation = 0.0;
    (material.stretch_stiffness_warp, material.stretch_stiffness_weft) = (100.0, 100.0);
    let row = |row: u32| (0..columns).map(move |column| row * columns + column);
    let held: Vec<u32> = row(0).chain(row(rows - 1)).map(|grid| numbers[grid as usize]).collect();
    let uvs = positions.iter().map(|x: &Vec3| x.truncate()).collect();
    let desc = MeshDesc {
        positions,
        indices,
        uvs,
        pinned: held.clone(),
        settings,
        material,
        ..MeshDesc::default()
    };
    (Cloth::mesh(&desc).unwrap(), held[columns as usize..].to_vec())
}

/// Moves `held` down by `length` [m] over `seconds`, until something tears. Returns the pull [m] at
/// that tick, and the largest strains before it and, in a copy that cannot tear, after it.
fn pull_until_tear(
    cloth: &mut Cloth,
    held: &[u32],
    length: f32,
    seconds: f32,
) -> Option<(f32, [f32; 2])> {
    let ticks = (seconds / cloth.settings().tick) as u32;
    let starts: Vec<Vec3> = held.iter().map(|i| cloth.positions()[*i as usize]).collect();
    for tick in 1..=ticks {
        let by = length * tick as f32 / ticks as f32;
        let targets: Vec<Vec3> = starts.iter().map(|x| *x - Vec3::Y * by).collect();
        cloth.set_pin_targets(held, &targets).unwrap();
        let before = max_strain(cloth);
        let mut untorn = cloth.clone();
        cloth.step(1);
        if has_torn(cloth) {
            let mut settings = untorn.settings().clone();
            settings.tearing = false;
            untorn.set_settings(settings).unwrap();
            untorn.step(1);
            return Some((by, [before, max_strain(&untorn)]));
        }
    }
    None
}

#[test]
fn t1_and_t3_a_strip_tears_at_its_tear_strain_at_any_tick_rate() {
    let mut pulls = Vec::new();
    for rate in [30.0, 60.0, 120.0, 240.0] {
        let (mut cloth, held) = narrowed_strip(1.0 / rate);
        let (by, [before, after]) =
            pull_until_tear(&mut cloth, &held, 0.2, 10.0).expect("it tears");
        assert!(before <= LIMIT && after > LIMIT, "at {rate} Hz from {before} to {after}");
        pulls.push(by);
    }
    let most = pulls.iter().copied().fold(0.0, f32::max);
    let least = pulls.iter().copied().fold(f32::INFINITY, f32::min);
    assert!(most - least < 0.02 * most, "it tore when pulled by {pulls:?} m");
}

#[test]
fn t1_nothing_tears_just_below_the_tear_strain() {
    let (mut cloth, held) = narrowed_strip(1.0 / 60.0);
    // Strain the strip to 0.98 of the limit, and hold it there for five seconds.
    let mut by = 0.0;
    let starts: Vec<Vec3> = held.iter().map(|i| cloth.positions()[*i as usize]).collect();
    while max_strain(&cloth) < 0.98 * LIMIT {
        by += 0.0002;
        let targets: Vec<Vec3> = starts.iter().map(|x| *x - Vec3::Y * by).collect();
        cloth.set_pin_targets(&held, &targets).unwrap();
        cloth.step(1);
    }
    cloth.step(300);
    assert!(max_strain(&cloth) > 0.95 * LIMIT);
    assert!(!has_torn(&mut cloth));
}

#[test]
fn t2_a_strip_tears_at_its_top_when_its_weight_exceeds_its_strength() {
    let (rows, spacing) = (31_u32, 0.02);
    let mut desc = bare_grid(4, rows, spacing, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.settings.tethers = false;
    desc.settings.damping = 4.0;
    desc.settings.substeps = 16;
    desc.settings.gravity = Vec3::ZERO;
    desc.material.tear_stretch = 1.0 + LIMIT;
    desc.material.tear_variation = 0.0;
    (desc.material.stretch_stiffness_warp, desc.material.stretch_stiffness_weft) = (20.0, 20.0);
    desc.material.shear_stiffness = 0.01;
    desc.material.bend_stiffness = 0.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    // The first links carry all but half a cell of the strip; stretching does not narrow it.
    let length = (rows - 1) as f32 * spacing - 0.5 * spacing;
    let exact = LIMIT * 20.0 / (desc.material.density * length);
    for tick in 1..=1800 {
        let gravity = 1.3 * exact * tick as f32 / 1800.0;
        let settings =
            muslin::Settings { gravity: Vec3::NEG_Y * gravity, ..cloth.settings().clone() };
        cloth.set_settings(settings).unwrap();
        cloth.step(1);
        let torn = core::iter::from_fn(|| cloth.next_event())
            .find(|event| event.kind == EventKind::EdgeTorn);
        if let Some(torn) = torn {
            let row = torn.particle_a.min(torn.particle_b) / 4;
            assert!(row < 2, "it tore in row {row}");
            let off = (gravity - exact).abs() / exact;
            assert!(off < 0.05, "it tore at {gravity} m/s², expected {exact}");
            return;
        }
    }
    panic!("nothing tore");
}

/// Returns the pull [m] at which a cut of 25 cm in a square of 1 m grows. The cut lies `offset`
/// cells below the middle row; the square is held at its top and bottom.
fn notch_pull(nodes: u32, offset: f32) -> f32 {
    let spacing = 1.0 / (nodes - 1) as f32;
    let mut desc = bare_grid(nodes, nodes, spacing, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.settings.tethers = false;
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.damping = 2.0;
    desc.material.tear_stretch = 1.0 + LIMIT;
    desc.material.tear_variation = 0.0;
    (desc.material.stretch_stiffness_warp, desc.material.stretch_stiffness_weft) = (200.0, 200.0);
    desc.material.shear_stiffness = 100.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let y = -((nodes / 2) as f32 + offset) * spacing;
    let at = |x: f32| Vec3::new(x, y, -1.0);
    assert!(cloth.cut(at(-1.0), at(0.251), Vec3::Z * 2.0).unwrap() > 4);
    has_torn(&mut cloth);
    let bottom: Vec<u32> = (nodes * (nodes - 1)..nodes * nodes).collect();
    pull_until_tear(&mut cloth, &bottom, 0.2, 10.0).expect("the cut grows").0
}

#[test]
fn t4_a_notch_grows_at_the_same_pull_at_any_resolution() {
    for (offset, spread) in [(0.0, 0.1), (0.5, 0.3)] {
        let pulls = [24, 40, 56].map(|nodes| notch_pull(nodes, offset));
        let most = pulls.iter().copied().fold(0.0, f32::max);
        let least = pulls.iter().copied().fold(f32::INFINITY, f32::min);
        assert!(most - least < spread * least, "cut {offset} cells below a row: {pulls:?} m");
    }
}

#[test]
fn t7_a_rip_leaves_a_clean_mesh_without_overstretched_links() {
    let mut desc = bare_grid(24, 24, 0.04, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.settings.max_tears_per_tick = 64;
    desc.material.tear_stretch = 1.5;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    let grab = cloth.grab_particle(12 * 24 + 12).unwrap();
    for tick in 0..180 {
        cloth.move_grab(grab, Vec3::new(0.48, -1.0, 0.02 * tick as f32)).unwrap();
        cloth.step(1);
    }
    cloth.release(grab).unwrap();
    cloth.step(120);
    assert_cut_invariants(&cloth, &before);
    assert!((total_mass(&cloth) - total_mass(&before)).abs() < 1.0e-6 * total_mass(&before));
    let torn = cloth.positions().len() - before.positions().len();
    assert!(torn >= 8, "only {torn} vertices split");
    for (a, b, kind) in cloth.links().filter(|link| link.2 != LinkKind::Bend) {
        let at = |v: u32| cloth.positions()[v as usize];
        let flat = |v: u32| cloth.uvs()[v as usize] * Vec2::splat(23.0 * 0.04);
        let (length, rest) = ((at(b) - at(a)).length(), (flat(b) - flat(a)).length());
        assert!(
            length < 1.5 * 1.05 * rest,
            "{kind:?} {a}–{b} is {} times its length",
            length / rest
        );
    }
}

#[test]
fn a_yank_opens_one_slit_and_detaches_few_pieces() {
    let mut desc = bare_grid(40, 40, 0.05, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.5;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(60);
    let from = cloth.positions()[20 * 40 + 20];
    let grab = cloth.grab_particle(20 * 40 + 20).unwrap();
    for tick in 1..=60 {
        cloth.move_grab(grab, from + Vec3::new(0.0, -0.01, 0.04) * tick as f32).unwrap();
        cloth.step(1);
    }
    cloth.release(grab).unwrap();
    cloth.step(60);
    let events: Vec<_> = core::iter::from_fn(|| cloth.next_event()).collect();
    let torn = events.iter().filter(|event| event.kind == EventKind::EdgeTorn).count();
    let pieces: Vec<u32> = events
        .iter()
        .filter(|event| event.kind == EventKind::PieceDetached)
        .map(|event| event.count)
        .collect();
    assert!(torn >= 8, "{torn} edges tore");
    // Most tears make a slit longer, so few small pieces come off.
    let small_pieces = pieces.iter().filter(|count| **count < 10).count();
    assert!(
        small_pieces <= 2 && pieces.len() <= 4,
        "{torn} tears left pieces of {pieces:?} triangles"
    );
    // Each tear is near an earlier one: four in five form one path, with gaps of up to two cells.
    let place = |v: u32| cloth.uvs()[v as usize] * 39.0;
    let mut left: Vec<Vec2> = events
        .iter()
        .filter(|event| event.kind == EventKind::EdgeTorn)
        .map(|event| (place(event.particle_a) + place(event.particle_b)) * 0.5)
        .collect();
    let mut longest = 0;
    while let Some(first) = left.pop() {
        let mut path = vec![first];
        let mut at = 0;
        while let Some(here) = path.get(at).copied() {
            let (near, far) = left.into_iter().partition(|other| (*other - here).length() <= 2.0);
            left = far;
            path.extend::<Vec<Vec2>>(near);
            at += 1;
        }
        longest = path.len().max(longest);
    }
    assert!(10 * longest >= 8 * torn, "{longest} of {torn} tears belong to one slit");
}

#[test]
fn a_slit_sheet_does_not_tear_further_under_its_own_weight() {
    let mut desc = bare_grid(40, 40, 0.05, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.settings.damping = 0.5;
    desc.material.tear_stretch = 1.6;
    let mut cloth = Cloth::grid(&desc).unwrap();
    for (from, to, y) in [(-1.0, 1.25, -0.62), (0.72, 3.0, -1.33)] {
        let at = |x: f32| Vec3::new(x, y, -1.0);
        assert!(cloth.cut(at(from), at(to), Vec3::Z * 2.0).unwrap() > 20);
    }
    has_torn(&mut cloth);
    let mut most = 0.0;
    for _ in 0..900 {
        cloth.step(1);
        most = f32::max(most, max_strain(&cloth));
        assert!(!has_torn(&mut cloth), "it tore at tick {}", cloth.stats().ticks);
    }
    assert!(most < 0.5, "it is strained by {most} under its own weight");
}

#[test]
fn tearing_with_tethers_grabs_and_pins_keeps_the_mesh_clean_and_the_strain_limit() {
    let mut desc = bare_grid(24, 24, 0.05, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.settings.max_stretch = 0.4;
    desc.material.tear_stretch = 1.3;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    let held = [
        (10 * 24 + 6, Vec3::new(-0.01, -0.01, 0.03)),
        (12 * 24 + 17, Vec3::new(0.01, -0.02, 0.02)),
    ];
    let grabs = held.map(|(particle, _)| cloth.grab_particle(particle).unwrap());
    let pin = 18 * 24 + 12;
    cloth.pin(pin, None).unwrap();
    for tick in 1..=100 {
        for (grab, (particle, pull)) in grabs.iter().zip(held) {
            let from = before.positions()[particle as usize];
            cloth.move_grab(*grab, from + pull * tick as f32).unwrap();
        }
        let target = before.positions()[pin as usize] + Vec3::NEG_Z * 0.01 * tick as f32;
        cloth.set_pin_targets(&[pin], &[target]).unwrap();
        cloth.step(1);
        let stats = cloth.stats();
        assert!(stats.over_stretched > 0 || stats.max_stretch <= 0.4 + 1.0e-5, "{stats:?}");
        if tick == 50 {
            let (from, to) = (Vec3::new(0.33, 1.0, -9.0), Vec3::new(0.36, -9.0, -9.0));
            assert!(cloth.cut(from, to, Vec3::Z * 18.0).unwrap() > 0);
        }
    }
    assert!(cloth.positions().len() > before.positions().len() + 30, "the cloth tore and was cut");
    assert_cut_invariants(&cloth, &before);
    for grab in grabs {
        cloth.release(grab).unwrap();
    }
    (0..12).for_each(|pin| cloth.unpin(pin).unwrap());
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut cloth, &mut restored] {
        cloth.step(60);
        let stats = cloth.stats();
        assert_eq!(stats.over_stretched, 0);
        assert!(stats.max_stretch <= 0.4 + 1.0e-5, "{stats:?}");
        assert_cut_invariants(cloth, &before);
    }
    assert_eq!(restored.state_hash(), cloth.state_hash());
}
