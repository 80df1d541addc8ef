//! The contract of the public interface: refused input, extreme input, pins, anchors, the demo's
//! scenes, the examples; and the shape of sources and documents.

#[path = "../common/mod.rs"]
mod common;

mod anchors;
mod architecture;
mod crowds;
mod examples;
mod extreme_fields;
mod extreme_input;
mod fuzz_regressions;
mod maps;
mod pins;
mod poses;
mod refusals;
mod scenes;
mod scratch_pool;
mod source_shape;
