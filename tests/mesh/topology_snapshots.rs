//! Snapshots of the topology: constraints of new cloths, and changes by scripted tears and cuts.

use crate::common::{bare_grid, irregular_mesh, triangles};
use muslin::glam::Vec3;
use muslin::{Cloth, EventKind, LinkKind, PinMode};
use std::fmt::Write;

/// The text of a snapshot of a new cloth: links by kind, colours, the links of the first and the
/// last particle, and triangles.
fn constraint_summary(cloth: &Cloth) -> String {
    let mut text = String::new();
    let links: Vec<(u32, u32, LinkKind)> = cloth.links().collect();
    for kind in [LinkKind::Stretch, LinkKind::Shear, LinkKind::Bend] {
        let count = links.iter().filter(|link| link.2 == kind).count();
        writeln!(text, "{kind:?} links: {count}").unwrap();
    }
    let mut first = 0;
    for (color, (kind, count)) in cloth.colors().enumerate() {
        let pairs: Vec<String> = links[first..first + count]
            .iter()
            .take(4)
            .map(|(a, b, _)| format!("{a}-{b}"))
            .collect();
        writeln!(text, "color {color}: {count} {kind:?}, {} ...", pairs.join(" ")).unwrap();
        first += count;
    }
    let last = cloth.positions().len() as u32 - 1;
    for particle in [0, last] {
        let others: Vec<String> = links
            .iter()
            .filter(|(a, b, _)| *a == particle || *b == particle)
            .map(|(a, b, kind)| format!("{}({kind:?})", if *a == particle { b } else { a }))
            .collect();
        writeln!(text, "particle {particle}: {}", others.join(" ")).unwrap();
    }
    let all = triangles(cloth);
    let (head, tail) = (&all[..4], &all[all.len() - 4..]);
    writeln!(text, "{} triangles: {head:?} ... {tail:?}", all.len()).unwrap();
    text
}

/// The text of a snapshot of tears and cuts: triangles with new vertices, the sources of these
/// vertices, pieces, borders and events.
fn change_summary(cloth: &mut Cloth, before: &Cloth) -> String {
    let mut text = String::new();
    let (whole, now) = (triangles(before), triangles(cloth));
    for (at, (now, then)) in now.iter().zip(&whole).enumerate() {
        if now != then {
            writeln!(text, "triangle {at}: {then:?} -> {now:?}").unwrap();
        }
    }
    for (at, triangle) in now.iter().enumerate().skip(whole.len()) {
        writeln!(text, "triangle {at}: new, {triangle:?}").unwrap();
    }
    for (vertex, source) in
        cloth.source_vertices().iter().enumerate().skip(before.positions().len())
    {
        let uv = cloth.uvs()[vertex];
        let moved = uv != cloth.uvs()[*source as usize];
        let at = if moved {
            format!(" at {:.3} {:.3} of the texture", uv.x, uv.y)
        } else {
            String::new()
        };
        writeln!(text, "vertex {vertex} <- {source}{at}").unwrap();
    }
    let frayed: Vec<String> =
        (0..cloth.frayed().len()).filter(|v| cloth.frayed()[*v]).map(|v| v.to_string()).collect();
    writeln!(text, "frayed: {}", frayed.join(" ")).unwrap();
    let (now, then) = (cloth.stats(), before.stats());
    let (links, whole) = (now.active_constraints, then.active_constraints);
    writeln!(text, "links: {whole} -> {links}, pieces: {} -> {}", then.pieces, now.pieces).unwrap();
    while let Some(event) = cloth.next_event() {
        let what = match event.kind {
            EventKind::EdgeTorn => format!("edge {}-{} torn", event.particle_a, event.particle_b),
            EventKind::VertexSplit => format!("vertex {} split off {}", event.vertex, event.source),
            EventKind::PieceDetached => {
                format!("piece of {} triangles at vertex {} detached", event.count, event.vertex)
            }
            EventKind::EdgeDivided => {
                let (a, b) = (event.particle_a, event.particle_b);
                format!("edge {a}-{b} divided at vertex {}", event.vertex)
            }
            other => format!("{other:?}"),
        };
        writeln!(text, "tick {}: {what}", event.tick).unwrap();
    }
    text
}

#[test]
fn a_new_grid_has_these_constraints() {
    let cloth = Cloth::grid(&bare_grid(5, 4, 0.1, PinMode::TopEdge)).unwrap();
    insta::assert_snapshot!(constraint_summary(&cloth));
}

#[test]
fn a_new_default_grid_has_these_constraints() {
    let cloth = Cloth::grid(&bare_grid(40, 40, 0.05, PinMode::TopEdge)).unwrap();
    insta::assert_snapshot!(constraint_summary(&cloth));
}

#[test]
fn a_new_mesh_has_these_constraints() {
    let cloth = Cloth::mesh(&irregular_mesh()).unwrap();
    insta::assert_snapshot!(constraint_summary(&cloth));
}

#[test]
fn no_particle_appears_twice_in_a_color() {
    for cloth in [
        Cloth::grid(&bare_grid(7, 6, 0.1, PinMode::TopEdge)).unwrap(),
        Cloth::mesh(&irregular_mesh()).unwrap(),
    ] {
        let links: Vec<(u32, u32, LinkKind)> = cloth.links().collect();
        let mut first = 0;
        for (color, (kind, count)) in cloth.colors().enumerate() {
            let of_color = &links[first..first + count];
            assert!(of_color.iter().all(|link| link.2 == kind));
            let mut ends: Vec<u32> = of_color.iter().flat_map(|(a, b, _)| [*a, *b]).collect();
            ends.sort_unstable();
            ends.dedup();
            assert_eq!(ends.len(), 2 * count, "color {color}");
            first += count;
        }
        assert_eq!(first, links.len());
        let mut pairs: Vec<[u32; 2]> =
            links.iter().map(|(a, b, _)| [*a.min(b), *a.max(b)]).collect();
        pairs.sort_unstable();
        pairs.dedup();
        assert_eq!(pairs.len(), links.len(), "each pair is linked once");
    }
}

#[test]
fn a_tear_in_the_middle_opens_a_slit() {
    let mut cloth = Cloth::grid(&bare_grid(4, 4, 0.1, PinMode::TopEdge)).unwrap();
    let before = cloth.clone();
    assert!(cloth.tear_edge(5, 9).unwrap());
    insta::assert_snapshot!(change_summary(&mut cloth, &before));
}

#[test]
fn tears_across_the_sheet_divide_it_into_two_pieces() {
    let mut cloth = Cloth::grid(&bare_grid(4, 4, 0.1, PinMode::TopEdge)).unwrap();
    let before = cloth.clone();
    for column in 0..4 {
        // The tear of the previous column may have replaced the upper vertex.
        let below = 8 + column;
        let above = triangles(&cloth)
            .into_iter()
            .filter(|triangle| triangle.contains(&below))
            .flatten()
            .find(|v| cloth.source_vertices()[*v as usize] == 4 + column);
        if let Some(above) = above {
            cloth.tear_edge(above, below).unwrap();
        }
    }
    insta::assert_snapshot!(change_summary(&mut cloth, &before));
}

#[test]
fn a_scripted_yank_tears_these_edges() {
    let mut desc = bare_grid(6, 6, 0.1, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.5;
    desc.material.tear_variation = 0.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let before = cloth.clone();
    let grab = cloth.grab_particle(21).unwrap();
    for tick in 1..=12 {
        let pull = Vec3::new(0.3, -0.3 - 0.03125 * tick as f32, 0.0);
        cloth.move_grab(grab, pull).unwrap();
        cloth.step(1);
    }
    insta::assert_snapshot!(change_summary(&mut cloth, &before));
}

/// Cuts along a line in the x–y plane, through the whole cloth. Returns the number of opened edges.
fn slice(cloth: &mut Cloth, [x, y]: [f32; 2], [to_x, to_y]: [f32; 2]) -> u32 {
    cloth.cut(Vec3::new(x, y, -2.0), Vec3::new(to_x, to_y, -2.0), Vec3::Z * 4.0).unwrap()
}

#[test]
fn a_cut_from_the_border_into_the_sheet_divides_these_triangles() {
    let mut cloth = Cloth::grid(&bare_grid(4, 4, 0.1, PinMode::TopEdge)).unwrap();
    let before = cloth.clone();
    assert_eq!(slice(&mut cloth, [-0.1, -0.13], [0.17, -0.17]), 3);
    insta::assert_snapshot!(change_summary(&mut cloth, &before));
}

#[test]
fn an_oblique_cut_through_the_sheet_divides_these_triangles() {
    let mut cloth = Cloth::grid(&bare_grid(6, 6, 0.1, PinMode::TopEdge)).unwrap();
    let before = cloth.clone();
    assert_eq!(slice(&mut cloth, [-0.1, -0.3], [0.6, -0.15]), 8);
    insta::assert_snapshot!(change_summary(&mut cloth, &before));
}

#[test]
fn a_cut_of_a_ring_divides_these_triangles() {
    let mut cloth = Cloth::mesh(&irregular_mesh()).unwrap();
    let before = cloth.clone();
    assert_eq!(slice(&mut cloth, [0.05, 0.3], [0.55, 1.5]), 4);
    insta::assert_snapshot!(change_summary(&mut cloth, &before));
}
