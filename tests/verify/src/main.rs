//! Plays scenes in which several guarantees are at stake, and checks after every tick that all
//! hold: no crossing, nothing in a collider, the bound of stretch, finite numbers, momentum.
//!
//! ```text
//! main ─▶ run ─▶ scenes   what happens
//!           ├──▶ checks   what must hold, computed without the solver's code
//!           └──▶ table    what was measured
//! ```
//! `cargo xtask verify` runs it. The manual explains the table: `docs/manual/guarantees.md`.

mod checks;
mod play;
mod run;
mod scenes;
mod shapes;
mod table;

use std::process::ExitCode;

fn main() -> ExitCode {
    let (options, names): (Vec<_>, Vec<_>) =
        std::env::args().skip(1).partition(|arg| arg.starts_with("--"));
    match verify(&options, &names) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the scenes that are named, or all, and prints the table. Returns whether all passed.
fn verify(options: &[String], names: &[String]) -> Result<bool, String> {
    let is_short = match options {
        [] => false,
        [option] if option == "--short" => true,
        [option] if option == "--list" => {
            scenes::all().iter().for_each(|scene| println!("{}", scene.name));
            return Ok(true);
        }
        _ => return Err("the options are --short and --list".into()),
    };
    let scenes = if names.is_empty() { Ok(scenes::all()) } else { scenes::named(names) };
    let scenes =
        scenes.map_err(|name| format!("there is no scene {name:?}; --list prints the names"))?;
    let mut reports = Vec::new();
    println!("{}", table::HEADER);
    for scene in &scenes {
        let ticks = if is_short { scene.short_ticks } else { Some(scene.ticks) };
        if let Some(ticks) = ticks {
            let report = run::run(scene, ticks)?;
            println!("{}", table::row(&report));
            reports.push(report);
        }
    }
    println!("{}", table::totals(&reports));
    Ok(reports.iter().all(|report| report.failures().is_empty()))
}
