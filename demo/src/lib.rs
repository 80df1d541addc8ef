//! The demo of Muslin, drawn with three-d: a sheet that hangs, is grabbed, blows and tears, and a receipt
//! to fold, crumple and toss.
//!
//! [`app`] is the sheet and [`tender`] the receipt; [`native`] puts them into a window, `web` onto pages,
//! [`headless`] into pictures. [`controls`] is the one table behind both panels.

pub mod afterglow;
pub mod app;
pub mod blade;
pub mod camera;
pub mod controls;
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
