//! The WebAssembly half of the npm package `muslin`: a `wasm-bindgen` class over [`muslin::Cloth`].
//!
//! Only numbers, flat lists and addresses cross this boundary. The JavaScript half in `package/`
//! checks the types of arguments, converts objects to flat lists and back, and makes typed-array
//! views of the module's memory:
//!
//! ```text
//! caller ── objects ──▶ package/*.js ── flat lists ──▶ RawCloth ──▶ muslin::Cloth
//!        ◀── views ───               ◀── addresses ──
//! ```
//!
//! Reads the core's slices and reports; writes only through the core's own methods.
//! Invariant: the core checks every value again, so a wrong number gives a JavaScript `Error`
//! (see `error`) and leaves the cloth unchanged, even if the JavaScript half lets it pass.

mod allocator;
mod anchors;
mod attachments;
mod colliders;
mod create;
mod error;
mod frame;
#[cfg_attr(not(feature = "full"), path = "light.rs")]
mod full;
mod grabs;
mod packing;
mod particles;
mod pins;
mod read;
mod settings;
#[cfg_attr(not(feature = "full"), path = "no_skins.rs")]
mod skins;
mod tear;
mod time;
mod write;

use muslin::Cloth;
use wasm_bindgen::prelude::wasm_bindgen;

/// A cloth whose methods take and return numbers and flat lists.
#[wasm_bindgen]
pub struct RawCloth {
    cloth: Cloth,
    is_timed: bool,
    /// Staging memory for `writeVertices` and `writeIndices`: the core writes here, and
    /// `package/write.js` copies from here to the caller's buffers.
    staging: Vec<u8>,
}

impl RawCloth {
    fn new(cloth: Cloth) -> Self {
        Self { cloth, is_timed: false, staging: Vec::new() }
    }
}

/// Returns the version of the library, "major.minor.patch".
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").into()
}
