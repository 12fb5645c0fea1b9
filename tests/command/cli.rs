//! The command line as a user meets it: what it writes, what it says, and how it ends.

use crate::shell;

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;
use shell::{Shell, json};

#[test]
fn the_readme_command_leaves_a_picture() {
    let shell = Shell::new();
    shell.ok("generate -n 10000 --method procrustes -o points.svg");
    let svg = shell.read("points.svg");
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    // Points near the seam are drawn on both sides.
    assert!((10_000..11_000).contains(&svg.matches('M').count()));
    assert!(svg.contains("(seed 0)"));
}

#[test]
fn every_format_is_written_and_the_same_points_are_read_back() {
    let shell = Shell::new();
    for name in ["a.txt", "a.csv", "a.npy"] {
        shell.ok(&format!("generate -n 500 --seed 3 -q -o {name}"));
    }
    let measures = |name: &str| shell.ok(&format!("analyze {name} --json"));
    assert_eq!(measures("a.txt"), measures("a.csv"));
    assert_eq!(measures("a.txt"), measures("a.npy"));
    assert_eq!(json(&measures("a.txt"))["n_points"], 500);
    shell.ok("generate -n 500 -q -o a.png --draw points,delaunay,voronoi,valence");
    assert!(fs::read(shell.path("a.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_seed_is_a_promise_on_any_number_of_threads() {
    let shell = Shell::new();
    for (name, threads) in [("a.npy", 1), ("b.npy", 2), ("c.npy", 5)] {
        shell.ok(&format!("generate -n 20000 --seed 11 -j {threads} -q -o {name}"));
    }
    let bytes = |name: &str| fs::read(shell.path(name)).unwrap();
    assert!(bytes("a.npy") == bytes("b.npy") && bytes("a.npy") == bytes("c.npy"));
}

#[test]
fn streams_are_read_and_written() {
    let shell = Shell::new();
    let points = shell.ok("generate -n 100 --method white -q -o -");
    assert_eq!(points.lines().filter(|line| !line.starts_with('#')).count(), 100);
    let mut child =
        shell.command("optimize - -o - --format csv").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(points.as_bytes()).unwrap();
    let better = String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap();
    assert_eq!(better.lines().next(), Some("x,y"));
    assert_eq!(better.lines().count(), 101);
}

#[test]
fn optimising_improves_points_where_they_are() {
    let shell = Shell::new();
    let place = "--space rect --size 640,480 --origin -100,1e6";
    shell.ok(&format!("generate -n 800 --method white {place} -o in.csv"));
    shell.ok(&format!("optimize in.csv -m procrustes {place} -o out.csv"));
    let angle = |name: &str| json(&shell.ok(&format!("analyze {name} {place} --json")))["angle_rms_deg"].as_f64().unwrap();
    assert!(angle("in.csv") > 20.0 && angle("out.csv") < 12.0);
    shell.ok(&format!("optimize in.csv --method warp {place} -o warped.csv"));
    assert!(angle("warped.csv") < angle("in.csv"));
}

#[test]
fn methods_and_sizes_have_short_forms() {
    let shell = Shell::new();
    shell.ok("generate -n 60 --method push-pull --space rect --size 640,480 -o long.csv");
    shell.ok("generate -n 60 -m push-pull --space rect --size 640x480 -o short.csv");
    let points = |name: &str| shell.read(name).lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(points("short.csv"), points("long.csv"));
    assert!(shell.refused("generate -n 60 --size 640 -o a.csv").contains("such as 640,480 or 640x480"));
}

#[test]
fn the_report_holds_the_whole_run() {
    let shell = Shell::new();
    shell.ok("generate -n 1000 -m procrustes --seed 5 --mode paper --side 1.25 -o a.txt --report run.json");
    let report = json(&shell.read("run.json"));
    assert_eq!(report["method"], "procrustes");
    assert_eq!(report["seed"], 5);
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["parameters"]["side"], 1.25);
    assert_eq!(report["parameters"]["mode"], "paper");
    assert_eq!(report["space"]["kind"], "torus");
    assert_eq!(report["run"]["outcome"], "converged");
    assert_eq!(report["run"]["energy_rises"], 0);
    let energy = report["run"]["energy"].as_array().unwrap();
    assert_eq!(energy.len() as u64, report["run"]["iterations"].as_u64().unwrap() + 1);
    assert!(energy.windows(2).all(|pair| pair[1].as_f64() <= pair[0].as_f64()));
    for phase in ["start", "warp", "separate", "triangulate", "optimize", "measure", "write"] {
        assert!(report["seconds"][phase].as_f64().unwrap() >= 0.0, "{phase}");
    }
    assert!(report["measures"]["angle_rms_deg"].as_f64().unwrap() < 12.0);
    let printed = json(&shell.ok("generate -n 100 -q -o b.txt --json"));
    assert_eq!(printed["n_points"], 100);
}

#[test]
fn push_pull_reaches_its_targets_and_reports_its_passes() {
    let shell = Shell::new();
    for (flags, unwanted) in [
        ("", ""),
        ("--preset tough", ""),
        ("--preset fast --relaxation 1.2", ""),
        ("--min-distance 0.8 --coverage-radius 0.7 --capacity-tolerance 0.1", ""),
        ("--min-distance 0.8", "coverage_radius"),
        ("--coverage-radius 0.7 --capacity-tolerance off", "min_distance capacity_tolerance"),
        ("--capacity-tolerance 0.05", "min_distance coverage_radius"),
        ("--preset balanced --min-distance off", "min_distance"),
        ("--capacity-tolerance off", "capacity_tolerance"),
        ("--schedule summed", ""),
    ] {
        for space in ["torus --size 3,1", "rect --size 2,2 --origin -1,7"] {
            let line = format!("generate -n 700 --method push-pull --space {space} {flags} -q -o a.txt --force --json");
            let record = json(&shell.ok(&line));
            assert_eq!(record["unmet"], json("[]"), "{line}");
            let (run, measures, parameters) = (&record["run"], &record["measures"], &record["parameters"]);
            assert_eq!(run["outcome"], "converged", "{line}");
            for (name, measure, sign) in [
                ("min_distance", "min_distance", -1.0),
                ("coverage_radius", "coverage_radius", 1.0),
                ("capacity_tolerance", "capacity_max_deviation", 1.0),
            ] {
                let wanted = parameters[name].as_f64();
                assert_eq!(wanted.is_none(), unwanted.contains(name), "{line}: {name}");
                let measured = measures[measure].as_f64().unwrap();
                assert!(wanted.is_none_or(|wanted| sign * (measured - wanted) < 1e-6), "{line}: {name} {measured}");
            }
            let shares = run["stable_share"].as_array().unwrap();
            assert_eq!(shares.len() as u64, run["iterations"].as_u64().unwrap(), "{line}");
            assert_eq!(shares.last().unwrap(), 1.0, "{line}");
            assert!(run["visits"].as_u64().unwrap() > 700, "{line}");
        }
    }
    shell.ok("optimize a.txt --method push-pull --space rect --size 2,2 --origin -1,7 --seed 3 -o b.csv --report run.json");
    assert_eq!(json(&shell.read("run.json"))["seed"], 3);
}

#[test]
fn well_spaced_points_come_with_a_certificate() {
    let shell = Shell::new();
    let output = shell.run("generate -n 2000 --method well-spaced --beta 0.7 -o a.txt --report run.json");
    assert_eq!(output.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no triangle is obtuse; all angles lie within 45."));
    let record = json(&shell.read("run.json"));
    assert_eq!((&record["parameters"]["beta"], &record["method"]), (&json("0.7"), &json("\"well-spaced\"")));
    assert!(record["measures"]["beta"].as_f64().unwrap() <= 0.7 && record["angle_bounds_deg"][1].as_f64().unwrap() < 90.0);
    assert_eq!(shell.run("optimize a.txt --method well-spaced --beta 0.6 -i 5 -o b.txt").status.code(), Some(1));
    // Ten points meet the ratio, though not the distance and the radius that were aimed at.
    shell.ok("generate -n 10 --method well-spaced --beta 0.9 -o c.txt");
}

#[test]
fn what_comes_in_better_goes_out_as_it_was() {
    let shell = Shell::new();
    let grid: String = (0..144).map(|k| format!("{} {}\n", (f64::from(k % 12) + 0.5) / 12.0, (f64::from(k / 12) + 0.5) / 12.0)).collect();
    shell.write("grid.txt", &grid);
    let output = shell.run("optimize grid.txt --space rect --method well-spaced --beta 0.6 -i 30 -o out.txt");
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("the points that came in miss the targets by less"));
    let numbers = |text: String| -> Vec<f64> {
        text.lines()
            .filter(|line| !line.starts_with('#'))
            .flat_map(|line| line.split(' ').map(|x| x.parse().unwrap()).collect::<Vec<_>>())
            .collect()
    };
    assert_eq!(numbers(shell.read("out.txt")), numbers(grid));
}

#[test]
fn targets_that_are_not_reached_are_told_with_what_was_measured() {
    let shell = Shell::new();
    let output = shell.run("generate -n 500 --method push-pull --min-distance 0.97 --coverage-radius 0.6 -i 40 -o a.txt --report run.json");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("the nearest that are: min distance 0.91 with coverage radius 0.62"), "{said}");
    assert!(said.contains("not converged in 40 passes") && said.contains("not reached: min distance is 0."), "{said}");
    assert_eq!(shell.read("a.txt").lines().filter(|line| !line.starts_with('#')).count(), 500);
    let unmet = &json(&shell.read("run.json"))["unmet"];
    assert_eq!((unmet[0]["name"].as_str(), unmet[0]["wanted"].as_f64()), (Some("min_distance"), Some(0.97)));
    assert!(unmet[0]["measured"].as_f64().unwrap() > 0.5);
}

#[test]
fn few_points_are_no_trouble() {
    let shell = Shell::new();
    for n in [1, 2, 3, 4, 7, 20] {
        for space in ["torus", "rect"] {
            shell.ok(&format!("generate -n {n} --space {space} -o {n}{space}.txt --report {n}{space}.json"));
            let text = shell.read(&format!("{n}{space}.txt"));
            assert_eq!(text.lines().filter(|line| !line.starts_with('#')).count(), n);
        }
    }
    let report = json(&shell.read("2torus.json"));
    assert_eq!(report["run"]["outcome"], "nothing_to_do");
    assert!(report["notes"][0].as_str().unwrap().contains("nothing to optimise"));
}

#[test]
fn what_is_not_reached_is_written_and_said() {
    let shell = Shell::new();
    let output = shell.run("generate -n 1000 -m procrustes -i 3 -o a.txt");
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("not converged in 3 iterations"));
    assert!(shell.read("a.txt").lines().count() > 1000);
    // What the default method aims at is no wish: it is said, and no failure.
    let output = shell.run("generate -n 3 -o b.txt");
    assert_eq!(output.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&output.stderr).contains("not reached: min distance"));
    assert_eq!(shell.run("generate -n 3 --min-distance 0.85 -o c.txt").status.code(), Some(1));
}

#[test]
fn lengths_may_be_in_input_units() {
    let shell = Shell::new();
    shell.ok("generate -n 1000 --size 640,480 --min-distance 15u -o a.csv --report run.json");
    let record = json(&shell.read("run.json"));
    let of = |part: &str, name: &str| record[part][name].as_f64().unwrap();
    assert!(of("lengths", "min_distance") >= 15.0 - 1e-4 && of("parameters", "min_distance") < 0.8);
    assert!((of("lengths", "min_distance") - of("measures", "min_distance") * of("measures", "hex_spacing")).abs() < 1e-9);
    shell.ok("optimize a.csv --size 640x480 -m farthest-point --min-distance 15.5u -o b.csv");
    shell.ok("generate -m poisson-disk --spacing 0.05u -o c.csv");
    shell.write("l.txt", "0 0\n2 0\n2 1\n1 1\n1 2\n0 2\n");
    shell.ok("mesh l.txt --edge-length 0.1u --min-distance 0.08u -o a.msh");
    for (line, expected) in [
        ("generate -n 10 --min-distance 5km -o o.csv", "inputs have no units"),
        ("mesh l.txt --edge-length 5km -o o.msh", "inputs have no units"),
        (
            "generate -n 50 --size 3,1 --min-distance 5u -o o.csv",
            "--min-distance is 5u, which is 18.9959 spacings of 2.6321e-1; it must be",
        ),
        ("generate -n 10 -m lloyd -i 5u -o o.csv", "it must be a count"),
        ("generate -n 10 -m opt-beta --beta 1u -o o.csv", "--beta is 1u; it must be a number alone"),
        ("mesh l.txt --edge-length 0.1 --grade 0.2 --min-distance 0.08u -o o.msh", "where spacings vary it must be in spacings"),
    ] {
        let said = shell.refused(line);
        assert!(said.contains(expected), "{line}: {said}");
    }
}

/// As many ask for: 60 points in a triangle, 8 of which stay.
#[test]
fn points_around_others_are_far_apart_and_the_way_to_more_is_said() {
    let shell = Shell::new();
    shell.write("triangle.txt", "0 0\n1 0\n0.5 0.9\n");
    shell.write("fixed.txt", "0.3 0.1\n0.5 0.2\n0.7 0.1\n0.5 0.5\n0.4 0.3\n0.6 0.33\n0.5 0.7\n0.2 0.05\n");
    let of = |flags: &str| {
        let line = format!("generate -n 60 --space triangle.txt --fixed fixed.txt {flags} --force -o out.csv --report run.json");
        let output = shell.run(&line);
        assert_eq!(output.status.code(), Some(0), "{line}");
        let distance = json(&shell.read("run.json"))["measures"]["min_distance"].as_f64().unwrap();
        (distance, String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (default, said) = of("");
    assert!(said.contains("at fixed points miss a target") && said.contains("farthest-point makes the smallest distance"), "{said}");
    assert!(of("-m procrustes").0 < default && default < of("-m farthest-point").0);
}

#[test]
fn bad_input_gets_one_line_and_no_file() {
    let shell = Shell::new();
    shell.write("good.txt", "0.1 0.2\n0.5 0.7\n0.9 0.3\n");
    shell.write("empty.txt", "");
    shell.write("rubbish.txt", [0u8, 159, 146, 150, 255, 1]);
    shell.write("nan.csv", "x,y\n0.1,0.2\nNaN,0.3\n");
    shell.write("wide.txt", "0.1 0.2\n0.1 0.2 0.3\n");
    shell.write("outside.txt", "0.1 0.2\n0.5 0.7\n1.9 0.3\n");
    shell.write("two.txt", "0.1 0.2\n0.5 0.7\n");
    shell.write("text.npy", "1 2\n");
    shell.write("broken.npy", b"\x93NUMPY\x01\x00v\x00{'descr': '<f8'");
    fs::create_dir(shell.path("folder")).unwrap();
    for (line, expected) in [
        ("optimize missing.txt -o o.txt", "missing.txt: No such file"),
        ("optimize empty.txt -o o.txt", "empty.txt: there are no points in it"),
        ("optimize folder -o o.txt", "folder: Is a directory"),
        ("optimize rubbish.txt -o o.txt", "rubbish.txt: this is not text"),
        ("optimize nan.csv -o o.txt", "nan.csv:3: NaN is not a finite number"),
        ("optimize wide.txt -o o.txt", "wide.txt:2: 3 numbers, expected 2"),
        ("optimize broken.npy -o o.txt", "broken.npy: this is no .npy file"),
        ("optimize outside.txt --space rect --size 1,1 -o o.txt", "outside.txt: point 2 is (1.9, 0.3), outside the domain 1 x 1 at (0, 0)"),
        ("optimize outside.txt --space rect -o o.txt", "they span (0.1, 0.2) to (1.9, 0.7): give their --size"),
        ("analyze two.txt", "two.txt: 2 distinct points make no triangulation"),
        ("analyze missing.txt", "missing.txt: No such file"),
        ("mesh two.txt --spacing 1 -o o.msh", "it is called --edge-length now"),
        ("remesh two.txt --n-points 10 -o o.obj", "it is called --n-vertices now"),
        ("generat -n 10 -o o.txt", "did you mean generate?"),
        ("generate -n 10 --min-distanc .8 -o o.txt", "did you mean --min-distance?"),
        ("generate -n 10 --method pushpull -o o.txt", "did you mean push-pull?"),
        ("generate -n 0 -o o.txt", "'0'"),
        ("generate -n 1e12 -o o.txt", "'1e12'"),
        ("generate -n 2.5 -o o.txt", "'2.5'"),
        ("generate -n -3 -o o.txt", "'-3'"),
        ("generate -o o.txt", "--n-points is missing"),
        ("generate -o o.txt --method dart", "--spacing or --n-points is missing"),
        ("generate -n 9 --spacing 0.1 -o o.txt --method poisson-disk", "exclude each other"),
        ("generate --spacing 2 -o o.txt --method poisson-disk", "--spacing is 2; it must be at most the torus' shorter side"),
        ("generate --spacing -1 -o o.txt --method poisson-disk", "--spacing is -1"),
        ("generate --spacing NaN -o o.txt --method dart", "--spacing is NaN"),
        ("generate --spacing 1e-9 -o o.txt --method poisson-disk", "are too many"),
        ("generate --spacing 0.1 --coverage 0.05 -o o.txt --method poisson-disk", "--coverage is 0.05; it must be the spacing or more"),
        ("generate --spacing 0.1 --tries 0 -o o.txt --method dart", "--tries is 0"),
        ("generate -n 9 --tries 9 -o o.txt --method eliminate", "--tries is for --method dart"),
        ("generate -n 9 --spacing 0.1 -o o.txt", "--spacing is for --method poisson-disk or dart"),
        ("generate -n 10", "--output"),
        ("generate -n 10 -o o.txt --size 0,1", "0 x 1"),
        ("generate -n 10 -o o.txt --size NaN,1", "NaN x 1"),
        ("generate -n 10 -o o.txt --size -1,1", "-1 x 1"),
        ("generate -n 10 -o o.txt --size 1", "two numbers"),
        ("generate -n 10 -o o.txt --origin inf,0", "finite"),
        ("generate -n 10 -m procrustes -o o.txt --side 0", "--side is 0"),
        ("generate -n 10 -o o.txt --tolerance -1", "tolerance"),
        ("generate -n 10 -o o.txt -i 0", "--iterations is 0"),
        ("generate -n 10 -o o.txt --method nonsense", "nonsense"),
        ("generate -n 10 -o o.txt --method push-pull --min-distance 1.1", "--min-distance is 1.1"),
        ("generate -n 10 -o o.txt --method push-pull --min-distance NaN", "--min-distance is NaN"),
        ("generate -n 10 -o o.txt --method push-pull --min-distance some", "a number, or off"),
        ("generate -n 10 -o o.txt --method push-pull --coverage-radius 0.5", "--coverage-radius is 0.5"),
        ("generate -n 10 -o o.txt --method push-pull --capacity-tolerance -0.1", "--capacity-tolerance is -0.1"),
        (
            "generate -n 10 -o o.txt --method push-pull --preset fast --min-distance off --coverage-radius off --capacity-tolerance off",
            "there is no target",
        ),
        ("generate -n 10 -o o.txt --method push-pull --relaxation 2", "--relaxation is 2"),
        ("generate -n 10 -o o.txt --method push-pull -i 0", "--iterations is 0"),
        ("generate -n 10 -o o.txt --method push-pull --preset nonsense", "nonsense"),
        ("generate -n 10 -o o.txt --method push-pull --side 1", "--side is for --method procrustes"),
        ("generate -n 10 -m lloyd -o o.txt --preset tough", "--preset is for --method push-pull"),
        ("generate -n 10 -o o.txt --method well-spaced --beta 0.5", "--beta is 0.5"),
        ("generate -n 10 -o o.txt --method well-spaced --relaxation 1.1", "--relaxation is for --method push-pull"),
        ("generate -n 10 -o o.txt --method push-pull --beta 0.75", "--beta is for --method well-spaced"),
        ("generate -n 10 -o o.txt --method white --mode fast", "--mode is for --method procrustes"),
        ("optimize good.txt -o o.txt --method warp -i 3", "--iterations is for"),
        ("optimize good.txt -o o.txt --method warp --no-warp", "--no-warp is for"),
        ("generate -n 10 -o o.txt --method white --start jittered", "--start is for"),
        ("generate -n 10 -o o.txt --nonsense", "--nonsense"),
        ("compare", "--n-points is missing"),
        ("compare -n 2", "takes 3 or more"),
        ("compare good.txt -n 20", "cannot be used with"),
        ("compare -n 10 --methods none", "none"),
        ("compare -n 10 --methods lloyd,cvt --beta 0.7", "--beta is for --method well-spaced or opt-beta"),
        ("compare -n 10 --runs 0", "'0'"),
        ("compare -n 10 --damping 7", "--damping is 7"),
        ("compare good.txt --start dart", "cannot be used with"),
        ("generate -n 10 -o o.txt --method capacity --capacity-tolerance off", "--capacity-tolerance is off"),
        ("generate --spacing 0.01 --coverage 0.9 -o o.txt --method poisson-disk", "8 times that at most"),
        ("compare -n 10 -o o.txt", "o.txt: unknown ending; use one of .md .csv .json .html"),
        ("compare missing.txt", "missing.txt: No such file"),
        ("generate -n 10 -o good.txt", "good.txt exists already; pass --force"),
        ("generate -n 10 -o o.xyz", "o.xyz: unknown ending; use one of .txt .csv .npy .geojson .svg .png .pdf"),
        ("generate -n 10 -o o", "o: no ending"),
        ("generate -n 10 -o folder", "folder: "),
        ("generate -n 10 -o nowhere/o.txt", "nowhere/o.txt: its folder does not exist"),
        ("generate -n 10 -o o.txt --draw points", "--draw needs a figure"),
        ("generate -n 10 -o - --json", "cannot both go to stdout"),
        ("generate -n 10 -o o.txt --report o.txt", "cannot go to the same file"),
        ("generate -n 10 -o o.txt --report ./folder/../o.txt", "cannot go to the same file"),
        ("generate -n 2 -q -o o.svg --draw voronoi", "2 distinct points"),
        ("generate -n 1000000 -o o.txt --size 1,1 --origin 1e13,0", "move the origin nearer to 0"),
        ("optimize outside.txt -o o.txt --size 1e-200,1", "differ by more"),
    ] {
        let said = shell.refused(line);
        assert!(said.contains(expected), "{line}: {said}");
    }
}

#[test]
fn a_maximal_set_has_as_many_points_as_it_has_and_says_so() {
    let shell = Shell::new();
    let run = shell.ok("generate -n 1000 --method poisson-disk -o a.txt --json");
    let record: Value = serde_json::from_str(&run).unwrap();
    let n = record["n_points"].as_u64().unwrap();
    assert!((950..1050).contains(&n), "{n}");
    assert!(n == 1000 || record["notes"][0].as_str().unwrap().contains(&format!("{n} for 1000")), "{record}");
    shell.ok("generate --spacing 0.05 --coverage 0.1 --method poisson-disk --space rect --size 3,1 -o b.txt");
    for method in ["dart", "eliminate"] {
        shell.ok(&format!("generate -n 777 --method {method} -o {method}.txt"));
        assert_eq!(shell.read(&format!("{method}.txt")).lines().filter(|line| !line.starts_with('#')).count(), 777);
    }
    // As a start, the number is exact again.
    shell.ok("generate -n 777 --method well-spaced --start poisson-disk -o c.txt");
    assert_eq!(shell.read("c.txt").lines().filter(|line| !line.starts_with('#')).count(), 777);
}

#[test]
fn text_that_pretends_to_be_numpy_is_still_read() {
    let shell = Shell::new();
    shell.write("text.npy", "0.1 0.2\n0.7 0.1\n0.5 0.9\n");
    shell.ok("optimize text.npy -q -o o.txt");
}

#[test]
fn points_outside_the_torus_are_wrapped_and_told() {
    let shell = Shell::new();
    shell.write("out.txt", "0.1 0.2\n-0.5 0.7\n1.9 0.3\n0.4 0.4\n");
    let output = shell.run("optimize out.txt --size 1,1 -o o.txt");
    assert_eq!(output.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&output.stderr).contains("2 points lie outside the torus"));
    // Nobody has said that the torus is the unit one.
    for line in ["optimize out.txt -o p.txt", "analyze out.txt", "compare out.txt --methods lloyd"] {
        let said = shell.refused(line);
        assert!(said.contains("which was assumed") && said.contains("(-0.5, 0.2) to (1.9, 0.7): give their --size"), "{line}: {said}");
    }
}

#[test]
fn points_carry_their_domain_along() {
    let shell = Shell::new();
    for (space, file) in [("torus", "a.txt"), ("rect", "b.geojson")] {
        shell.ok(&format!("generate -n 300 --space {space} --size 640,480 --origin -1e6,7 -o {file}"));
        let of = |flags: &str| json(&shell.ok(&format!("analyze {file} {flags} --json")));
        assert_eq!(of(""), of(&format!("--space {space} --size 640,480 --origin -1e6,7")));
        shell.ok(&format!("optimize {file} -o better-{file} --report run.json --force"));
        let name = if space == "rect" { "rectangle" } else { space };
        assert_eq!(json(&shell.read("run.json"))["space"]["kind"], name);
        assert_eq!(json(&shell.ok(&format!("analyze better-{file} --json")))["n_points"], 300);
    }
}

#[test]
fn existing_files_are_overwritten_only_by_force() {
    let shell = Shell::new();
    shell.write("a.txt", "precious");
    shell.refused("generate -n 10 -o a.txt");
    assert_eq!(shell.read("a.txt"), "precious");
    shell.ok("generate -n 10 -o a.txt --force");
    assert!(shell.read("a.txt").starts_with("# evenly"));
    assert_eq!(shell.files(), ["a.txt"]);
}

#[cfg(unix)]
#[test]
fn links_and_devices_stay_what_they_are() {
    let shell = Shell::new();
    shell.write("real.txt", "old");
    std::os::unix::fs::symlink("real.txt", shell.path("link.txt")).unwrap();
    shell.ok("generate -n 10 -q -o link.txt --force");
    assert!(shell.path("link.txt").is_symlink() && shell.read("real.txt").starts_with("# evenly"));
    shell.ok("generate -n 10 -q -o /dev/null --format txt --force");
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_nothing_behind() {
    let shell = Shell::new();
    // A limit on file sizes stands in for a full disk.
    let script = format!("ulimit -f 8; trap '' XFSZ; exec {} generate -n 10000 -q -o a.txt", env!("CARGO_BIN_EXE_evenly"));
    let output = Command::new("sh").current_dir(shell.path("")).args(["-c", &script]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: a.txt: "));
    assert!(shell.files().is_empty());
    assert!(shell.refused("generate -n 10 -q -o /dev/full --format txt").starts_with("error: /dev/full: No space left"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_the_best_state() {
    let shell = Shell::new();
    let line = "generate -n 300000 -m procrustes --mode paper --no-warp --tolerance 1e-9 -i 100000 -o a.npy --report run.json";
    let child = shell.command(line).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_secs(4));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
    let report = json(&shell.read("run.json"));
    assert_eq!(report["run"]["outcome"], "cancelled");
    assert_eq!(fs::metadata(shell.path("a.npy")).unwrap().len(), 16 * 300_000 + 128);
}

/// Batch systems send SIGTERM, lost terminals SIGHUP.
#[cfg(unix)]
#[test]
fn other_signals_write_the_best_state_too() {
    for (signal, code) in [("-TERM", 143), ("-HUP", 129)] {
        let shell = Shell::new();
        let line = "generate -n 300000 -m procrustes --mode paper --no-warp --tolerance 1e-9 -i 100000 -o a.npy";
        let child = shell.command(line).stderr(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_secs(4));
        Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert_eq!(child.wait_with_output().unwrap().status.code(), Some(code));
        assert_eq!(shell.files(), ["a.npy"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn outputs_that_cannot_be_are_refused_before_the_work() {
    let shell = Shell::new();
    std::os::unix::fs::symlink("nowhere/x.csv", shell.path("link.csv")).unwrap();
    let refused = |line: &str| {
        let output = shell.command(line).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{line}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(refused("generate -n 5 -o link.csv --force").contains("a link to a file that does not exist"));
    assert!(refused("generate -n 5 -o - --report /dev/stdout").contains("cannot go to the same file"));
    let closed = Command::new("sh").arg("-c").arg(format!("{} generate -n 5 -o - >&-", env!("CARGO_BIN_EXE_evenly"))).output().unwrap();
    assert_eq!(closed.status.code(), Some(2), "{}", String::from_utf8_lossy(&closed.stderr));
    let many = shell.command("generate -n 100 --method white -j 5000 -o a.txt").output().unwrap();
    assert!(String::from_utf8_lossy(&many.stderr).contains("threads are used, 4 for each core"));
}

#[test]
fn points_of_tables_and_maps_keep_what_is_said_of_them() {
    let shell = Shell::new();
    shell.write("t.csv", "id,y,x,what\n1,.1,.2,a\n2,.5,.6,\"b,c\"\n3,.9,.1,\"\"\"d\"\"\"\n");
    shell.ok("optimize t.csv --method lloyd -i 1 -o u.csv");
    let rows: Vec<String> = shell.read("u.csv").lines().map(str::to_owned).collect();
    assert_eq!(rows[0], "x,y,id,what");
    assert!(rows[2].ends_with(",2,\"b,c\"") && rows[3].ends_with(",3,\"\"\"d\"\"\""), "{rows:?}");
    shell.ok("generate -n 50 --method white -o p.geojson");
    shell.ok("generate -n 50 --method white -o p.txt");
    assert_eq!(shell.ok("analyze p.geojson --json"), shell.ok("analyze p.txt --json"));
}

#[cfg(target_os = "linux")]
#[test]
fn talk_that_cannot_be_said_is_no_error() {
    let shell = Shell::new();
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let status = |line: &str| shell.command(line).stderr(full()).status().unwrap().code();
    assert_eq!(status("generate -n 100 -v -o a.txt"), Some(0));
    assert_eq!(status("generate -n 0 -o b.txt"), Some(2));
    assert_eq!(status("optimize missing.txt -o b.txt"), Some(2));
    assert_eq!(shell.files(), ["a.txt"]);
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let shell = Shell::new();
    let mut child =
        shell.command("generate -n 50000 --method white -q -o -").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(0));
}

#[test]
fn help_completions_and_man_page_are_there() {
    let shell = Shell::new();
    for verb in ["", "generate ", "optimize ", "analyze "] {
        let short = shell.ok(&format!("{verb}-h"));
        assert!(short.contains("Example") && short.lines().count() <= 60, "{verb}: {}", short.lines().count());
        assert!(shell.ok(&format!("{verb}--help")).len() >= short.len());
    }
    for name in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(shell.ok(&format!("completions {name}")).contains("evenly"));
    }
    let page = shell.ok("man");
    assert!(page.contains(".TH") && page.contains("generate") && page.contains("tolerance"));
    assert!(shell.ok("--version").starts_with("evenly "));
    assert!(!Path::new("o.txt").exists());
}

#[test]
fn meshes_are_made_by_other_methods_too() {
    let shell = Shell::new();
    shell.write("area.txt", "0 0\n2 0\n2 1\n0 1\n");
    for method in ["opt-beta", "lloyd", "distmesh", "well-spaced", "capacity", "push-pull"] {
        let record =
            json(&shell.ok(&format!("mesh area.txt --edge-length 0.1 --method {method} --iterations 20 -q --json --force -o area.obj")));
        assert!(record["quality"]["min_angle_deg"].as_f64().unwrap() > 25.0);
    }
    for flags in
        ["--no-obtuse", "--method lloyd --no-obtuse", "--beta 0.72 --method well-spaced", "--min-distance 0.85 --coverage-radius 0.68"]
    {
        shell.ok(&format!("mesh area.txt --edge-length 0.1 --force -o area.obj {flags}"));
    }
    for flags in
        ["--beta 0.7", "--method lloyd --iterations 0", "--method cvt", "--method lloyd --beta 0.7", "--method well-spaced --beta 9"]
    {
        shell.refused(&format!("mesh area.txt --edge-length 0.1 --force -o area.obj {flags}"));
    }
}

#[test]
fn factors_in_units_of_their_own_spread_over_all_their_levels() {
    let shell = Shell::new();
    let levels = |axis: usize, width: f64| {
        let text = shell.read("design.txt");
        let points = text.lines().filter(|line| !line.starts_with('#'));
        let mut levels: Vec<f64> = points.map(|line| line.split_whitespace().nth(axis).unwrap().parse::<f64>().unwrap() / width).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|a, b| *a - *b < 1e-4);
        levels.len()
    };
    shell.ok("generate -n 20 --space rect --size 160,4 --metric unit -q -o design.txt");
    assert!(levels(0, 160.0) >= 10 && levels(1, 4.0) >= 10);
    // The same as in the unit square, but for units.
    shell.ok("generate -n 20 --space rect -q -o unit.txt");
    let measures = |line: &str| {
        let mut measures = json(&shell.ok(line));
        measures.as_object_mut().unwrap().retain(|key, _| ["min_distance", "coverage_radius", "beta"].contains(&key.as_str()));
        measures
    };
    let unit = measures("analyze unit.txt --space rect --json");
    let design = measures("analyze design.txt --space rect --size 160,4 --metric unit --json");
    for key in ["min_distance", "coverage_radius", "beta"] {
        let [a, b] = [&unit, &design].map(|measures| measures[key].as_f64().unwrap());
        assert!((a - b).abs() < 1e-6, "{key}: {a}, {b}");
    }
    shell.refused("generate -n 20 --metric metres -o other.txt");
}

#[test]
fn a_run_keeps_within_its_memory() {
    let shell = Shell::new();
    let refused = |line: &str, expected: &str| {
        let said = shell.refused(line);
        assert!(said.contains(expected), "{line}: {said}");
    };
    refused("generate -n 10000000 --memory 500MB -o out.txt", "10000000 points by push-pull take about 4.5 GB of memory");
    refused("generate -n 3 --memory 8X -o out.txt", "--memory");

    // Of 100 kB that are put in a thousand times.
    let long = "M0 0L1 0L1 1".repeat(8000);
    let uses = "<path d='&p;'/>".repeat(1000);
    shell.write(
        "entities.svg",
        format!("<!DOCTYPE svg [<!ENTITY p \"{long}\">]><svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 2 2'>{uses}</svg>"),
    );
    refused("mesh entities.svg -n 10 -o out.obj", "its own entities make 96.1 MB of it");
    // Drawing programs have short ones.
    shell.write(
        "short.svg",
        "<!DOCTYPE svg [<!ENTITY p \"M0 0L1 0L1 1\">]><svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 2 2'><path d='&p;'/></svg>",
    );
    shell.ok("mesh short.svg -n 10 -o short.obj");

    // A triangle in 300,000 places.
    let triangle = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let part = "{\"attributes\":{\"POSITION\":0}}";
    let parts = vec![part; 1000].join(",");
    let nodes = vec!["{\"mesh\":0}"; 300].join(",");
    let roots: Vec<String> = (0..300).map(|node| node.to_string()).collect();
    shell.write(
        "many.gltf",
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,{triangle}\"}}],\
             \"bufferViews\":[{{\"buffer\":0,\"byteLength\":36}}],\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}}],\
             \"meshes\":[{{\"primitives\":[{parts}]}}],\"nodes\":[{nodes}],\"scenes\":[{{\"nodes\":[{}]}}],\"scene\":0}}",
            roots.join(",")
        ),
    );
    refused("sample many.gltf -n 10 --memory 100MB -o out.ply", "at most 100.0 MB of memory may be used");
}

#[test]
fn methods_are_listed_with_all_that_they_can_be_told() {
    let shell = Shell::new();
    let table = shell.ok("methods");
    assert!(table.contains("| push-pull ") && table.contains("| hexagonal "));
    assert!(shell.ok("methods well-spaced").contains("--beta"));
    let registry = json(&shell.ok("methods --json"));
    assert_eq!(registry[0]["name"], "procrustes");
    assert_eq!(registry[0]["parameters"][1]["choices"], json("[\"paper\", \"fast\"]"));
    shell.refused("methods none");
}
