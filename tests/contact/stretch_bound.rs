//! The bound of stretch beside self-collision and wind: each link is within it after every tick, or
//! the statistics and one event report that it is not.
//!
//! The strain is measured over all stretch and shear links, against the distances of the new cloth.

use crate::checks::stretch::{RestShape, Strain};
use crate::shapes::{with_bound, with_surface};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, EventKind, GridDesc, PinMode, Wind};

/// A cloth with a bound of stretch, and its shape at rest.
struct Bounded {
    cloth: Cloth,
    rest: RestShape,
    /// Number of links past the bound after the last tick.
    reported: u32,
}

impl Bounded {
    fn new(desc: &GridDesc) -> Self {
        let cloth = Cloth::grid(desc).unwrap();
        Self { rest: RestShape::of(&cloth), cloth, reported: 0 }
    }

    /// Runs a tick, and checks that links past the bound are counted, that only such links are, and
    /// that an event reports the first tick with some.
    fn step(&mut self, case: &str) -> Strain {
        self.cloth.step(1);
        let strain = self.rest.strain(&self.cloth);
        let percent = 100.0 * strain.greatest;
        assert!(!strain.is_broken || strain.is_told, "{case}: {percent} % without a report");
        let bound = f64::from(self.cloth.settings().max_stretch);
        let is_past = strain.greatest > bound * 0.999;
        assert!(is_past || !strain.is_told, "{case}: {percent} % reported as past the bound");
        let mut events = 0;
        while let Some(event) = self.cloth.next_event() {
            events += u32::from(event.kind == EventKind::HeldApart);
        }
        let before = std::mem::replace(&mut self.reported, self.cloth.stats().over_stretched);
        let due = u32::from(before == 0 && self.reported > 0);
        assert_eq!(events, due, "{case}: {before} links, then {}", self.reported);
        strain
    }
}

/// Moves the attached first row of a strip to and fro by 5 cm a tick, and returns the number of ticks
/// that end past the bound.
fn ticks_past_the_bound(desc: &GridDesc, ticks: u32) -> u32 {
    let mut strip = Bounded::new(&with_bound(desc.clone(), 0.05));
    let row: Vec<u32> = (0..desc.columns).collect();
    let attachment = strip.cloth.attach(&row, Vec3::ZERO, Quat::IDENTITY).unwrap();
    let (mut x, mut past) = (0.0, 0);
    for tick in 0..ticks {
        x += if (tick / 15) % 2 == 0 { 0.05 } else { -0.05 };
        strip.cloth.move_attachment(attachment, Vec3::new(x, 0.0, 0.0), Quat::IDENTITY).unwrap();
        let case = format!("{} x {}, tick {tick}", desc.columns, desc.rows);
        strip.step(&case);
        past += u32::from(strip.reported > 0);
    }
    past
}

fn strip(columns: u32, rows: u32) -> GridDesc {
    GridDesc { columns, rows, spacing: 0.025, pin_mode: PinMode::None, ..GridDesc::default() }
}

#[test]
fn a_shaken_strip_with_surface_collision_reports_every_stretch_past_its_bound() {
    ticks_past_the_bound(&with_surface(strip(2, 8)), 300);
    ticks_past_the_bound(&with_surface(strip(5, 40)), 90);
}

#[test]
fn a_shaken_strip_without_self_collision_keeps_its_bound() {
    assert_eq!(ticks_past_the_bound(&strip(2, 8), 300), 0);
    assert_eq!(ticks_past_the_bound(&strip(5, 40), 300), 0);
}

#[test]
fn a_sheet_in_wind_keeps_its_bound_with_and_without_surface_collision() {
    let plain = with_bound(GridDesc { columns: 20, rows: 20, ..GridDesc::default() }, 0.02);
    for (case, desc) in [("plain", plain.clone()), ("surface", with_surface(plain))] {
        let mut sheet = Bounded::new(&desc);
        let wind = Wind { velocity: Vec3::new(0.0, 0.0, 8.0), ..Wind::default() };
        sheet.cloth.set_wind(wind).unwrap();
        for tick in 0..180 {
            let strain = sheet.step(&format!("{case}, tick {tick}"));
            assert_eq!(sheet.reported, 0, "{case}, tick {tick}: {}", strain.greatest);
        }
    }
}
