//! Tests of tearing: the mesh stays a clean triangle mesh after any tears in any order.

use crate::common::{
    assert_cut_invariants, assert_tear_invariants, bare_grid, irregular_mesh, total_mass, triangles,
};
use muslin::glam::Vec3;
use muslin::{AS_MANY_AGAIN, Cloth, Error, Event, EventKind, MeshDesc, PinMode};
use proptest::prelude::*;

/// A mesh of uneven quads with holes and mixed diagonals; a third of its triangles have the
/// opposite winding.
fn random_mesh(columns: u32, rows: u32, seed: u32) -> MeshDesc {
    let mut random = seed | 1;
    let mut next = move |below: u32| {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        random % below
    };
    let mut desc = MeshDesc::default();
    for at in 0..columns * rows {
        let [x, y] = [at % columns, at / columns].map(|at| at as f32 + next(100) as f32 / 300.0);
        desc.positions.push(Vec3::new(x, -y, next(100) as f32 / 300.0) * 0.1);
    }
    for (row, column) in (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |c| (row, c))) {
        // Two holes never meet in a point.
        let is_hole = row % 2 == 1 && column % 2 == 1 && next(2) == 0;
        let a = row * columns + column;
        let (b, c, d) = (a + 1, a + columns, a + columns + 1);
        let halves = if next(2) == 0 { [[a, c, b], [b, c, d]] } else { [[a, c, d], [a, d, b]] };
        for [p, q, r] in halves.into_iter().filter(|_| !is_hole) {
            desc.indices.extend(if next(3) == 0 { [q, p, r] } else { [p, q, r] });
        }
    }
    desc.uvs = desc.positions.iter().map(|x| x.truncate()).collect();
    desc.extra_particles = 1000;
    desc
}

/// Returns all pending events.
fn drained_events(cloth: &mut Cloth) -> Vec<Event> {
    core::iter::from_fn(|| cloth.next_event()).collect()
}

/// Tears edge number `pick` of the current mesh, counted over the corners of its triangles.
fn tear_numbered_edge(cloth: &mut Cloth, pick: usize) -> muslin::Result<bool> {
    let corner = pick % cloth.indices().len();
    let triangle = triangles(cloth)[corner / 3];
    cloth.tear_edge(triangle[corner % 3], triangle[(corner + 1) % 3])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_tears_of_a_grid_leave_a_clean_mesh(
        columns in 2u32..7,
        rows in 2u32..7,
        picks in prop::collection::vec(0usize..10_000, 1..60),
    ) {
        let mut desc = bare_grid(columns, rows, 0.1, PinMode::TopEdge);
        desc.extra_particles = 300;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let before = cloth.clone();
        for pick in picks {
            tear_numbered_edge(&mut cloth, pick).unwrap();
            cloth.step(1);
        }
        assert_tear_invariants(&cloth, &before);
        let restored = Cloth::restore(&cloth.save()).unwrap();
        prop_assert_eq!(restored.state_hash(), cloth.state_hash());
        let links = |cloth: &Cloth| cloth.links().collect::<Vec<_>>();
        prop_assert_eq!(links(&restored), links(&cloth));
    }

    #[test]
    fn random_tears_of_any_mesh_leave_a_clean_mesh(
        picks in prop::collection::vec(0usize..10_000, 1..60),
    ) {
        let mut desc = irregular_mesh();
        desc.extra_particles = 300;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let before = cloth.clone();
        for pick in picks {
            tear_numbered_edge(&mut cloth, pick).unwrap();
        }
        cloth.step(5);
        assert_tear_invariants(&cloth, &before);
    }

    #[test]
    fn random_tears_and_cuts_of_random_meshes_leave_clean_meshes(
        (columns, rows, seed) in (2u32..8, 2u32..8, any::<u32>()),
        steps in prop::collection::vec((any::<[u8; 4]>(), 0usize..10_000, 0u32..3), 1..40),
    ) {
        let mut cloth = Cloth::mesh(&random_mesh(columns, rows, seed)).unwrap();
        let before = cloth.clone();
        for (at, pick, ticks) in steps {
            // One cut for every seven tears.
            if pick % 8 == 0 {
                let [a, b, c, d] = at.map(|at| f32::from(at) / 320.0);
                let (from, to) = (Vec3::new(a, -b, -9.0), Vec3::new(c, -d, -9.0));
                let is_blade = from != to;
                prop_assert_eq!(cloth.cut(from, to, Vec3::Z * 18.0).is_ok(), is_blade);
            } else {
                tear_numbered_edge(&mut cloth, pick).unwrap();
            }
            cloth.step(ticks);
        }
        assert_cut_invariants(&cloth, &before);
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        restored.step(3);
        cloth.step(3);
        prop_assert_eq!(restored.state_hash(), cloth.state_hash());
    }
}

#[test]
fn a_strip_tears_only_when_pulled_beyond_its_tear_limit() {
    for (pull, tears) in [(0.98, false), (1.03, true)] {
        let mut desc = bare_grid(3, 12, 0.1, PinMode::TopEdge);
        desc.settings.tearing = true;
        desc.settings.tethers = false;
        desc.settings.gravity = Vec3::ZERO;
        desc.material.tear_stretch = 1.5;
        desc.material.tear_variation = 0.0;
        desc.settings.iterations = 10;
        // Elastic, and so soft in shear that the grips do not matter.
        desc.material.stretch_stiffness_warp = 100.0;
        desc.material.stretch_stiffness_weft = 100.0;
        desc.material.shear_stiffness = 0.01;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let bottom = [33, 34, 35];
        let length = 11.0 * 0.1;
        let ends: Vec<Vec3> = bottom.iter().map(|i| cloth.positions()[*i as usize]).collect();
        // Pull slowly, so that the strain is the same along the whole strip.
        for tick in 1..=600 {
            let longer = 0.5 * pull * length * (tick as f32 / 600.0);
            let targets: Vec<Vec3> = ends.iter().map(|x| *x - Vec3::Y * longer).collect();
            cloth.set_pin_targets(&bottom, &targets).unwrap();
            cloth.step(1);
        }
        cloth.step(300);
        let torn = drained_events(&mut cloth).iter().any(|event| event.kind == EventKind::EdgeTorn);
        assert_eq!(torn, tears, "pulled to {pull} of the limit");
    }
}

#[test]
fn a_yank_tears_the_sheet_and_keeps_the_mesh_valid() {
    let mut desc = bare_grid(20, 20, 0.1, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.5;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    let grab = cloth.grab_particle(10 * 20 + 10).unwrap();
    for tick in 0..120 {
        cloth.move_grab(grab, Vec3::new(0.5, -1.0, 0.05 * tick as f32)).unwrap();
        cloth.step(1);
    }
    cloth.release(grab).unwrap();
    cloth.step(60);
    assert!(cloth.positions().len() > before.positions().len() + 10);
    assert_tear_invariants(&cloth, &before);
    assert!((0..20).all(|i| (cloth.positions()[i].y).abs() < 1.0e-4), "pins do not tear off");
}

#[test]
fn tearing_stops_when_the_reserve_is_used_up_and_sends_one_event() {
    let mut desc = bare_grid(12, 12, 0.1, PinMode::TopEdge);
    desc.extra_particles = 10;
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    let grab = cloth.grab_particle(6 * 12 + 6).unwrap();
    for tick in 0..300 {
        cloth.move_grab(grab, Vec3::new(0.6, -0.6, 0.05 * tick as f32)).unwrap();
        cloth.step(1);
    }
    let events = drained_events(&mut cloth);
    let used_up = events.iter().filter(|event| event.kind == EventKind::ReserveUsedUp);
    let positions: Vec<Vec3> = used_up.map(|event| event.position).collect();
    assert_eq!(positions.len(), 1);
    assert!(
        (positions[0] - Vec3::new(0.6, -0.6, 0.0)).truncate().length() < 0.5,
        "{}",
        positions[0]
    );
    let count = cloth.positions().len();
    assert!(count <= 154 && count > 150, "{count} particles");
    assert!(matches!(tear_numbered_edge(&mut cloth, 0), Err(Error::Full { .. })));
    assert_tear_invariants(&cloth, &before);
}

#[test]
fn a_cloth_can_be_torn_into_single_triangles() {
    let mut desc = bare_grid(5, 5, 0.1, PinMode::None);
    desc.extra_particles = 200;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    for round in 0..40 {
        for corner in 0..cloth.indices().len() {
            tear_numbered_edge(&mut cloth, corner + round).unwrap();
        }
    }
    assert_tear_invariants(&cloth, &before);
    assert_eq!(cloth.stats().pieces, 32, "two triangles in each of sixteen cells");
    assert_eq!(cloth.positions().len(), 3 * 32);
    let detached = drained_events(&mut cloth);
    let detached = detached.iter().filter(|event| event.kind == EventKind::PieceDetached).count();
    assert_eq!(detached, 31);
    cloth.step(30);
    let (now, then) = (total_mass(&cloth), total_mass(&before));
    assert!((now - then).abs() < 1.0e-6 * then, "{now} kg, was {then} kg");
}

#[test]
fn nothing_tears_while_tearing_is_off() {
    let mut desc = bare_grid(8, 8, 0.1, PinMode::TopEdge);
    desc.extra_particles = AS_MANY_AGAIN;
    desc.material.tear_stretch = 1.1;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let grab = cloth.grab_particle(36).unwrap();
    cloth.move_grab(grab, Vec3::new(3.0, 0.0, 5.0)).unwrap();
    cloth.step(200);
    assert!(cloth.stats().max_stretch > 0.5);
    assert_eq!(cloth.positions().len(), 64);
}

#[test]
fn removing_all_pins_during_a_tear_releases_the_whole_cloth() {
    let mut desc = bare_grid(16, 12, 0.1, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.3;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    let grab = cloth.grab_particle(6 * 16 + 8).unwrap();
    for tick in 1..=90 {
        cloth.move_grab(grab, Vec3::new(0.8, -0.6, 0.03 * tick as f32)).unwrap();
        cloth.step(1);
        if tick == 40 {
            let row: Vec<u32> = cloth.pinned().collect();
            row.into_iter().filter(|pin| pin % 2 == 0).for_each(|pin| cloth.unpin(pin).unwrap());
        }
        if tick == 60 {
            cloth.unpin_all();
        }
    }
    assert!(cloth.positions().len() > before.positions().len(), "the cloth tore");
    assert_tear_invariants(&cloth, &before);
    cloth.release(grab).unwrap();
    cloth.step(120);
    assert_eq!(cloth.pinned().count(), 0);
    assert!(cloth.positions().iter().all(|x| x.y < -5.0), "the whole cloth falls");
    assert_tear_invariants(&cloth, &before);
}

#[test]
fn a_tear_next_to_a_pin_splits_the_free_vertex_and_keeps_the_pin() {
    let mut cloth = Cloth::grid(&bare_grid(6, 6, 0.1, PinMode::TopEdge)).unwrap();
    let before = cloth.clone();
    assert!(cloth.tear_edge(2, 8).unwrap(), "the free vertex splits");
    let split: Vec<Event> = drained_events(&mut cloth)
        .into_iter()
        .filter(|event| event.kind == EventKind::VertexSplit)
        .collect();
    assert_eq!(split[0].source, 8);
    assert_eq!(cloth.pinned().collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5]);
    assert!(!cloth.tear_edge(2, 3).unwrap(), "an edge between two pins does not tear");
    cloth.step(60);
    assert!((0..6).all(|pin| cloth.positions()[pin].y == 0.0));
    assert_tear_invariants(&cloth, &before);
}

#[test]
fn a_sheet_torn_off_below_its_pins_falls_and_the_pins_stay() {
    let mut desc = bare_grid(8, 8, 0.1, PinMode::TopEdge);
    desc.extra_particles = 200;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    // Tear edges between the second and the third row until a piece comes off.
    for _ in 0..60 {
        let sources = cloth.source_vertices().to_vec();
        let row = |v: u32| sources[v as usize] / 8;
        let joining_edge = triangles(&cloth).into_iter().find_map(|triangle| {
            let ends = |a: usize, b: usize| [triangle[a], triangle[b]];
            [ends(0, 1), ends(1, 2), ends(2, 0)].into_iter().find(|[a, b]| {
                let both = [row(*a).min(row(*b)), row(*a).max(row(*b))];
                both == [1, 2] && cloth.clone().tear_edge(*a, *b).unwrap()
            })
        });
        let Some([a, b]) = joining_edge else { break };
        assert!(cloth.tear_edge(a, b).unwrap());
        if cloth.stats().pieces > 1 {
            break;
        }
    }
    assert!(cloth.stats().pieces > 1, "a piece is torn off");
    let off: u32 = drained_events(&mut cloth)
        .iter()
        .filter(|event| event.kind == EventKind::PieceDetached)
        .map(|event| event.count)
        .sum();
    assert!(off > 0);
    cloth.step(60);
    assert_tear_invariants(&cloth, &before);
    assert!((0..8).all(|pin| cloth.positions()[pin].y == 0.0));
}
