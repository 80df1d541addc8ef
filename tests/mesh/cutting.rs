//! Cuts with a blade: they follow the blade, leave no slivers, and keep the mesh clean after any
//! number of cuts.

use crate::common::{assert_cut_invariants, bare_grid, irregular_mesh, total_mass, triangles};
use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, Error, Event, EventKind, Material, MeshDesc, PinMode, Preset};
use proptest::prelude::*;

/// A flat sheet of 9 × 7 cells of 10 cm, its top left corner at the origin.
fn flat_sheet(pin_mode: PinMode) -> Cloth {
    Cloth::grid(&bare_grid(10, 8, 0.1, pin_mode)).unwrap()
}

/// Cuts a sheet in the x–y plane from one point to another. Returns the number of opened edges.
fn slice(cloth: &mut Cloth, from: [f32; 2], to: [f32; 2]) -> muslin::Result<u32> {
    let at = |[x, y]: [f32; 2]| Vec3::new(x, y, -5.0);
    cloth.cut(at(from), at(to), Vec3::Z * 10.0)
}

/// Returns all pending events.
fn drained_events(cloth: &mut Cloth) -> Vec<Event> {
    core::iter::from_fn(|| cloth.next_event()).collect()
}

fn count_of(events: &[Event], kind: EventKind) -> usize {
    events.iter().filter(|event| event.kind == kind).count()
}

/// The smallest angle [°] and the smallest area of all triangles, measured in the texture, which is
/// scaled by `scale`.
fn min_angle_and_area(cloth: &Cloth, scale: Vec2) -> (f32, f32) {
    let uv = |v: u32| cloth.uvs()[v as usize] * scale;
    let mut least = (180.0_f32, f32::INFINITY);
    for [a, b, c] in triangles(cloth) {
        let corners = [uv(a), uv(b), uv(c)];
        for k in 0..3 {
            let (p, q, r) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
            least.0 = least.0.min((q - p).angle_to(r - p).abs().to_degrees());
        }
        least.1 =
            least.1.min(0.5 * (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]).abs());
    }
    least
}

#[test]
fn a_cut_through_the_sheet_makes_two_pieces_along_a_straight_line() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    let before = cloth.clone();
    let (from, to) = (Vec2::new(-0.2, -0.17), Vec2::new(1.2, -0.53));
    let opened = slice(&mut cloth, from.into(), to.into()).unwrap();
    assert!(opened > 9, "{opened} edges opened");
    assert_cut_invariants(&cloth, &before);
    assert_eq!(cloth.stats().pieces, 2);
    let events = drained_events(&mut cloth);
    assert_eq!(count_of(&events, EventKind::EdgeTorn) as u32, opened);
    assert_eq!(count_of(&events, EventKind::PieceDetached), 1);
    let made =
        count_of(&events, EventKind::EdgeDivided) + count_of(&events, EventKind::VertexSplit);
    assert_eq!(made, cloth.positions().len() - before.positions().len());
    // The cut follows the blade, within an eighth of an edge where it snaps to a vertex.
    let along = (to - from).normalize();
    for event in events.iter().filter(|event| event.kind == EventKind::VertexSplit) {
        let off = (event.position.truncate() - from).perp_dot(along).abs();
        assert!(off < 0.125 * 0.1 * 2.0_f32.sqrt() + 1.0e-5, "{off} m beside the blade");
    }
    // The lower piece falls, the upper one hangs.
    cloth.step(60);
    assert_cut_invariants(&cloth, &before);
    let lowest = cloth.positions().iter().map(|x| x.y).fold(0.0, f32::min);
    assert!(lowest < -4.0, "the piece fell only to {lowest} m");
    assert!((0..10).all(|i| cloth.positions()[i].y == 0.0), "the pins hold");
}

#[test]
fn new_vertices_interpolate_position_uv_and_velocity_of_their_edges() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    for i in 0..80 {
        let x = cloth.positions()[i];
        cloth.set_velocity(i as u32, Vec3::new(0.2 * x.y, 0.0, 3.0 * x.x)).unwrap();
    }
    slice(&mut cloth, [-0.2, -0.233], [0.63, -0.371]).unwrap();
    for event in drained_events(&mut cloth) {
        if event.kind != EventKind::EdgeDivided {
            continue;
        }
        let new = event.vertex as usize;
        let x = cloth.positions()[new];
        let on_sheet = Vec2::new(x.x / 0.9, 1.0 + x.y / 0.7);
        assert!((cloth.uvs()[new] - on_sheet).length() < 1.0e-6);
        let velocity = cloth.velocity(event.vertex).unwrap();
        let exact = Vec3::new(0.2 * x.y, 0.0, 3.0 * x.x);
        assert!((velocity - exact).length() < 1.0e-5, "{velocity} at {x}");
        let source = cloth.source_vertices()[new];
        let ends = [event.particle_a, event.particle_b];
        let near = |v: u32| (cloth.positions()[v as usize] - x).length();
        let nearer = if near(ends[1]) < near(ends[0]) { ends[1] } else { ends[0] };
        assert!(near(source) <= near(nearer) + 1.0e-6, "{source} of {ends:?}");
    }
}

#[test]
fn a_cut_that_ends_inside_the_sheet_stops_at_the_last_crossed_edge() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    let before = cloth.clone();
    let opened = slice(&mut cloth, [-0.2, -0.33], [0.43, -0.37]).unwrap();
    assert!(opened >= 4, "{opened}");
    assert_cut_invariants(&cloth, &before);
    assert_eq!(cloth.stats().pieces, 1);
    let split = drained_events(&mut cloth);
    let farthest = split
        .iter()
        .filter(|event| event.kind == EventKind::VertexSplit)
        .map(|event| event.position.x)
        .fold(0.0, f32::max);
    assert!(farthest > 0.3 && farthest < 0.43, "{farthest}");
}

#[test]
fn a_blade_within_one_triangle_or_beside_the_cloth_cuts_nothing() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    let hash = cloth.state_hash();
    let revision = cloth.topology_revision();
    for (from, to) in [([0.62, -0.63], [0.64, -0.66]), ([2.0, 0.0], [2.0, -1.0])] {
        assert_eq!(slice(&mut cloth, from, to), Ok(0));
    }
    // This sweep is too short to reach the cloth.
    let from = Vec3::new(-1.0, -0.33, 1.0);
    assert_eq!(cloth.cut(from, from + Vec3::X * 3.0, Vec3::Z * -0.9), Ok(0));
    assert_eq!((cloth.state_hash(), cloth.topology_revision()), (hash, revision));
    assert!(cloth.cut(from, from + Vec3::X * 3.0, Vec3::Z * -1.1).unwrap() > 0);
}

#[test]
fn repeating_a_cut_changes_nothing() {
    for (from, to) in [([-0.2, -0.33], [0.43, -0.37]), ([-1.0, -0.3], [2.0, -0.3])] {
        let mut cloth = flat_sheet(PinMode::TopEdge);
        assert!(slice(&mut cloth, from, to).unwrap() > 0);
        let hash = cloth.state_hash();
        assert_eq!(slice(&mut cloth, from, to), Ok(0));
        assert_eq!(slice(&mut cloth, to, from), Ok(0), "nor in the opposite direction");
        assert_eq!(cloth.state_hash(), hash);
    }
}

#[test]
fn a_cut_along_vertices_splits_them_and_divides_no_edge() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    let before = cloth.clone();
    assert_eq!(slice(&mut cloth, [-1.0, -0.3], [2.0, -0.3]), Ok(9));
    assert_eq!(cloth.indices().len(), before.indices().len());
    assert_eq!(cloth.positions().len(), before.positions().len() + 10);
    assert_eq!(cloth.stats().pieces, 2);
    crate::common::assert_tear_invariants(&cloth, &before);
}

#[test]
fn a_cut_just_below_the_pinned_row_releases_the_sheet() {
    for y in [-0.001, -0.01, -0.04] {
        let mut cloth = flat_sheet(PinMode::TopEdge);
        let before = cloth.clone();
        assert!(slice(&mut cloth, [-1.0, y], [2.0, y]).unwrap() >= 9);
        assert_eq!(cloth.stats().pieces, 2);
        assert_eq!(cloth.pinned().count(), 10);
        cloth.step(60);
        assert_cut_invariants(&cloth, &before);
        assert!(cloth.positions()[79].y < -4.0);
    }
}

#[test]
fn a_cut_along_a_row_of_pins_leaves_pins_on_both_sides() {
    let mut cloth = flat_sheet(PinMode::None);
    let before = cloth.clone();
    (30..40).for_each(|i| cloth.pin(i, None).unwrap());
    assert_eq!(slice(&mut cloth, [-1.0, -0.3], [2.0, -0.3]), Ok(9));
    assert_eq!(cloth.stats().pieces, 2);
    assert_eq!(cloth.pinned().count(), 20);
    cloth.step(30);
    assert_cut_invariants(&cloth, &before);
    let highest = cloth.positions().iter().map(|x| x.y).fold(-1.0, f32::max);
    assert!(highest > -0.31, "both sides hang from their pins, the highest at {highest}");
    cloth.unpin_all();
    cloth.step(60);
    assert!(cloth.positions().iter().all(|x| x.y < -4.0), "both sides fall without pins");
}

#[test]
fn a_cut_along_a_pinned_border_row_cuts_nothing() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    assert_eq!(slice(&mut cloth, [-1.0, 0.0], [2.0, 0.0]), Ok(0));
}

#[test]
fn a_cut_cloth_comes_to_rest_like_an_uncut_one() {
    let hang = |is_cut: bool| {
        let mut desc = bare_grid(20, 20, 0.05, PinMode::TopCorners);
        desc.settings.damping = 0.5;
        desc.settings.tearing = true;
        desc.material = Material::preset(Preset::Cotton);
        desc.material.tear_stretch = 2.5;
        let mut cloth = Cloth::grid(&desc).unwrap();
        if is_cut {
            for (from, to) in [([0.1, -0.21], [0.83, -0.37]), ([0.52, -0.17], [0.44, -0.81])] {
                assert!(slice(&mut cloth, from, to).unwrap() > 8);
            }
        }
        let count = cloth.positions().len();
        cloth.step(900);
        assert_eq!(cloth.positions().len(), count, "nothing tears by itself");
        cloth.stats()
    };
    let (whole, cut) = (hang(false), hang(true));
    assert!(
        cut.kinetic_energy < 1.0e-4,
        "{} J, uncut {} J",
        cut.kinetic_energy,
        whole.kinetic_energy
    );
    // Short links at the ends of a cut carry the load around it, but stretch by less than this.
    assert!(cut.max_stretch < 0.25, "{}, uncut {}", cut.max_stretch, whole.max_stretch);
}

#[test]
fn a_sheet_stays_stable_after_its_first_row_loses_all_links() {
    let mut cloth = Cloth::grid(&bare_grid(10, 8, 0.1, PinMode::TopEdge)).unwrap();
    for column in 0..9 {
        let x = (column as f32 + 0.5) * 0.1;
        slice(&mut cloth, [x, 0.05], [x, -0.15]).unwrap();
    }
    cloth.step(60);
    assert!(cloth.positions().iter().all(|x| x.is_finite()));
    assert!(cloth.stats().max_stretch < 0.05, "{}", cloth.stats().max_stretch);
}

#[test]
fn a_cut_that_exceeds_the_reserve_changes_nothing() {
    let mut desc = bare_grid(10, 8, 0.1, PinMode::TopEdge);
    desc.extra_particles = 12;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let (hash, revision) = (cloth.state_hash(), cloth.topology_revision());
    let whole = slice(&mut cloth, [-0.2, -0.17], [1.2, -0.53]);
    assert_eq!(whole, Err(Error::Full { what: "the whole cut" }));
    assert_eq!((cloth.state_hash(), cloth.topology_revision()), (hash, revision));
    assert!(cloth.next_event().is_none());
    assert!(slice(&mut cloth, [-0.2, -0.33], [0.23, -0.37]).unwrap() > 0, "a short cut fits");
}

#[test]
fn an_invalid_blade_is_refused_by_argument_name() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    let hash = cloth.state_hash();
    let nan = Vec3::new(0.0, f32::NAN, 0.0);
    let mut assert_refused = |from, to, sweep, name: &str| {
        let error = cloth.cut(from, to, sweep).unwrap_err();
        assert!(
            matches!(error, Error::BadValue { field, .. } if field == name),
            "{error} is not about {name}"
        );
    };
    assert_refused(nan, Vec3::X, Vec3::Z, "from");
    assert_refused(Vec3::ZERO, Vec3::INFINITY, Vec3::Z, "to");
    assert_refused(Vec3::ZERO, Vec3::X, nan, "sweep");
    assert_refused(Vec3::X, Vec3::X, Vec3::Z, "to");
    assert_refused(Vec3::ZERO, Vec3::X, Vec3::ZERO, "sweep");
    assert_refused(Vec3::ZERO, Vec3::X, Vec3::X * -2.0, "sweep");
    assert_eq!(cloth.state_hash(), hash);
}

#[test]
fn view_pointers_stay_valid_through_cuts() {
    let mut cloth = flat_sheet(PinMode::TopEdge);
    let addresses = |cloth: &mut Cloth| {
        let view = cloth.view();
        let lists = (view.positions.as_ptr(), view.normals.as_ptr(), view.uvs.as_ptr());
        (lists, view.indices.as_ptr(), view.source_vertices.as_ptr(), view.index_capacity)
    };
    // The first cut allocates the reserve.
    assert!(slice(&mut cloth, [-0.1, -0.35], [1.0, -0.45]).is_ok());
    let first = addresses(&mut cloth);
    let mut most = 0;
    for k in 0..40 {
        let y = -0.7 * (k as f32 * 0.618).fract();
        let _ = slice(&mut cloth, [-0.1, y], [1.0, y - 0.1]);
        cloth.step(1);
        let view = cloth.view();
        most = view.indices.len() as u32;
        assert!(most <= view.index_capacity);
        assert!(view.positions.len() as u32 <= view.vertex_capacity);
        assert_eq!(addresses(&mut cloth), first);
    }
    assert!(most > 63 * 6, "no edge was divided");
}

#[test]
fn a_restored_cut_cloth_continues_with_the_same_bits() {
    let mut cloth = flat_sheet(PinMode::TopCorners);
    slice(&mut cloth, [0.21, 0.1], [0.47, -0.8]).unwrap();
    cloth.step(10);
    slice(&mut cloth, [-0.2, -0.33], [0.63, -0.37]).unwrap();
    cloth.step(3);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    let mut copy = cloth.clone();
    let links = |cloth: &Cloth| cloth.links().collect::<Vec<_>>();
    assert_eq!(links(&restored), links(&cloth));
    assert_eq!(restored.uvs(), cloth.uvs());
    assert_eq!(restored.source_vertices(), cloth.source_vertices());
    for other in [&mut restored, &mut copy] {
        other.step(20);
        slice(other, [-0.2, -0.5], [1.2, -0.6]).unwrap();
        other.step(20);
    }
    cloth.step(20);
    slice(&mut cloth, [-0.2, -0.5], [1.2, -0.6]).unwrap();
    cloth.step(20);
    assert_eq!(restored.state_hash(), cloth.state_hash());
    assert_eq!(copy.state_hash(), cloth.state_hash());
    cloth.reset();
    assert_eq!(
        cloth.state_hash(),
        flat_sheet(PinMode::TopCorners).state_hash(),
        "a reset removes the cuts"
    );
    assert_eq!(links(&cloth), links(&flat_sheet(PinMode::TopCorners)));
    assert_eq!(cloth.uvs(), flat_sheet(PinMode::TopCorners).uvs());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_cuts_of_a_grid_leave_a_clean_mesh_without_slivers(
        columns in 2u32..9,
        rows in 2u32..9,
        cuts in prop::collection::vec((any::<[u16; 4]>(), 0u32..3), 1..8),
    ) {
        let mut desc = bare_grid(columns, rows, 0.1, PinMode::TopEdge);
        desc.extra_particles = 1000;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let before = cloth.clone();
        let size = Vec2::new((columns - 1) as f32, (rows - 1) as f32) * 0.1;
        for (at, ticks) in cuts {
            let [a, b, c, d] = at.map(|at| f32::from(at) / 65536.0 * 1.4 - 0.2);
            let result = slice(&mut cloth, [a * size.x, -b * size.y], [c * size.x, -d * size.y]);
            prop_assert!(result.is_ok(), "{:?}", result);
            assert_cut_invariants(&cloth, &before);
            let (angle, area) = min_angle_and_area(&cloth, size);
            prop_assert!(angle > 4.99, "an angle of {}°", angle);
            prop_assert!(area > 0.0049 * 0.01, "an area of {}", area);
            cloth.step(ticks);
        }
        assert_cut_invariants(&cloth, &before);
        let restored = Cloth::restore(&cloth.save()).unwrap();
        prop_assert_eq!(restored.state_hash(), cloth.state_hash());
        let links = |cloth: &Cloth| cloth.links().collect::<Vec<_>>();
        prop_assert_eq!(links(&restored), links(&cloth));
    }

    #[test]
    fn random_cuts_and_tears_of_any_mesh_leave_a_clean_mesh(
        steps in prop::collection::vec((any::<[i16; 9]>(), 0usize..10_000, 0u32..3), 1..20),
    ) {
        let desc = MeshDesc { extra_particles: 1000, ..irregular_mesh() };
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let before = cloth.clone();
        for (at, pick, ticks) in steps {
            let [a, b, c, d, e, f, g, h, i] = at.map(|at| f32::from(at) / 16384.0);
            let _ = cloth.cut(Vec3::new(a, b, c), Vec3::new(d, e, f), Vec3::new(g, h, i));
            let corner = pick % cloth.indices().len();
            let triangle = triangles(&cloth)[corner / 3];
            let _ = cloth.tear_edge(triangle[corner % 3], triangle[(corner + 1) % 3]);
            cloth.step(ticks);
        }
        assert_cut_invariants(&cloth, &before);
        let restored = Cloth::restore(&cloth.save()).unwrap();
        prop_assert_eq!(restored.state_hash(), cloth.state_hash());
        let (mass, whole) = (total_mass(&cloth), total_mass(&before));
        prop_assert!((mass - whole).abs() <= 1.0e-6 * whole);
    }
}
