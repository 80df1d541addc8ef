//! Skins on torn and cut cloth: triangles split or go with one side, and none is stretched.

use crate::common::bare_grid;
use crate::common::skins::{
    assert_skin_invariants, icosphere, longest_edge_ratio, sheet, skin_of, updated,
};
use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, EventKind, GridDesc, MeshDesc, PinMode, SkinDesc};

/// Links of these cloths are at most 5 % longer than at rest.
const MAX_STRETCH: f32 = 0.05;

/// A sheet of 1.9 m x 1.9 m that tears, with a strain limit.
fn tearing_sheet() -> GridDesc {
    let mut desc = bare_grid(20, 20, 0.1, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.settings.max_stretch = MAX_STRETCH;
    desc.settings.damping = 0.5;
    desc
}

/// A skin with 4.1 edges per edge of the cloth, so that most of its triangles lie across edges.
fn fine_sheet() -> SkinDesc {
    sheet(79, 79, Vec3::ZERO, Vec2::new(1.9, -1.9))
}

/// The longest link of a cloth, relative to its rest length.
fn longest_link_ratio(cloth: &Cloth, rest: &Cloth) -> f32 {
    let mut most = 0.0_f32;
    for t in cloth.indices().chunks_exact(3) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (t[a] as usize, t[b] as usize)) {
            let sources = cloth.source_vertices();
            let [p, q] = [a, b].map(|v| rest.positions()[sources[v] as usize]);
            let length = (cloth.positions()[b] - cloth.positions()[a]).length();
            if p != q {
                most = most.max(length / (q - p).length());
            }
        }
    }
    most
}

#[test]
fn a_torn_sheet_has_no_stretched_triangles_in_its_skin() {
    let rest = Cloth::grid(&tearing_sheet()).unwrap();
    // The corners of a skin that is coarser than the cloth are at most one edge of the cloth beyond
    // its tears.
    let coarse = sheet(9, 9, Vec3::ZERO, Vec2::new(1.9, -1.9));
    for (desc, most_off) in [(fine_sheet(), 1.0e-5), (coarse, 0.1)] {
        let mut cloth = rest.clone();
        let mut skin = updated(&cloth, &desc);
        // A tear from the lower edge to the middle, then on in another direction.
        for row in (8..19).rev() {
            let particle = row * 20 + 9;
            cloth.tear_edge(particle, particle + 1).unwrap();
        }
        for column in 4..9 {
            let particle = 8 * 20 + column;
            cloth.tear_edge(particle, particle + 20).unwrap();
        }
        let mut torn = 0;
        while let Some(event) = cloth.next_event() {
            torn += u32::from(event.kind == EventKind::EdgeTorn);
        }
        assert!(torn > 10, "{torn} edges tore");
        skin.update(&cloth).unwrap();
        assert_skin_invariants(&skin, &desc);
        // At the moment of the tear nothing moves.
        let sources = skin.source_vertices();
        let off = (0..sources.len())
            .map(|v| (skin.positions()[v] - desc.positions[sources[v] as usize]).length());
        let off = off.fold(0.0, f32::max);
        println!("{} copies, at most {off} m off", sources.len() - desc.positions.len());
        assert!(sources.len() > desc.positions.len());
        assert!(off < most_off, "a vertex moved by {off} m");
        assert!(skin.frayed().contains(&true));
        let mut wind = cloth.wind().clone();
        (wind.velocity, wind.turbulence) = (Vec3::new(1.0, 0.0, 9.0), 0.5);
        cloth.set_wind(wind).unwrap();
        let mut most = 0.0_f32;
        for _ in 0..180 {
            cloth.step(1);
            skin.update(&cloth).unwrap();
            most = most.max(longest_edge_ratio(&skin, &desc));
        }
        assert_skin_invariants(&skin, &desc);
        let links = longest_link_ratio(&cloth, &rest);
        println!("skin edges up to {most}, links up to {links} times as long");
        assert!(links < 1.3, "links hold");
        assert!(most < 2.0, "an edge is {most} times as long");
    }
}

#[test]
fn a_sheet_torn_by_a_grab_has_no_stretched_triangles_in_its_skin() {
    let mut grid = tearing_sheet();
    grid.settings.max_stretch = 0.0;
    grid.material.tear_stretch = 1.15;
    let rest = Cloth::grid(&grid).unwrap();
    let (mut cloth, desc) = (rest.clone(), fine_sheet());
    let mut skin = updated(&cloth, &desc);
    let grab = cloth.grab_particle(250).unwrap();
    let from = cloth.positions()[250];
    let (mut most, mut links) = (0.0_f32, 0.0_f32);
    for tick in 1..=240 {
        let far = tick.min(150) as f32;
        cloth.move_grab(grab, from + Vec3::new(0.004, -0.002, 0.02) * far).unwrap();
        cloth.step(1);
        skin.update(&cloth).unwrap();
        assert_skin_invariants(&skin, &desc);
        let (edges, stretch) =
            (longest_edge_ratio(&skin, &desc), longest_link_ratio(&cloth, &rest));
        // Until the links tear, they and the skin are stretched.
        if stretch < 1.3 {
            (most, links) = (most.max(edges), links.max(stretch));
        }
    }
    let copies = skin.positions().len() - desc.positions.len();
    println!("{copies} copies; skin edges up to {most}, links up to {links} times as long");
    assert!(copies > 20 && links > 1.1);
    assert!(most < 2.0, "an edge is {most} times as long");
}

#[test]
fn a_cut_divides_the_skin_along_the_blade() {
    let rest = Cloth::grid(&tearing_sheet()).unwrap();
    let (mut cloth, desc) = (rest.clone(), fine_sheet());
    let mut skin = updated(&cloth, &desc);
    // Across the sheet, so that the lower part falls.
    let (from, to) = (Vec3::new(-0.1, -0.83, -1.0), Vec3::new(2.0, -1.04, -1.0));
    assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 20);
    skin.update(&cloth).unwrap();
    assert_skin_invariants(&skin, &desc);
    for (v, source) in skin.source_vertices().iter().enumerate() {
        let off = (skin.positions()[v] - desc.positions[*source as usize]).length();
        assert!(off < 1.0e-5, "vertex {v} moved by {off} m");
    }
    cloth.step(60);
    skin.update(&cloth).unwrap();
    assert_skin_invariants(&skin, &desc);
    let ratio = longest_edge_ratio(&skin, &desc);
    assert!(ratio < 2.0, "an edge is {ratio} times as long");
    // Triangles above the blade stay, those below fall, whichever piece of cloth carries them.
    let line = |x: Vec3| -0.83 - 0.1 * (x.x + 0.1);
    for corners in skin.indices().chunks_exact(3) {
        let center =
            |x: &dyn Fn(u32) -> Vec3| (x(corners[0]) + x(corners[1]) + x(corners[2])) / 3.0;
        let now = center(&|v| skin.positions()[v as usize]);
        let given = center(&|v| desc.positions[skin.source_vertices()[v as usize] as usize]);
        // The cut deviates from the blade by an eighth of an edge at most.
        if (given.y - line(given)).abs() > 0.03 {
            let falls = given.y < line(given);
            assert_eq!(now.y < given.y - 0.5, falls, "{given} is at {now}");
        }
    }
}

#[test]
fn a_second_cut_and_a_tear_after_a_cut_are_followed() {
    let rest = Cloth::grid(&tearing_sheet()).unwrap();
    let (mut cloth, desc) = (rest.clone(), fine_sheet());
    let mut skin = updated(&cloth, &desc);
    for (from, to) in [([0.33, 0.1], [0.71, -1.2]), ([0.1, -0.52], [1.3, -0.61])] {
        let [from, to] = [from, to].map(|[x, y]| Vec3::new(x, y, -1.0));
        assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 5);
        cloth.step(5);
        skin.update(&cloth).unwrap();
    }
    for row in (12..19).rev() {
        cloth.tear_edge(row * 20 + 14, row * 20 + 15).unwrap();
    }
    let mut most = 0.0_f32;
    for _ in 0..90 {
        cloth.step(1);
        skin.update(&cloth).unwrap();
        most = most.max(longest_edge_ratio(&skin, &desc));
    }
    assert_skin_invariants(&skin, &desc);
    assert!(most < 2.0, "an edge is {most} times as long");
    // A skin of the cut sheet in its present pose, in place of that pose's own.
    let given = SkinDesc {
        positions: skin.positions().to_vec(),
        indices: skin.indices().to_vec(),
        ..SkinDesc::default()
    };
    let again = updated(&cloth, &given);
    for (now, given) in again.positions().iter().zip(skin.positions()) {
        assert!((*now - *given).length() < 1.0e-5);
    }
}

#[test]
fn a_reset_restores_the_given_mesh() {
    let mut cloth = Cloth::grid(&tearing_sheet()).unwrap();
    let desc = fine_sheet();
    let mut skin = updated(&cloth, &desc);
    let positions = skin.positions().to_vec();
    cloth.cut(Vec3::new(0.33, 0.1, -1.0), Vec3::new(0.7, -1.2, -1.0), Vec3::Z * 2.0).unwrap();
    cloth.tear_edge(250, 251).unwrap();
    cloth.step(20);
    skin.update(&cloth).unwrap();
    assert_ne!(skin.indices(), desc.indices);
    let revision = skin.topology_revision();
    cloth.reset();
    skin.update(&cloth).unwrap();
    assert_ne!(skin.topology_revision(), revision);
    assert_eq!(skin.indices(), desc.indices);
    assert_eq!(skin.positions(), positions);
    // A skin that was made while the cloth was cut stays complete too.
    cloth.cut(Vec3::new(0.33, 0.1, -1.0), Vec3::new(0.7, -1.2, -1.0), Vec3::Z * 2.0).unwrap();
    let mut late = updated(&cloth, &desc);
    cloth.reset();
    late.update(&cloth).unwrap();
    assert_skin_invariants(&late, &desc);
    for (now, given) in late.positions().iter().zip(&desc.positions) {
        assert!((*now - *given).length() < 1.0e-5);
    }
}

#[test]
fn a_cut_sphere_has_no_stretched_triangles_in_its_skin() {
    let mut mesh: MeshDesc = icosphere(2);
    mesh.settings.max_stretch = MAX_STRETCH;
    mesh.pinned =
        (0..mesh.positions.len() as u32).filter(|v| mesh.positions[*v as usize].y > 0.8).collect();
    let mut cloth = Cloth::mesh(&mesh).unwrap();
    let desc = skin_of(&icosphere(4));
    let mut skin = updated(&cloth, &desc);
    let (from, to) = (Vec3::new(-2.0, -0.1, -2.0), Vec3::new(2.0, 0.1, -2.0));
    assert!(cloth.cut(from, to, Vec3::Z * 4.0).unwrap() > 20);
    skin.update(&cloth).unwrap();
    assert_skin_invariants(&skin, &desc);
    assert!(skin.positions().len() > desc.positions.len());
    let mut most = 0.0_f32;
    for _ in 0..60 {
        cloth.step(1);
        skin.update(&cloth).unwrap();
        most = most.max(longest_edge_ratio(&skin, &desc));
    }
    assert_skin_invariants(&skin, &desc);
    println!("edges up to {most} times as long");
    assert!(most < 2.0, "an edge is {most} times as long");
}
