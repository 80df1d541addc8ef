//! Every example of the folder `examples` runs to its end.

#[path = "../../examples/collide.rs"]
mod collide;
#[path = "../../examples/garment.rs"]
mod garment;
#[path = "../../examples/hang.rs"]
mod hang;
#[path = "../../examples/paint.rs"]
mod paint;
#[path = "../../examples/tear.rs"]
mod tear;

#[test]
fn the_example_hang_runs() {
    hang::main().unwrap();
}

#[test]
fn the_example_tear_runs() {
    tear::main().unwrap();
}

#[test]
fn the_example_collide_runs() {
    collide::main().unwrap();
}

#[test]
fn the_example_garment_runs() {
    garment::main().unwrap();
}

#[test]
fn the_example_paint_runs() {
    paint::main().unwrap();
}
