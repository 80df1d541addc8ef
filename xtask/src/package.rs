//! Packs the C library as users install it: a folder with headers, libraries, files for pkg-config
//! and CMake, licences and checksums.

use std::path::{Path, PathBuf};

use crate::binutils::Binutils;
use crate::failure::{During, Failure, Result};
use crate::pack::{self, Package, VERSION, shared_name};
use crate::setup::{self, Need};
use crate::{c, dist, files, shell, symbols};

/// What packing and testing the package needs.
pub const NEEDS: &[&Need] = &[&setup::CXX, &setup::CMAKE, &setup::PKG_CONFIG];

/// The largest size of the shared library, stripped [bytes].
const MAX_SHARED: u64 = 2_089_000;
/// The largest size of the example `hang.c` with the static library, stripped [bytes].
const MAX_STATIC: u64 = 1_636_000;

/// The least number of 8-lane multiplications in the shared library. The compiler makes many of
/// them from plain loops; options that reduce size can stop that without notice.
const MIN_WIDE_PRODUCTS: usize = 1_900;

/// The folder that the package is built in.
pub fn dir() -> PathBuf {
    files::root().join("dist/c")
}

fn lib() -> PathBuf {
    dir().join("lib")
}

fn package() -> Package {
    let arch = std::env::consts::ARCH;
    let libc = if cfg!(target_env = "musl") { "musl" } else { "gnu" };
    Package {
        dir: dir(),
        target: format!("{arch}-unknown-linux-{libc}"),
        system_libraries: dist::GLIBC_LIBRARIES,
        has_shared: true,
    }
}

/// Builds the library and packs it.
pub fn build() -> Result {
    if !cfg!(target_os = "linux") {
        return Err(Failure::new("the C package is made on Linux only"));
    }
    setup::ensure(NEEDS)?;
    c::build()?;
    let (package, tools) = (package(), Binutils::host());
    package.create()?;
    package.add_shared(&c::release_dir().join("libmuslin.so"), &tools.strip)?;
    let work = files::target().join("package");
    files::create_empty_dir(&work)?;
    let whole = c::release_dir().join("libmuslin.a");
    tools.prelink(&[&whole], &symbols::declared()?, &work, &lib().join("libmuslin.a"))?;
    package.write_checksums()?;
    println!("the C package is in dist/c");
    Ok(())
}

/// Packs the library, and builds and runs programs with it as users would.
pub fn test() -> Result {
    build()?;
    check_exports()?;
    check_sizes()?;
    check_vectors()?;
    let work = files::target().join("package/consumers");
    files::create_empty_dir(&work)?;
    pack::check_checksums(&dir())?;
    test_plain_compiler(&work)?;
    test_pkg_config(&work)?;
    test_cmake(&work)?;
    test_two_libraries(&work)
}

/// Fails unless both libraries export exactly the functions that the header declares.
fn check_exports() -> Result {
    let shared = lib().join(shared_name());
    for (library, options) in [(shared, &["--dynamic"][..]), (lib().join("libmuslin.a"), &[])] {
        let exported = symbols::defined(&Binutils::host(), &library, options, false)?;
        symbols::check(&library, exported.into_iter().map(|symbol| symbol.name).collect())?;
    }
    Ok(())
}

/// Fails if a library is larger than its limit.
fn check_sizes() -> Result {
    let shared = size(&lib().join(shared_name()))?;
    let program = files::target().join("package/hang");
    let mut cc = shell::command("cc");
    cc.args(["-O1", "-Wl,--gc-sections", "-s", "-I"]).arg(dir().join("include"));
    cc.arg(files::root().join("bindings/c/examples/hang.c")).arg(lib().join("libmuslin.a"));
    shell::run(cc.args(["-lm", "-o"]).arg(&program))?;
    let program = size(&program)?;
    println!("the shared library has {shared} bytes, an example with the static one {program}");
    if shared > MAX_SHARED || program > MAX_STATIC {
        return Err(Failure::new(format!(
            "the libraries are too large: the limits are {MAX_SHARED} and {MAX_STATIC} bytes"
        )));
    }
    Ok(())
}

/// Fails if the compiler has not vectorised the loops of the library.
fn check_vectors() -> Result {
    if !cfg!(target_arch = "x86_64") {
        println!("vector instructions are counted on x86-64 only");
        return Ok(());
    }
    let library = lib().join(shared_name());
    let mut objdump = shell::command("objdump");
    let code = shell::output(objdump.args(["-d", "--no-show-raw-insn"]).arg(&library))?;
    let wide = code.lines().filter(|line| line.contains("vmulps") && line.contains("%ymm")).count();
    println!("the shared library has {wide} multiplications of 8 lanes");
    if wide < MIN_WIDE_PRODUCTS {
        return Err(Failure::new(format!(
            "the compiler did not vectorise the library: it has {wide} multiplications of 8 lanes, \
             and at least {MIN_WIDE_PRODUCTS} are expected"
        )));
    }
    Ok(())
}

fn size(path: &Path) -> Result<u64> {
    let metadata = std::fs::metadata(path).during(|| format!("reading {}", path.display()))?;
    Ok(metadata.len())
}

fn consumer() -> PathBuf {
    files::root().join("tests/c/package/consumer.c")
}

/// Runs a program with the shared library of the package.
fn run(program: &Path) -> Result {
    shell::run(shell::command(program).env("LD_LIBRARY_PATH", lib()))
}

fn test_plain_compiler(work: &Path) -> Result {
    for (name, library) in [("plain-static", "libmuslin.a"), ("plain-shared", "libmuslin.so")] {
        let mut cc = shell::command("cc");
        cc.arg("-I").arg(dir().join("include")).arg(consumer()).arg(lib().join(library));
        shell::run(cc.args(["-lm", "-lpthread", "-ldl", "-o"]).arg(work.join(name)))?;
        run(&work.join(name))?;
    }
    Ok(())
}

fn test_pkg_config(work: &Path) -> Result {
    let mut ask = shell::command("pkg-config");
    ask.env("PKG_CONFIG_PATH", lib().join("pkgconfig"));
    let flags = shell::output(ask.args(["--cflags", "--libs", &format!("muslin = {VERSION}")]))?;
    let program = work.join("pkg-config");
    let mut cc = shell::command("cc");
    cc.arg(consumer()).args(flags.split_whitespace()).arg("-o").arg(&program);
    shell::run(&mut cc)?;
    run(&program)
}

fn test_cmake(work: &Path) -> Result {
    let built = work.join("cmake");
    let mut cmake = shell::command("cmake");
    cmake.arg("-S").arg(files::root().join("tests/c/package")).arg("-B").arg(&built);
    let mut prefix = std::ffi::OsString::from("-DCMAKE_PREFIX_PATH=");
    prefix.push(dir());
    shell::run(cmake.arg(prefix).arg("-DCMAKE_BUILD_TYPE=Release"))?;
    shell::run(shell::command("cmake").arg("--build").arg(&built))?;
    run(&built.join("with_shared"))?;
    run(&built.join("with_static"))
}

/// Links two static Rust libraries, each with a standard library of its own, into one program.
fn test_two_libraries(work: &Path) -> Result {
    let (other, program) = (work.join("libother.a"), work.join("two"));
    let mut rustc = shell::command("rustc");
    rustc.args(["--edition=2024", "--crate-type=staticlib", "-o"]).arg(&other);
    shell::run(rustc.arg(files::root().join("tests/c/package/other.rs")))?;
    let mut cc = shell::command("cc");
    cc.arg("-DWITH_OTHER").arg("-I").arg(dir().join("include")).arg(consumer());
    cc.arg(lib().join("libmuslin.a")).arg(&other);
    shell::run(cc.args(["-lm", "-lpthread", "-ldl", "-o"]).arg(&program))?;
    run(&program)
}
