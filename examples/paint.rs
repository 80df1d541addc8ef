//! A cape whose vertex colours say where it is pinned, how far it may leave the body, and how stiff it
//! is: what artists paint into the `COLOR_0` of a glTF mesh.
//!
//! Run it with `cargo run --release --example paint`.

use muslin::glam::Vec3;
use muslin::{Cloth, Map, Material, MeshDesc, Preset};

const COLUMNS: usize = 16;
const ROWS: usize = 24;

/// The channels of a colour.
const RED: usize = 0;
const GREEN: usize = 1;
const BLUE: usize = 2;
const ALPHA: usize = 3;

/// One channel of the colours of a mesh, as a number from 0 to 1 for each particle of the cloth that
/// was made from it. `colors` has `components` numbers per vertex (3 or 4), each from 0 to `one`: 1 for
/// floats, 255 or 65535 for normalised integers.
///
/// The particle of several vertices takes the colour of the last one.
fn channel<T: Copy + Into<f32>>(
    cloth: &Cloth,
    colors: &[T],
    components: usize,
    channel: usize,
    one: f32,
) -> Vec<f32> {
    let mut values = vec![0.0; cloth.particle_count() as usize];
    for (particle, source) in cloth.vertex_particles().iter().zip(cloth.source_vertices()) {
        let color: f32 = colors[components * *source as usize + channel].into();
        values[*particle as usize] = color / one;
    }
    values
}

/// A cape of triangles and its colours, as a loader returns them: red where it is pinned, green how
/// far it may leave the body, blue how stiff it is, alpha how far it stays off the back.
fn load_cape() -> (Vec<Vec3>, Vec<u32>, Vec<u8>) {
    let (mut positions, mut indices, mut colors) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..COLUMNS * ROWS {
        let (row, column) = (i / COLUMNS, i % COLUMNS);
        positions.push(Vec3::new(column as f32 * 0.03, 1.5 - row as f32 * 0.03, -0.15));
        let is_shoulder = row == 0;
        let is_hem = row > ROWS - 4;
        let reach = 255 * row / (ROWS - 1);
        colors.extend([
            255 * u8::from(is_shoulder),
            reach as u8,
            if is_hem { 255 } else { 0 },
            128,
        ]);
    }
    for row in 0..ROWS - 1 {
        for column in 0..COLUMNS - 1 {
            let a = (row * COLUMNS + column) as u32;
            let c = a + COLUMNS as u32;
            indices.extend([a, c, c + 1, a, c + 1, a + 1]);
        }
    }
    (positions, indices, colors)
}

/// Runs the example.
pub fn main() -> muslin::Result<()> {
    let (positions, indices, colors) = load_cape();
    let mut cloth = Cloth::mesh(&MeshDesc {
        positions,
        indices,
        material: Material::preset(Preset::Cotton),
        ..MeshDesc::default()
    })?;
    let painted = |cloth: &Cloth, which| channel(cloth, &colors, 4, which, 255.0);

    // Red: pinned from one half on.
    for (particle, red) in (0..).zip(painted(&cloth, RED)) {
        if red >= 0.5 {
            cloth.pin(particle, None)?;
        }
    }
    // Green: 0 to 0.4 m. Alpha: backstops of radius 0.5 m, 0 to 0.04 m behind the anchors.
    let all: Vec<u32> = (0..cloth.particle_count()).collect();
    let limits: Vec<f32> = painted(&cloth, GREEN).iter().map(|green| 0.4 * green).collect();
    let behind: Vec<f32> = painted(&cloth, ALPHA).iter().map(|alpha| 0.04 * alpha).collect();
    cloth.set_max_distances(&all, &limits)?;
    cloth.set_backstops(&all, &behind, &vec![0.5; all.len()])?;
    let anchors = cloth.positions().to_vec();
    cloth.set_anchors(&all, &anchors, &vec![Vec3::NEG_Z; all.len()])?;
    // Blue: 1 to 20 times the bending rigidity of the material.
    let stiff: Vec<f32> = painted(&cloth, BLUE).iter().map(|blue| 1.0 + 19.0 * blue).collect();
    cloth.set_map(Map::Bend, Some(&stiff))?;

    cloth.step(240);
    let left = cloth.positions().iter().zip(&anchors).map(|(x, anchor)| x.distance(*anchor));
    let excess = left.zip(&limits).map(|(left, limit)| left - limit).fold(0.0, f32::max);
    println!(
        "{} pins; no particle is past its limit by more than {excess:.1e} m",
        cloth.pinned().count()
    );
    assert!(cloth.pinned().count() == COLUMNS && excess < 1.0e-3);
    Ok(())
}
