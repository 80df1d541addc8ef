//! The Python package: writes what follows from the header, builds the wheel, installs and tests it.
//!
//! ```text
//! muslin.h ──▶ src/muslin/_generated ─┬─▶ dist/python/*.whl ─┬─▶ target/python/user   the wheel and NumPy
//! libmuslin ─▶ target/python/lib ─────┘                      └─▶ target/python/tools  pytest, mypy, USD too
//! ```

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{c, files, shell};

/// What building and testing the package needs.
pub const NEEDS: &[&Need] = &[&setup::CXX, &setup::PYTHON_VENV];

fn package() -> PathBuf {
    files::root().join("bindings/python")
}

fn tests() -> PathBuf {
    files::root().join("tests/python")
}

fn work() -> PathBuf {
    files::target().join("python")
}

/// The folder of the wheel.
fn dist() -> PathBuf {
    files::root().join("dist/python")
}

/// Builds the wheel into `dist/python`, and installs it.
pub fn build() -> Result {
    setup::ensure(NEEDS)?;
    install_tools()?;
    c::build()?;
    let library = copy_library()?;
    let is_writing = std::env::var_os("MUSLIN_BLESS").is_some();
    let mut generate = tools_python();
    generate.env("MUSLIN_LIBRARY", &library).arg(package().join("tools/generate.py"));
    shell::run(generate.args(is_writing.then_some("--write")))?;
    files::create_empty_dir(&dist())?;
    let mut pip = tools_pip();
    pip.env("MUSLIN_LIBRARY", &library).arg("wheel").arg("--wheel-dir").arg(dist());
    shell::run(pip.args(["--quiet", "--no-deps", "--no-build-isolation"]).arg(package()))?;
    let wheel = wheel()?;
    let mut pip = tools_pip();
    pip.args(["install", "--quiet", "--no-deps", "--force-reinstall"]);
    shell::run(pip.arg(&wheel))?;
    install_for_user(&wheel)?;
    println!("the wheel is in dist/python");
    Ok(())
}

/// Runs the tests and examples with the installed package, and checks types and format.
pub fn test() -> Result {
    install()?;
    for options in [["format", "--check"], ["check", "--no-fix"]] {
        let mut ruff = tools_python();
        ruff.args(["-m", "ruff"]).args(options).args(["--quiet", "--no-cache", "--config"]);
        ruff.arg(package().join("pyproject.toml")).args([package(), tests()]);
        shell::run(ruff.args(["c", "csharp"].map(other_tools)))?;
    }
    let mut pytest = tools_python();
    pytest.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "--durations=5"]);
    shell::run(pytest.arg("--config-file").arg(package().join("pyproject.toml")).arg(tests()))?;
    let mut mypy = tools_python();
    mypy.args(["-m", "mypy", "--config-file"]).arg(package().join("pyproject.toml"));
    mypy.arg("--cache-dir").arg(work().join("mypy"));
    for folder in ["src", "tools", "examples"] {
        mypy.arg(package().join(folder));
    }
    shell::run(mypy.arg(other_tools("csharp")).arg(tests()))
}

/// The folder of the Python programs that another binding is made with.
fn other_tools(binding: &str) -> PathBuf {
    files::root().join("bindings").join(binding).join("tools")
}

/// Builds and installs the wheel, unless another step of the same run of the tests has done so.
pub fn install() -> Result {
    files::once_in_run("python-package", build)
}

/// The interpreter of an environment with the wheel and NumPy, and nothing else.
pub fn user_interpreter() -> PathBuf {
    interpreter(&user())
}

/// Copies the C library without its local symbols, as it is in the wheel.
fn copy_library() -> Result<PathBuf> {
    let name = format!("{DLL_PREFIX}muslin{DLL_SUFFIX}");
    let (built, copy) = (c::release_dir().join(&name), work().join("lib").join(&name));
    files::create_dir(&work().join("lib"))?;
    if cfg!(target_os = "linux") {
        shell::run(shell::command("strip").arg("-o").arg(&copy).arg(&built))?;
    } else {
        std::fs::copy(&built, &copy).during(|| format!("copying {name}"))?;
    }
    Ok(copy)
}

/// The wheel that was built last.
pub fn wheel() -> Result<PathBuf> {
    let mut wheels = files::with_suffix(&dist(), ".whl")?;
    match (wheels.pop(), wheels.is_empty()) {
        (Some(wheel), true) => Ok(wheel),
        _ => Err(Failure::new("dist/python does not hold one wheel")),
    }
}

/// The environment with the programs that build and test, at the versions of `requirements.txt`.
fn tools() -> PathBuf {
    work().join("tools")
}

/// The environment of a user, who installs the wheel.
fn user() -> PathBuf {
    work().join("user")
}

fn requirements() -> PathBuf {
    tests().join("requirements.txt")
}

fn interpreter(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

fn tools_python() -> Command {
    python_of(&tools())
}

fn tools_pip() -> Command {
    pip(&tools())
}

/// The interpreter of an environment. It writes nothing into the sources.
pub fn python_of(environment: &Path) -> Command {
    let mut python = shell::command(interpreter(environment));
    python.env("PYTHONDONTWRITEBYTECODE", "1").env_remove("PYTHONPATH");
    python
}

fn pip(environment: &Path) -> Command {
    let mut pip = python_of(environment);
    pip.args(["-m", "pip", "--disable-pip-version-check", "--no-input"]);
    pip
}

/// Installs the programs that `requirements.txt` lists, unless just these are installed.
pub fn install_tools() -> Result {
    install_environment(&tools(), &requirements())
}

/// Makes an environment with the packages that a file lists, unless it holds just these.
pub fn install_environment(environment: &Path, requirements: &Path) -> Result {
    let wanted = files::read(requirements)?;
    let installed = environment.join("requirements.txt");
    if files::read(&installed).ok().as_ref() != Some(&wanted) {
        files::create_empty_dir(environment)?;
        shell::run(shell::command("python3").args(["-m", "venv"]).arg(environment))?;
        let mut pip = pip(environment);
        pip.args(["install", "--quiet", "--only-binary=:all:", "--no-deps", "--requirement"]);
        shell::run(pip.arg(requirements))?;
        files::write(&installed, &wanted)?;
    }
    Ok(())
}

/// Installs the wheel with what it depends on into an environment that holds nothing else.
fn install_for_user(wheel: &Path) -> Result {
    files::create_empty_dir(&user())?;
    let mut venv = shell::command("python3");
    shell::run(venv.args(["-m", "venv", "--without-pip"]).arg(user()))?;
    let mut pip = tools_pip();
    pip.arg("--python").arg(interpreter(&user())).args(["install", "--quiet", "--constraint"]);
    shell::run(pip.arg(requirements()).arg(wheel))
}
