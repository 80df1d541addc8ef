//! wasm exports: each instance of the module holds one sheet, and its functions take and return
//! numbers.

use crate::{Order, PlainSheet, Size};
use std::cell::RefCell;

thread_local! {
    static SHEET: RefCell<Option<PlainSheet>> = const { RefCell::new(None) };
}

/// Runs `work` on the sheet. Panics before `hang`.
fn with_sheet<T>(work: impl FnOnce(&mut PlainSheet) -> T) -> T {
    SHEET.with_borrow_mut(|sheet| work(sheet.as_mut().expect("`hang` was not called")))
}

/// Creates the sheet of this instance.
#[unsafe(no_mangle)]
pub extern "C" fn hang(columns: u32, rows: u32, spacing: f32, only_corners: bool, by_kind: bool) {
    let size = Size { columns: columns as usize, rows: rows as usize, spacing, only_corners };
    let order = if by_kind { Order::ByKind } else { Order::ByParticle };
    SHEET.set(Some(PlainSheet::hang(size, order)));
}

/// See [`PlainSheet::link_count`].
#[unsafe(no_mangle)]
pub extern "C" fn link_count() -> u32 {
    with_sheet(|sheet| sheet.link_count() as u32)
}

/// See [`PlainSheet::predict`].
#[unsafe(no_mangle)]
pub extern "C" fn predict(h: f32) {
    with_sheet(|sheet| sheet.predict(h));
}

/// See [`PlainSheet::sweep`].
#[unsafe(no_mangle)]
pub extern "C" fn sweep() {
    with_sheet(PlainSheet::sweep);
}

/// See [`PlainSheet::tick`].
#[unsafe(no_mangle)]
pub extern "C" fn tick(tick: f32, substeps: u32, iterations: u32) {
    with_sheet(|sheet| sheet.tick(tick, substeps, iterations));
}

/// See [`PlainSheet::max_stretch`].
#[unsafe(no_mangle)]
pub extern "C" fn max_stretch() -> f32 {
    with_sheet(|sheet| sheet.max_stretch())
}
