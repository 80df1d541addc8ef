//! The JavaScript face of Muslin, its wasm half: numbers, slices and addresses.
//!
//! `package/` holds the other half, written in JavaScript: it checks what it is given, gives names to
//! numbers and hands out views. Every refusal is an `Error` that names the argument as JavaScript spells it.

mod heap;
mod hold;
mod make;
mod numbers;
mod read;
mod refusal;
mod tune;
mod wear;
mod write;

use muslin::Cloth;
use wasm_bindgen::prelude::wasm_bindgen;

/// A cloth, spoken to in numbers.
#[wasm_bindgen]
pub struct RawCloth {
    cloth: Cloth,
    is_timed: bool,
    /// What is written for buffers of the page, before it is copied there.
    room: Vec<u8>,
}

impl RawCloth {
    fn new(cloth: Cloth) -> Self {
        Self { cloth, is_timed: false, room: Vec::new() }
    }
}

/// The version of the library, "major.minor.patch".
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").into()
}
