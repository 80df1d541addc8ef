//! The table: a row per scene, then totals.

use crate::run::{Report, Worst};
use std::time::Duration;

pub const HEADER: &str = "\
scene                          ticks particles crossings@tick  inside mm@tick  triangles mm   pairs \
 strain %/bound  told untold  not-finite  mm/s tick      sum/impulses    rad/s  ms mean  worst  verdict";

/// One line for a scene.
pub fn row(report: &Report) -> String {
    let at = |text: String, worst: &Worst| format!("{text}@{}", worst.tick);
    let crossings = match report.crossings.value {
        0.0 => "0".into(),
        count if report.is_surface => at(format!("{count}"), &report.crossings),
        count => format!("({count})"),
    };
    let depth = match report.depth.value {
        value if value == f64::NEG_INFINITY => "-".into(),
        value if value <= 0.0 => "0".into(),
        value => at(millimetres(value), &report.depth),
    };
    let triangles = match report.triangle_depth.value {
        value if value == f64::NEG_INFINITY => "-".into(),
        value => millimetres(value.max(0.0)),
    };
    let strain = percent(report.strain.value);
    let strain = match report.bound {
        0.0 => strain,
        bound => format!("{strain}/{}", percent(f64::from(bound))),
    };
    let [momentum, drift, spin] = match &report.budget {
        Some(budget) => [
            millimetres(budget.velocity.value),
            format!("{}/{:.0}", millimetres(budget.drift()), budget.pushes * 1.0e3),
            format!("{:.4}", budget.spin.value),
        ],
        None => ["-".into(), "-".into(), "-".into()],
    };
    let failures = report.failures();
    let verdict =
        if failures.is_empty() { "ok".into() } else { format!("FAILS: {}", failures.join("; ")) };
    format!(
        "{:30} {:5} {:9} {crossings:>14} {depth:>15} {triangles:>13} {:>7} {strain:>16} {:5} {:6} \
         {:>11} {momentum:>10} {drift:>20} {spin:>8} {:>8} {:>6}  {verdict}",
        report.name,
        report.ticks,
        report.particles,
        report.mesh_pairs.value,
        report.told,
        report.untold,
        report.not_finite,
        milliseconds(report.mean),
        milliseconds(report.worst),
    )
}

/// The last lines: sums over all scenes.
pub fn totals(reports: &[Report]) -> String {
    let count = |of: fn(&Report) -> u32| reports.iter().map(|r| u64::from(of(r))).sum::<u64>();
    let failed = reports.iter().filter(|report| !report.failures().is_empty()).count();
    format!(
        "\n{} scenes, {} ticks, {failed} scenes fail\n\
         ticks with crossings {}, with a particle in a collider {}, past the bound told {} and \
         untold {}, not finite {}",
        reports.len(),
        count(|r| r.ticks),
        count(|r| if r.is_surface { r.crossing_ticks } else { 0 }),
        count(|r| r.penetration_ticks),
        count(|r| r.told),
        count(|r| r.untold),
        count(|r| r.not_finite),
    )
}

/// Metres as millimetres.
fn millimetres(metres: f64) -> String {
    format!("{:.3}", metres * 1.0e3)
}

fn percent(share: f64) -> String {
    format!("{:.2}", share * 100.0)
}

fn milliseconds(time: Duration) -> String {
    format!("{:.2}", time.as_secs_f64() * 1.0e3)
}
