//! A tablecloth falls on a moving ball and a floor, collides with itself, and pushes the ball.
//!
//! Run it with `cargo run --release --example collide`.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, SelfCollision, Shape};

/// Radius of the ball [m].
const RADIUS: f32 = 0.3;

/// Runs the example.
pub fn main() -> muslin::Result<()> {
    // A horizontal sheet of 1.2 m x 1.2 m, half a metre above the ball.
    let mut desc = GridDesc {
        columns: 25,
        rows: 25,
        spacing: 0.05,
        origin: Vec3::new(-0.6, 1.1, -0.6),
        down: Vec3::Z,
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc)?;

    // The default collider is a floor at height 0.
    cloth.add_collider(&ColliderDesc::default())?;
    let mut center = Vec3::Y * RADIUS;
    let ball = cloth.add_collider(&ColliderDesc {
        shape: Shape::Sphere,
        radius: RADIUS,
        position: center,
        friction: 0.6,
        ..ColliderDesc::default()
    })?;

    let tick = cloth.settings().tick;
    for frame in 0..240 {
        // From two seconds on, the ball moves at 0.3 m/s. Its motion is swept within the tick.
        if frame >= 120 {
            center.x += 0.3 * tick;
            cloth.move_collider(ball, center, Quat::IDENTITY)?;
        }
        cloth.advance(tick)?;
        if frame % 60 == 59 {
            // Impulse of the cloth on the ball in the last tick; divided by the tick it is a force.
            let force = cloth.collider_impulse(ball)?.linear / tick;
            println!("{:.0} s: the cloth pushes the ball with {force:.2} N", cloth.time());
        }
    }

    // No particle is inside the ball or below the floor.
    let nearest = |x: &Vec3| (x.distance(center) - RADIUS).min(x.y);
    let clearance = cloth.positions().iter().map(nearest).fold(f32::INFINITY, f32::min);
    println!("smallest distance from ball and floor: {:.2} mm", 1000.0 * clearance);
    assert!(clearance > -1.0e-4);
    Ok(())
}
