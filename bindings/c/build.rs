//! Sets the soname of the shared library: `libmuslin.so.` and the major version, which changes when
//! programs must be compiled again.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let family = env::var("CARGO_CFG_TARGET_FAMILY").unwrap_or_default();
    let vendor = env::var("CARGO_CFG_TARGET_VENDOR").unwrap_or_default();
    if family.split(',').any(|name| name == "unix") && vendor != "apple" {
        let major = env::var("CARGO_PKG_VERSION_MAJOR").unwrap_or_default();
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libmuslin.so.{major}");
    }
}
