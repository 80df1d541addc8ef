//! A cotton sheet hangs by its top edge, sways in a gusty wind and comes to rest in still air.
//!
//! Run it with `cargo run --release --example hang`.

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, PinMode, Preset, Wind};

/// Prints one line of statistics.
fn print_state(what: &str, cloth: &Cloth) {
    let stats = cloth.stats();
    println!(
        "{:4.1} s, {what}: fastest particle {:.3} m/s, largest strain {:.3} %",
        cloth.time(),
        stats.max_speed,
        100.0 * stats.max_stretch
    );
}

/// Runs the example.
pub fn main() -> muslin::Result<()> {
    let mut desc = GridDesc {
        columns: 40,
        rows: 40,
        spacing: 0.05,
        pin_mode: PinMode::TopEdge,
        material: Material::preset(Preset::Cotton),
        ..GridDesc::default()
    };
    // No stretch or shear link is longer than 1.02 of its rest length when a tick ends.
    desc.settings.max_stretch = 0.02;
    let mut cloth = Cloth::grid(&desc)?;

    // A frame loop: pass the seconds since the last frame, then draw the view.
    cloth.set_wind(Wind { velocity: Vec3::new(0.0, 0.0, 3.0), gust: 0.5, ..Wind::default() })?;
    for _frame in 0..180 {
        cloth.advance(1.0 / 60.0)?;
        let view = cloth.view();
        assert_eq!(view.positions.len(), view.normals.len());
    }
    print_state("in the wind", &cloth);
    assert!(cloth.stats().max_stretch <= 0.02);

    // Still air and the damping of the settings calm the sheet.
    cloth.set_wind(Wind::default())?;
    cloth.step(20 * 60);
    print_state("in still air", &cloth);
    assert!(cloth.stats().max_speed < 0.05);

    // The hem hangs one sheet height below the pins: (rows - 1) * spacing = 1.95 m.
    let hem = cloth.position(39 * 40 + 20).expect("the grid has 1600 particles");
    println!("the middle of the hem is at y = {:.3} m", hem.y);
    Ok(())
}
