//! Prints the instruction set in use and the table of hashes; with `--every-tick` the hash after
//! every tick, with `--scene NAME` the row of one scene.

use std::process::ExitCode;

fn main() -> ExitCode {
    let options: Vec<_> = std::env::args().skip(1).collect();
    let words: Vec<_> = options.iter().map(String::as_str).collect();
    let report = match words[..] {
        [] => Some(muslin_golden::report(false)),
        ["--every-tick"] => Some(muslin_golden::report(true)),
        ["--scene", name] => muslin_golden::report_of(name),
        _ => None,
    };
    match report {
        Some(report) => {
            print!("{report}");
            ExitCode::SUCCESS
        }
        None => {
            eprintln!("the options are --every-tick, or --scene and the name of a scene");
            ExitCode::FAILURE
        }
    }
}
