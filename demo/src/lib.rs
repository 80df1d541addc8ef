//! The demo of Muslin: a sheet that hangs, is grabbed, blows and tears, drawn with three-d.
//!
//! [`app`] is the demo; [`native`] puts it into a window, `web` onto a page, [`headless`] into a
//! picture. [`controls`] is the one table behind both panels.

pub mod app;
pub mod blade;
pub mod camera;
pub mod controls;
pub mod fabric;
pub mod gesture;
pub mod hand;
pub mod meter;
pub mod pointer;
pub mod render;
pub mod settings;
pub mod stage;

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
