//! A hand pulls a hanging sheet until it tears; then a blade cuts it in two.
//!
//! Run it with `cargo run --release --example tear`.

use muslin::glam::Vec3;
use muslin::{Cloth, EventKind, GridDesc};

/// Removes the pending events, and returns how many are of each kind that matters here: torn edges,
/// split vertices and detached pieces.
fn count_events(cloth: &mut Cloth) -> (usize, usize, usize) {
    let mut counts = (0, 0, 0);
    while let Some(event) = cloth.next_event() {
        match event.kind {
            EventKind::EdgeTorn => counts.0 += 1,
            EventKind::VertexSplit => counts.1 += 1,
            EventKind::PieceDetached => counts.2 += 1,
            _ => {}
        }
    }
    counts
}

/// Runs the example.
pub fn main() -> muslin::Result<()> {
    let mut desc = GridDesc::default(); // 40 x 40 particles, pinned along the top edge
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.5; // an edge tears at 1.5 times its rest length
    let mut cloth = Cloth::grid(&desc)?;

    // Grab what a ray from the eye hits, and pull it 3.6 m towards the eye in two seconds.
    let (eye, forward) = (Vec3::new(1.0, -1.0, 5.0), Vec3::NEG_Z);
    let (grab, start) = cloth.grab_ray(eye, forward, 0.1)?.expect("the ray hits the sheet");
    for frame in 0..120 {
        cloth.move_grab(grab, start + Vec3::Z * 0.03 * frame as f32)?;
        cloth.advance(1.0 / 60.0)?;
    }
    cloth.release(grab)?;
    let (edges, vertices, pieces) = count_events(&mut cloth);
    println!("pulled: {edges} edges tore, {vertices} vertices split, {pieces} pieces came off");
    assert!(edges > 0);

    // Cut with a blade: the segment from `from` to `to`, swept along `sweep`.
    let seen = cloth.topology_revision();
    let (from, to) = (Vec3::new(-1.0, -0.5, -5.0), Vec3::new(3.0, -0.6, -5.0));
    let opened = cloth.cut(from, to, Vec3::Z * 10.0)?;
    let changes = cloth.changes(seen); // what a renderer uploads again
    println!("cut: {opened} edges opened, upload {} indices again", changes.index_count);
    assert!(opened > 0 && cloth.stats().pieces > 1);

    // No triangle is lost: every vertex still knows the vertex that it came from.
    let view = cloth.view();
    println!("{} vertices, {} triangles", view.positions.len(), view.indices.len() / 3);
    assert_eq!(view.positions.len(), view.source_vertices.len());
    Ok(())
}
