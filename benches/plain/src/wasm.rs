//! The sheet as a wasm module of its own: every instance holds one, and speaks in numbers.

use crate::{Order, PlainSheet, Size};
use std::cell::RefCell;

thread_local! {
    static SHEET: RefCell<Option<PlainSheet>> = const { RefCell::new(None) };
}

fn with<T>(work: impl FnOnce(&mut PlainSheet) -> T) -> T {
    SHEET.with_borrow_mut(|sheet| work(sheet.as_mut().expect("hang the sheet first")))
}

/// Makes the sheet of this instance.
#[unsafe(no_mangle)]
pub extern "C" fn hang(columns: u32, rows: u32, spacing: f32, by_corners: bool, by_kind: bool) {
    let size = Size { columns: columns as usize, rows: rows as usize, spacing, by_corners };
    let order = if by_kind { Order::ByKind } else { Order::ByParticle };
    SHEET.set(Some(PlainSheet::hang(size, order)));
}

/// How many links it has.
#[unsafe(no_mangle)]
pub extern "C" fn link_count() -> u32 {
    with(|sheet| sheet.link_count() as u32)
}

/// See [`PlainSheet::predict`].
#[unsafe(no_mangle)]
pub extern "C" fn predict(h: f32) {
    with(|sheet| sheet.predict(h));
}

/// See [`PlainSheet::sweep`].
#[unsafe(no_mangle)]
pub extern "C" fn sweep() {
    with(PlainSheet::sweep);
}

/// See [`PlainSheet::tick`].
#[unsafe(no_mangle)]
pub extern "C" fn tick(tick: f32, substeps: u32, iterations: u32) {
    with(|sheet| sheet.tick(tick, substeps, iterations));
}

/// See [`PlainSheet::max_stretch`].
#[unsafe(no_mangle)]
pub extern "C" fn max_stretch() -> f32 {
    with(|sheet| sheet.max_stretch())
}
