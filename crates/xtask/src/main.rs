//! The project's own chores: `cargo xtask test | python | bench | gallery | reproduce`.

mod python;

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, ExitCode};

const USAGE: &str = "\
usage: cargo xtask CHORE
  test           all tests: units, laws, numbers, the command line, the examples in the documentation, and the Python package's
  python         the Python package's tests alone: in an environment of its own, target/python
  bench [quick] [procrustes | push-pull | starts | comparators | spectrum | density | mesh | surfaces]
                 the table of speed and quality, measured on this machine
  gallery        redraws the pictures of README and manual, in docs/gallery
  reproduce      recomputes what the papers show, as pages in target/reproduction: some five minutes; their figures go to docs/reproduction";

/// Runs the command line.
const EVENLY: [&str; 5] = ["run", "--release", "--package", "evenly-cli", "--"];

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let is_done = match args[..] {
        ["test"] => cargo(&["test", "--workspace", "--locked"]) && python::test(),
        ["python"] => python::test(),
        ["bench", ref wanted @ ..] => cargo(&[&["bench", "--package", "evenly", "--bench", "table", "--"], wanted].concat()),
        ["gallery"] => gallery(),
        ["reproduce"] => reproduce(),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    if is_done { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The pictures that README and manual show.
fn gallery() -> bool {
    let pictures: [&[&str]; 10] = [
        &["generate", "-n", "10000", "-o", "docs/gallery/points.png"],
        &["generate", "-n", "2500", "--draw", "valence", "-o", "docs/gallery/valence.png"],
        &[
            "generate",
            "-n",
            "600",
            "--method",
            "procrustes",
            "--space",
            "rect",
            "--size",
            "3,2",
            "--draw",
            "delaunay,points",
            "-o",
            "docs/gallery/rectangle.png",
        ],
        &["generate", "-n", "4096", "--method", "push-pull", "--draw", "report", "-o", "docs/gallery/report.svg"],
        &[
            "stipple",
            "target/scenes/balls.png",
            "-n",
            "30000",
            "--layers",
            "cmyk",
            "--page",
            "240x160mm",
            "--margin",
            "4mm",
            "-o",
            "docs/gallery/balls.png",
        ],
        &[
            "stipple",
            "target/scenes/mountains.png",
            "-n",
            "40000",
            "--page",
            "270x150mm",
            "--margin",
            "4mm",
            "-o",
            "docs/gallery/mountains.png",
        ],
        &[
            "stipple",
            "target/scenes/torus.png",
            "-n",
            "6000",
            "--sizes",
            "tone",
            "--page",
            "150x150mm",
            "--margin",
            "4mm",
            "-o",
            "docs/gallery/torus.png",
        ],
        &[
            "generate",
            "-n",
            "1200",
            "--space",
            "target/polygons/coast.txt",
            "--method",
            "push-pull",
            "--draw",
            "voronoi,points",
            "-o",
            "docs/gallery/polygon.png",
        ],
        &["mesh", "target/polygons/coast.txt", "-n", "6000", "--grade", "0.2", "-o", "docs/gallery/coast.png"],
        &["mesh", "target/polygons/plate.txt", "--edge-length", "0.04", "--no-obtuse", "-o", "docs/gallery/plate.png"],
    ];
    let example = |name: &str, path: &str| cargo(&["run", "--release", "--package", "evenly-io", "--example", name, path]);
    let is_drawn = example("03_scenes", "target/scenes")
        && example("04_polygons", "target/polygons")
        && pictures.iter().all(|picture| cargo(&[&EVENLY, *picture, &["--force"]].concat()));
    let mut examples =
        [("01_energy", "docs/gallery/energy.svg"), ("02_methods", "docs/gallery/methods.svg"), ("05_surfaces", "docs/gallery/surfaces")]
            .into_iter();
    is_drawn && examples.all(|(name, path)| example(name, path))
}

/// The papers reproduced: pages in the target folder, their figures among the documentation.
fn reproduce() -> bool {
    let pages = Path::new("target/reproduction");
    ["procrustes", "push-pull", "opt-beta"].into_iter().all(|paper| {
        let figures = format!("{paper}.json");
        cargo(&[&EVENLY, &["reproduce", paper, "-o", "target/reproduction", "--force"][..]].concat())
            && std::fs::copy(pages.join(&figures), Path::new("docs/reproduction").join(&figures)).is_ok()
    })
}

fn cargo(args: &[&str]) -> bool {
    run(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()), args)
}

/// Runs a program; whether it went well.
fn run(program: impl AsRef<OsStr>, args: &[&str]) -> bool {
    let program = program.as_ref();
    match Command::new(program).args(args).status() {
        Ok(status) => status.success(),
        Err(error) => {
            eprintln!("{} cannot be run: {error}", program.display());
            false
        }
    }
}
