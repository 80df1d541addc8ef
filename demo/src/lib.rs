//! The demo of Muslin, drawn with three-d: cloth to grab, cut and tear, and a receipt to fold,
//! crumple and toss.
//!
//! ```text
//! native (window)   web (page)   shot (PNG file)
//!         ╲             │             ╱
//!       app (six cloth scenes), receipt (one scene)
//!         │                     │
//!       scene, pointer, camera  render
//! ```
//! The upper row knows the platform and passes events and time down. The middle row owns the cloth
//! and its settings. [`controls`] is the table of controls that both the window and the page show.
//!
//! Invariant: a module imports only from its own row or a lower one, and no two files import each
//! other.

pub mod afterglow;
pub mod app;
pub mod blade;
pub mod camera;
pub mod controls;
#[cfg(test)]
mod crossings;
pub mod fabric;
pub mod gesture;
pub mod meter;
pub mod patch_grab;
pub mod picking;
pub mod pointer;
pub mod receipt;
pub mod render;
pub mod scene;
pub mod scene_kind;
pub mod settings;
pub mod smooth_surface;
pub mod surfaces;

#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
#[cfg(not(target_arch = "wasm32"))]
pub mod headless;
#[cfg(not(target_arch = "wasm32"))]
pub mod native;
#[cfg(not(target_arch = "wasm32"))]
pub mod shot;
#[cfg(target_arch = "wasm32")]
pub mod web;
