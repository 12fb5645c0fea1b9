//! The Python package's tests: its wheel is built, installed into an environment of its own, and tried.

use std::path::{Path, PathBuf};

use super::run;

const ENVIRONMENT: &str = "target/python";
const WHEELS: &str = "target/wheels";

/// Builds the wheel, and runs pytest, mypy and all examples in the documentation.
pub fn test() -> bool {
    let python = interpreter();
    // The wheel has the profile that all tests have: optimised, its assertions kept.
    let build = ["-m", "maturin", "build", "--locked", "--profile", "dev", "--out", WHEELS];
    (python.exists() || run("python3", &["-m", "venv", ENVIRONMENT]))
        && run(&python, &["-m", "pip", "install", "--quiet", "--requirement", "tests/python/requirements.txt"])
        && emptied(WHEELS.as_ref())
        && run(&python, &build)
        && run(
            &python,
            &["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps", "--no-index", "--find-links", WHEELS, "evenly"],
        )
        && run(&python, &["-m", "mypy", "crates/evenly-py/python/evenly"])
        && run(&python, &["-m", "pytest", "--quiet", "tests/python"])
}

fn interpreter() -> PathBuf {
    let program = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
    [ENVIRONMENT, program].iter().collect()
}

/// Whether a folder of older wheels is gone.
fn emptied(folder: &Path) -> bool {
    !folder.exists() || std::fs::remove_dir_all(folder).is_ok()
}
