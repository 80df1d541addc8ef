//! Every scene of the demo shows what it promises, from its first second on.

use muslin_scenes::{Flag, HangingSheet, Receipt, Scene, SheetOnBall, play};

fn keeps_its_promise<S: Scene>() {
    for seconds in [1, 5, 20] {
        let cloth = play::<S>(60 * seconds);
        if let Err(what) = S::check(&cloth) {
            panic!("{}, after {seconds} s: {what}", S::NAME);
        }
    }
}

#[test]
fn the_hanging_sheet_hangs() {
    keeps_its_promise::<HangingSheet>();
}

#[test]
fn the_flag_streams_and_waves() {
    keeps_its_promise::<Flag>();
}

#[test]
fn the_sheet_lies_on_its_ball() {
    keeps_its_promise::<SheetOnBall>();
}

#[test]
fn the_receipt_hangs_from_its_pins() {
    keeps_its_promise::<Receipt>();
}
