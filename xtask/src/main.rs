//! Every chore of this repository as one command, such as `cargo xtask test`.
//!
//! ```text
//! main -> test, check: lanes -> steps -> one file per step -> setup, shell, files, failure
//!      -> demo, js, c, package, bench, …: the same files, as chores of their own
//! ```

mod abi;
mod bench;
mod binutils;
mod bits;
mod browser;
mod c;
mod c_tests;
mod clean_root;
mod clients;
mod csharp;
mod dead_data;
mod dead_formatting;
mod demo;
mod dist;
mod engine_download;
mod engines;
mod examples;
mod failure;
mod files;
mod first_frames;
mod function_order;
mod fuzz;
mod godot;
mod js;
mod js_tests;
mod lanes;
mod miri;
mod no_wasm;
mod npm;
mod pack;
mod package;
mod picture;
mod python;
mod race;
mod readme;
mod rust;
mod serve;
mod setup;
mod share;
mod shell;
mod similar_order;
mod site;
mod sources;
mod steps;
mod symbols;
mod test;
mod tools;
mod traps;
mod validate;
mod verify;
mod wasm;
mod web;

use std::process::ExitCode;

use failure::{Failure, Result};

const USAGE: &str = "\
cargo xtask demo [OPTION…]          build and run the demo; --help lists its options
cargo xtask demo --shot FILE.png    draw a picture of it without a screen
cargo xtask demo --dev-build        build it as the tests do: quicker to build, slower to run
cargo xtask demo --web              build the demo as a page and serve it
  --port N                          on this port (8080, or a free one)
  --no-open                         without opening a browser
cargo xtask manual-pictures         draw the pictures of docs/manual with the demo
cargo xtask share-pictures          draw the pictures of previews of links with the demo
cargo xtask review-pictures [DIR]   draw all scenes of the demo at three sizes, to compare commits
cargo xtask check                   format, lints of the library, unit tests and closed forms
cargo xtask test [STEP…]            all default steps, or the steps that are named
  --all                             all steps, with dist, clean-root, site, engines, godot and
                                    fuzz-long
cargo xtask bits                    simulate golden scenes on every platform, compare the hashes
  --bless                           write golden.txt from this machine instead
cargo xtask web                     build the demo's page into dist/web
  --url ADDRESS/                    for this address, which previews of links need
cargo xtask js                      build the npm package into dist/js
cargo xtask python                  build the wheel of the Python package into dist/python
cargo xtask c                       build the C library, compile and run its tests and examples
cargo xtask package                 pack the C library as users install it, into dist/c
  --js                              pack the npm package into dist instead, and print its sizes
cargo xtask dist [TARGET…]          build, pack and try the C library for all platforms, or for those
                                    that are named, into dist/release
cargo xtask bevy                    build the example in Bevy and draw its picture
cargo xtask godot                   build the extension for Godot into bindings/godot/project
cargo xtask examples                serve the example pages of the npm package
cargo xtask site                    build the site with manual, references and playground into dist/site
  --base /PATH/                     for this folder of a host
  --serve                           serve it; --port N on this port
cargo xtask bench [TABLE…]          time native code and node, or the tables that are named: kernels,
                                    ticks, shreds, layers, scenes, receipt, crowd, node, page, peers
  meshes [PATH…] [OPTION…]          hang the meshes of OBJ and glTF files, or generated ones
  --test                            once and with small meshes, as a test
cargo xtask verify [SCENE…]         check the guarantees of cloth after every tick of many scenes
  --short                           of a few scenes, for a few ticks
  --list                            only print the names of the scenes
cargo xtask validate [CASE…]        play reference cases of physics and print how far off they are
  --list                            only print the names of the cases
  --test                            a few runs, and fail where one is farther off than today
  --write                           all cases, into docs/manual/validation.md
cargo xtask fuzz [SECONDS]          fuzz the C library for an hour or for these seconds
cargo xtask race [SECONDS]          step many cloths on two threads under the thread sanitizer
cargo xtask miri                    run the tests of the C library's boundary under Miri
cargo xtask setup [--list]          install what the tests need, or only print what is missing";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &[String]) -> Result {
    let Some((chore, rest)) = args.split_first() else {
        return Err(Failure::new(USAGE));
    };
    match chore.as_str() {
        "demo" => demo::run(rest),
        "manual-pictures" => alone(chore, rest, demo::draw_manual_pictures),
        "share-pictures" => alone(chore, rest, demo::draw_share_pictures),
        "review-pictures" => demo::draw_review_pictures(rest),
        "test" => test::run(rest),
        "step" => test::run_step(rest),
        "check" => test::check(rest),
        "bits" => bits::run(rest),
        "bench" => bench::run(rest),
        "setup" => test::prepare(rest),
        "web" => web::run(rest),
        "js" => alone(chore, rest, js::build),
        "site" => site::run(rest),
        "race" => race::run(rest),
        "miri" => miri::run(rest),
        "verify" => verify::run(rest),
        "validate" => validate::run(rest),
        "fuzz" => fuzz::run(rest),
        "python" => alone(chore, rest, python::build),
        "c" => alone(chore, rest, c_tests::check),
        "package" if rest == ["--js"] => clients::pack(),
        "package" => alone(chore, rest, package::build),
        "dist" => dist::run(rest),
        "bevy" => alone(chore, rest, engines::bevy),
        "godot" => alone(chore, rest, godot::build),
        "examples" => alone(chore, rest, examples::serve),
        "help" | "--help" | "-h" => {
            println!("{USAGE}");
            Ok(())
        }
        other => Err(Failure::new(format!("there is no chore {other:?}\n{USAGE}"))),
    }
}

/// Runs a chore that takes no options.
fn alone(chore: &str, rest: &[String], run: fn() -> Result) -> Result {
    match rest.first() {
        None => run(),
        Some(option) => Err(Failure::new(format!("`cargo xtask {chore}` takes no {option:?}"))),
    }
}
