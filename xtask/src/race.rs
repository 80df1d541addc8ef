//! Runs the C library on several threads under the thread sanitizer.

use crate::failure::{During, Failure, Result};
use crate::{c, files, fuzz, setup, shell};

/// How long cloths are stepped by default [s], and how many cloths each of two threads has.
const SECONDS: u32 = 60;
const CLOTHS: &str = "1000";

/// Runs the tests with threads; the one with many cloths runs for a minute, or for the seconds that
/// are given.
pub fn run(options: &[String]) -> Result {
    let seconds = match options {
        [] => SECONDS,
        [number] => number.parse().during(|| "cargo xtask race takes seconds".into())?,
        _ => return Err(Failure::new("`cargo xtask race` takes seconds and nothing else")),
    };
    setup::ensure(&[&setup::CXX])?;
    setup::ensure_std_source()?;
    // The standard library is instrumented too: its locks are what orders memory accesses of
    // threads.
    let library = fuzz::library("thread", &[], &["-Zbuild-std"])?;
    for (name, options) in
        [("threads", vec![]), ("crowd", vec![CLOTHS.into(), seconds.to_string()])]
    {
        let source = files::root().join("tests/c").join(name).with_extension("c");
        let program = files::target().join("thread").join(name);
        let mut cc = c::strict_compiler(&source);
        cc.arg("-o").arg(&program).arg(&source).arg(&library).args(fuzz::runtime("tsan")?);
        shell::run(cc.args(["-lm", "-lpthread", "-ldl", "-lstdc++"]))?;
        let mut run = shell::command(&program);
        shell::run(run.args(options).env("TSAN_OPTIONS", "halt_on_error=1"))?;
    }
    Ok(())
}
