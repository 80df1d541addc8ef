//! A cape on a character that runs and turns: attached along the shoulders, kept near its animated
//! pose by maximum distances, and kept off the back by backstops.
//!
//! Run it with `cargo run --release --example garment`.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, GridDesc, PinMode};

const COLUMNS: u32 = 20;
const ROWS: u32 = 30;

/// Runs the example.
pub fn main() -> muslin::Result<()> {
    // In the frame of the body the cape hangs behind the back, in the plane z = -0.15 m.
    let mut cloth = Cloth::grid(&GridDesc {
        columns: COLUMNS,
        rows: ROWS,
        spacing: 0.03,
        origin: Vec3::new(-0.285, 1.5, -0.15),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    })?;
    let rest = cloth.positions().to_vec(); // the animated pose, in the frame of the body
    let all: Vec<u32> = (0..COLUMNS * ROWS).collect();

    // The bone carries the first row. The rest may leave its anchor by 0 m (top) to 0.3 m (hem).
    let shoulders: Vec<u32> = (0..COLUMNS).collect();
    let bone = cloth.attach(&shoulders, Vec3::ZERO, Quat::IDENTITY)?;
    let limit = |i: &u32| 0.3 * (i / COLUMNS) as f32 / (ROWS - 1) as f32;
    let limits: Vec<f32> = all.iter().map(limit).collect();
    cloth.set_max_distances(&all, &limits)?;
    // Backstops: spheres of radius 0.5 m whose surface is 0.02 m behind each anchor.
    cloth.set_backstops(&all, &vec![0.02; all.len()], &vec![0.5; all.len()])?;
    cloth.set_frame(Vec3::ZERO, Quat::IDENTITY)?;

    let mut farthest = 0.0_f32;
    for frame in 1..=300 {
        // The body runs at 8 m/s and turns once in three seconds.
        let time = frame as f32 / 60.0;
        let position = Vec3::Z * 8.0 * time;
        let rotation = Quat::from_rotation_y(time * core::f32::consts::TAU / 3.0);
        // The cloth feels a third of that motion. Call this before poses and anchors.
        cloth.move_frame(position, rotation, 1.0 / 3.0)?;
        cloth.move_attachment(bone, position, rotation)?;
        let anchors: Vec<Vec3> = rest.iter().map(|x| position + rotation * *x).collect();
        let normals = vec![rotation * Vec3::NEG_Z; all.len()]; // away from the body
        cloth.set_anchors(&all, &anchors, &normals)?;
        cloth.step(1);
        let distances = cloth.positions().iter().zip(&anchors).map(|(x, a)| x.distance(*a));
        let excess = distances.zip(&limits).map(|(distance, limit)| distance - limit);
        farthest = farthest.max(excess.fold(0.0, f32::max));
    }
    println!("after {:.0} s no particle was past its limit by more than {farthest:.1e} m", 5.0);
    assert!(farthest < 1.0e-3);

    // A cut scene: the character jumps 100 m away, and the cape does not notice.
    cloth.teleport(Vec3::X * 100.0, Quat::IDENTITY)?;
    println!("after the jump the fastest particle moves at {:.2} m/s", cloth.stats().max_speed);
    Ok(())
}
