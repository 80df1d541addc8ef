//! The contract of the public interface: refused input, extreme input, pins, anchors, the demo's
//! scenes.

#[path = "../common/mod.rs"]
mod common;

mod anchors;
mod extreme_input;
mod fuzz_regressions;
mod pins;
mod refusals;
mod scenes;
mod source_shape;
