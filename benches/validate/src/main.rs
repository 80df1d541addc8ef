//! `cargo xtask validate [CASE…]`: reference cases of physics, played at three qualities, three
//! resolutions and two ticks, beside what the governing equations give.
//!
//! ```text
//! cases ─▶ results ─▶ report
//!   ├─▶ references    computed from the equations, without the solver's code
//!   └─▶ strip, player how a cloth is made and played
//! ```
//! The manual has the tables: `docs/manual/validation.md`.

mod cases;
mod held;
#[path = "../../meshes/src/noise.rs"]
mod noise;
mod player;
mod references;
mod report;
mod results;
mod run;
mod strip;
#[allow(dead_code)]
#[path = "../../tables/table.rs"]
mod table;
mod trial;

use std::process::ExitCode;
use std::time::Instant;

const USAGE: &str = "\
cargo xtask validate [CASE…] [OPTION…]: plays the named cases, or all but drape
  --list    only prints the names of the cases
  --manual  leaves out times, which differ between machines: the tables of docs/manual/validation.md
  --write   plays all and replaces the results of docs/manual/validation.md
  --test    plays a few runs and fails where one is off by more than today";

fn main() -> ExitCode {
    let (options, names): (Vec<_>, Vec<_>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with("--"));
    match validate(&options, &names) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn validate(options: &[String], names: &[String]) -> Result<(), String> {
    let known = ["--list", "--manual", "--test"];
    if let Some(unknown) = options.iter().find(|option| !known.contains(&option.as_str())) {
        return Err(format!("unknown option {unknown}\n{USAGE}"));
    }
    let has = |option: &str| options.iter().any(|given| given == option);
    let cases = cases::all();
    if let Some(unknown) = names.iter().find(|name| !cases.iter().any(|case| case.name == **name)) {
        return Err(format!("there is no case {unknown:?}; --list prints the names\n{USAGE}"));
    }
    if has("--list") {
        cases.iter().for_each(|case| println!("{}: {}", case.name, case.about));
        return Ok(());
    }
    if has("--test") {
        return held::check(&cases);
    }
    let is_chosen = |case: &trial::Case| {
        if names.is_empty() { case.is_default } else { names.iter().any(|name| name == case.name) }
    };
    let mut summary = report::Summary::new();
    let mut costs = report::Costs::new(!has("--manual"));
    let mut texts = Vec::new();
    for case in cases.iter().filter(|case| is_chosen(case)) {
        let start = Instant::now();
        let results = results::play(case)?;
        summary.add(case, &results);
        costs.add(case, &results);
        texts.push(report::tables(case, &results));
        eprintln!("{} took {:.0} s", case.name, start.elapsed().as_secs_f64());
    }
    println!("{}\n{}\n{}", summary.text(), texts.join("\n"), costs.text());
    Ok(())
}
