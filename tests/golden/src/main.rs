//! Prints the instruction set in use and the table of hashes; with `--every-tick` the hash after
//! every tick.

use std::process::ExitCode;

fn main() -> ExitCode {
    let options: Vec<_> = std::env::args().skip(1).collect();
    let every_tick = match options.as_slice() {
        [] => false,
        [option] if option == "--every-tick" => true,
        _ => {
            eprintln!("the only option is --every-tick");
            return ExitCode::FAILURE;
        }
    };
    print!("{}", muslin_golden::report(every_tick));
    ExitCode::SUCCESS
}
