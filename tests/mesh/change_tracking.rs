//! Change tracking for renderers: the changed ranges of the lists, and the frayed borders.

use crate::common::{bare_grid, irregular_mesh, triangles};
use muslin::glam::{Vec2, Vec3};
use muslin::{Changes, Cloth, Error, IndexFormat, PinMode};
use std::collections::HashMap;

/// A renderer that uploads only the ranges that `changes` reports.
#[derive(Default)]
struct Renderer {
    revision: u32,
    indices: Vec<u32>,
    uvs: Vec<Vec2>,
    sources: Vec<u32>,
    frayed: Vec<bool>,
    uploaded: u32,
}

/// Resizes `list` to the length of `from` and copies the given range.
fn copy_range<T: Clone>(list: &mut Vec<T>, first: u32, count: u32, from: &[T], empty: T) {
    list.resize(from.len(), empty);
    let range = first as usize..(first + count) as usize;
    list[range.clone()].clone_from_slice(&from[range]);
}

impl Renderer {
    fn update(&mut self, cloth: &mut Cloth) {
        let Changes { first_vertex, vertex_count, first_index, index_count } =
            cloth.changes(self.revision);
        let view = cloth.view();
        copy_range(&mut self.indices, first_index, index_count, view.indices, 0);
        copy_range(&mut self.uvs, first_vertex, vertex_count, view.uvs, Vec2::NAN);
        copy_range(&mut self.sources, first_vertex, vertex_count, view.source_vertices, 0);
        copy_range(&mut self.frayed, first_vertex, vertex_count, view.frayed, false);
        self.revision = view.topology_revision;
        self.uploaded = vertex_count + index_count;
        assert_eq!(self.indices, view.indices);
        assert_eq!(self.uvs, view.uvs);
        assert_eq!(self.sources, view.source_vertices);
        assert_eq!(self.frayed, view.frayed);
    }
}

#[test]
fn uploading_the_changed_ranges_keeps_a_renderer_up_to_date() {
    let mut desc = bare_grid(12, 12, 0.1, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.3;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let (mut eager, mut lazy, mut late) =
        (Renderer::default(), Renderer::default(), Renderer::default());
    eager.update(&mut cloth);
    assert_eq!(eager.uploaded, 144 + 121 * 6, "the first update uploads everything");
    eager.update(&mut cloth);
    assert_eq!(eager.uploaded, 0);
    let grab = cloth.grab_particle(66).unwrap();
    for tick in 0..150 {
        cloth.move_grab(grab, Vec3::new(0.6, -0.6, 0.03 * tick as f32)).unwrap();
        cloth.step(1);
        if tick % 40 == 20 {
            let y = -0.005 * tick as f32;
            cloth.cut(Vec3::new(-1.0, y, -3.0), Vec3::new(0.5, y, -3.0), Vec3::Z * 9.0).unwrap();
        }
        eager.update(&mut cloth);
        if tick % 30 == 29 {
            lazy.update(&mut cloth);
        }
    }
    assert!(cloth.topology_revision() > 10);
    lazy.update(&mut cloth);
    late.update(&mut cloth);
    cloth.reset();
    for renderer in [&mut eager, &mut lazy, &mut late] {
        renderer.update(&mut cloth);
    }
}

#[test]
fn a_small_tear_causes_a_small_upload() {
    let mut cloth = Cloth::grid(&bare_grid(40, 40, 0.05, PinMode::TopEdge)).unwrap();
    let revision = cloth.topology_revision();
    assert!(cloth.tear_edge(820, 860).unwrap());
    let changes = cloth.changes(revision);
    assert!(changes.index_count > 0 && changes.index_count < 500, "{changes:?}");
    // The range covers the new last vertex and its neighbours, which are frayed now.
    assert_eq!(changes.first_vertex + changes.vertex_count, 1601);
    assert!(changes.first_vertex >= 818, "{changes:?}");
    assert_eq!(cloth.changes(cloth.topology_revision()), Changes::default());
    let all = Changes { first_vertex: 0, vertex_count: 1601, first_index: 0, index_count: 9126 };
    assert_eq!(cloth.changes(0), all);
    assert_eq!(cloth.changes(revision + 9), all, "an unknown revision reports everything");
}

#[test]
fn a_revision_that_is_too_old_reports_everything() {
    let mut cloth = Cloth::grid(&bare_grid(20, 20, 0.05, PinMode::TopEdge)).unwrap();
    let first = cloth.topology_revision();
    let mut tears = 0;
    for vertex in 45..180 {
        if vertex % 20 > 1 && vertex % 20 < 18 {
            tears += u32::from(cloth.tear_edge(vertex, vertex + 20).unwrap_or(false));
        }
    }
    assert!(tears > 70 && cloth.topology_revision() == first + tears);
    assert_eq!(cloth.changes(first).first_index, 0);
    assert_eq!(cloth.changes(first).index_count as usize, cloth.indices().len());
    assert!(cloth.changes(first + tears - 60).first_index > 0);
}

/// Whether each vertex is an end of a border edge, computed from the triangles alone.
fn border_flags(cloth: &Cloth) -> Vec<bool> {
    let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
    for [a, b, c] in triangles(cloth) {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            *edges.entry([p.min(q), p.max(q)]).or_default() += 1;
        }
    }
    let mut at = vec![false; cloth.positions().len()];
    for end in edges.into_iter().filter(|(_, uses)| *uses == 1).flat_map(|(ends, _)| ends) {
        at[end as usize] = true;
    }
    at
}

#[test]
fn borders_from_tears_and_cuts_are_frayed_and_original_borders_are_not() {
    let mut sheet = Cloth::grid(&bare_grid(10, 8, 0.1, PinMode::TopEdge)).unwrap();
    let mut ring = Cloth::mesh(&irregular_mesh()).unwrap();
    for cloth in [&mut sheet, &mut ring] {
        assert!(cloth.frayed().iter().all(|frayed| !frayed));
        let original_borders = border_flags(cloth);
        let uvs = cloth.uvs().to_vec();
        let (from, to) = (Vec3::new(-3.0, -0.31, -5.0), Vec3::new(3.0, -0.36, -5.0));
        assert!(cloth.cut(from, to, Vec3::Z * 9.0).unwrap() > 1);
        let triangle = triangles(cloth)[5];
        let _ = cloth.tear_edge(triangle[0], triangle[1]);
        let borders = border_flags(cloth);
        let mut count = 0;
        for (v, frayed) in cloth.frayed().iter().enumerate() {
            assert!(borders[v] || !frayed, "vertex {v} is frayed inside the cloth");
            let is_original = original_borders.get(v).copied().unwrap_or(false);
            assert!(
                *frayed || !borders[v] || is_original || uvs.len() <= v,
                "vertex {v} is not frayed at a new border"
            );
            count += u32::from(*frayed);
        }
        assert!(count >= 6, "only {count} vertices are frayed");
        let restored = Cloth::restore(&cloth.save()).unwrap();
        assert_eq!(restored.frayed(), cloth.frayed());
        cloth.reset();
        assert!(cloth.frayed().iter().all(|frayed| !frayed));
    }
    // The rest of an original border stays original: its new end is frayed, the next vertex is not.
    let (from, to) = (Vec3::new(0.44, 1.0, -5.0), Vec3::new(0.44, -3.0, -5.0));
    assert!(sheet.cut(from, to, Vec3::Z * 9.0).unwrap() > 8);
    let frayed: Vec<u32> = (0..10).filter(|v| sheet.frayed()[*v as usize]).collect();
    assert_eq!(frayed, [] as [u32; 0], "the pinned row got a new vertex at the cut");
    assert!(sheet.frayed()[80..].iter().all(|frayed| *frayed));
}

#[test]
fn indices_are_written_in_the_requested_width_if_they_fit() {
    let mut cloth = Cloth::grid(&bare_grid(5, 4, 0.1, PinMode::TopEdge)).unwrap();
    cloth.cut(Vec3::new(-1.0, -0.16, -1.0), Vec3::new(0.33, -0.14, -1.0), Vec3::Z * 2.0).unwrap();
    let count = cloth.indices().len();
    let mut narrow = vec![0xee_u8; 2 * count + 3];
    cloth.write_indices(&mut narrow, IndexFormat::U16, true, 1000).unwrap();
    let read = |at: usize| u32::from(u16::from_ne_bytes([narrow[2 * at], narrow[2 * at + 1]]));
    for (at, [a, b, c]) in triangles(&cloth).into_iter().enumerate() {
        let turned = [3 * at, 3 * at + 1, 3 * at + 2].map(read);
        assert_eq!(turned, [a + 1000, c + 1000, b + 1000]);
    }
    assert_eq!(narrow[2 * count..], [0xee; 3]);
    let mut wide = vec![0_u8; 4 * count];
    cloth.write_indices(&mut wide, IndexFormat::U32, false, 0).unwrap();
    let (wide, _) = wide.as_chunks::<4>();
    assert!(wide.iter().map(|b| u32::from_ne_bytes(*b)).eq(cloth.indices().iter().copied()));

    let last = cloth.positions().len() as u32 - 1;
    let mut assert_refused = |size: usize, format, base, field: &str| {
        let before = narrow.clone();
        let error = cloth.write_indices(&mut narrow[..size], format, false, base).unwrap_err();
        assert!(matches!(error, Error::BadValue { field: named, .. } if named == field), "{error}");
        assert_eq!(narrow, before);
    };
    assert_refused(2 * count - 1, IndexFormat::U16, 0, "buffer");
    assert_refused(2 * count, IndexFormat::U32, 0, "buffer");
    assert_refused(2 * count, IndexFormat::U16, 65535 - last, "index_format");
    cloth.write_indices(&mut narrow, IndexFormat::U16, false, 65534 - last).unwrap();
    let mut wide = vec![0_u8; 4 * count];
    assert!(cloth.write_indices(&mut wide, IndexFormat::U32, false, u32::MAX - last).is_err());
}
