//! The command line with polygons: `evenly mesh`.

use crate::shapes;
use crate::shell;

use std::fmt::Write as _;

use serde_json::Value;
use shapes::{Ring, holed_square, l_shape, star};
use shell::{Shell, json};

fn text(rings: &[Ring]) -> String {
    let mut text = String::new();
    for ring in rings {
        for [x, y] in ring {
            let _ = writeln!(text, "{x} {y}");
        }
        text.push('\n');
    }
    text
}

fn shell() -> Shell {
    let shell = Shell::new();
    shell.write("l.txt", text(&l_shape()));
    shell.write("hole.txt", text(&holed_square()));
    shell.write("star.txt", text(&star(7, 0.3)));
    shell
}

fn report(shell: &Shell, name: &str) -> Value {
    json(&shell.read(name))
}

#[test]
fn every_format_holds_the_same_mesh() {
    let shell = shell();
    shell.ok("mesh hole.txt --edge-length 0.1 -o m.obj --report m.json");
    let quality = report(&shell, "m.json")["quality"].clone();
    let (n_vertices, n_triangles) = (quality["n_vertices"].as_u64().unwrap(), quality["n_triangles"].as_u64().unwrap());
    let n_edges = quality["n_boundary_edges"].as_u64().unwrap();
    let count = |name: &str, start: &str| shell.read(name).lines().filter(|line| line.starts_with(start)).count() as u64;
    assert_eq!((count("m.obj", "v "), count("m.obj", "f ")), (n_vertices, n_triangles));
    for format in ["msh", "vtu", "ply", "off", "stl", "geojson", "npz", "svg", "png", "pdf"] {
        shell.ok(&format!("mesh hole.txt --edge-length 0.1 -q -o m.{format}"));
    }
    assert!(shell.read("m.off").contains(&format!("\n{n_vertices} {n_triangles} 0\n")));
    let ply = std::fs::read(shell.path("m.ply")).unwrap();
    assert!(String::from_utf8_lossy(&ply).contains(&format!("element vertex {n_vertices}\n")));
    let msh = shell.read("m.msh");
    let elements = n_triangles + n_edges;
    // Eight segments of the boundary, a curve each, and the inside.
    assert!(msh.contains(&format!("$Elements\n9 {elements} 1 {elements}\n")) && msh.contains("$Entities\n0 8 1 0\n"), "{msh}");
    assert!(shell.read("m.vtu").contains(&format!("NumberOfPoints=\"{n_vertices}\" NumberOfCells=\"{elements}\"")));
    assert_eq!(std::fs::read(shell.path("m.stl")).unwrap().len() as u64, 84 + 50 * n_triangles);
    assert_eq!(report(&shell, "m.geojson")["features"].as_array().unwrap().len() as u64, n_triangles);
    // All was seeded alike.
    assert!(shell.read("m.svg").contains("mesh hole.txt --edge-length 0.1 -q -o m.svg (seed 0)"));
    assert_eq!(shell.ok("mesh hole.txt --edge-length 0.1 -q -o - --format off").lines().count() as u64, 3 + n_vertices + n_triangles);
}

#[test]
fn the_record_tells_the_quality() {
    let shell = shell();
    let record = json(&shell.ok("mesh l.txt --edge-length 0.05 --seed 3 --json -q -o l.msh"));
    let quality = &record["quality"];
    let number = |name: &str| quality[name].as_f64().unwrap();
    assert!(number("min_angle_deg") > 41.0 && number("max_angle_deg") < 97.0 && number("beta") < 0.757, "{quality}");
    assert_eq!(record["parameters"]["seed"], 3);
    assert_eq!(record["run"]["outcome"], "converged");
    assert!(record["uncovered_area"].as_f64().unwrap() < 1e-12 && record["unmet"].as_array().unwrap().is_empty());
}

#[test]
fn a_number_of_triangles_is_about_kept() {
    let shell = shell();
    for n in [300.0, 5000.0] {
        let record = json(&shell.ok(&format!("mesh star.txt -n {n} --json -q --force -o s.msh")));
        let found = record["quality"]["n_triangles"].as_f64().unwrap();
        assert!((found / n - 1.0).abs() < 0.25, "{found} of {n}");
    }
}

#[test]
fn demands_that_are_missed_are_told_with_place_and_reason() {
    let shell = shell();
    shell.ok("mesh l.txt --edge-length 0.05 --no-obtuse --min-angle 30 -o l.msh");
    shell.ok("mesh star.txt --edge-length 0.05 --min-angle 25 -o s.msh");
    // Walls that nearly touch are refined between, but not to any demand.
    shell.write("narrow.txt", "0 0\n1 0\n1 0.0001\n0.5 0.000101\n0 0.0001\n");
    let output = shell.run("mesh narrow.txt --edge-length 0.2 --no-obtuse --min-angle 35 -o n.msh");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("not reached: ") && said.contains(" degrees at (") && said.contains("narrow"), "{said}");
    assert!(shell.files().contains(&"n.msh".into()));
}

#[test]
fn sizes_lines_and_fixed_points_come_from_files() {
    let shell = shell();
    shell.write("fixed.txt", "0.25 0.25\n0.1 0.8\n");
    shell.write("lines.txt", "0.1 0.1\n0.4 0.4\n\n0 0.6\n0.5 0.6\n");
    shell.write("sizes.txt", "0.9 0.1 0.01\n0.1 0.9 0.1 # coarse\n");
    shell.ok("mesh l.txt --edge-length 0.1 --fixed fixed.txt --lines lines.txt -q -o l.obj");
    let vertices = shell.read("l.obj");
    for vertex in ["0.25 0.25 0", "0.1 0.8 0", "0.4 0.4 0", "0 0.6 0", "0.5 0.6 0"] {
        assert!(vertices.lines().any(|line| line == format!("v {vertex}")), "{vertex}");
    }
    let triangles = |flags: &str| {
        json(&shell.ok(&format!("mesh l.txt --edge-length 0.1 {flags} --json -q --force -o m.msh")))["quality"]["n_triangles"]
            .as_u64()
            .unwrap()
    };
    assert!(2 * triangles("--sizes sizes.txt") > 3 * triangles(""));
    let fine = json(&shell.ok("mesh l.txt --edge-length 0.02 --json -q -o fine.msh"))["quality"]["n_triangles"].as_u64().unwrap();
    let graded =
        json(&shell.ok("mesh l.txt --edge-length 0.02 --grade 0.3 --json -q -o graded.msh"))["quality"]["n_triangles"].as_u64().unwrap();
    assert!(2 * graded < fine, "{graded} {fine}");
}

#[test]
fn cells_are_written_beside() {
    let shell = shell();
    shell.ok("mesh hole.txt --edge-length 0.1 -q -o m.obj --cells cells.geojson");
    let n_vertices = shell.read("m.obj").lines().filter(|line| line.starts_with("v ")).count();
    assert_eq!(report(&shell, "cells.geojson")["features"].as_array().unwrap().len(), n_vertices);
}

#[test]
fn bad_usage_is_one_clear_line() {
    let shell = shell();
    shell.write("empty.txt", "# nothing\n");
    shell.write("outside.txt", "5 5\n");
    shell.write("away.txt", "5 5\n6 6\n");
    for (line, said) in [
        ("mesh l.txt -o m.msh", "--edge-length"),
        ("mesh l.txt --edge-length 0.1 -n 100 -o m.msh", "cannot be used with"),
        ("mesh l.txt --edge-length 0 -o m.msh", "--edge-length is 0"),
        ("mesh l.txt --edge-length -1 -o m.msh", "--edge-length is -1"),
        ("mesh l.txt --edge-length 1e-9 -o m.msh", "too many"),
        ("mesh l.txt --edge-length 0.1 --grade 3 -o m.msh", "--grade is 3"),
        ("mesh l.txt --edge-length 0.1 --min-angle 50 -o m.msh", "--min-angle is 50"),
        ("mesh l.txt --edge-length 0.1 --max-edge-length 1 -o m.msh", "--grade"),
        ("mesh l.txt --edge-length 0.1 -o m.xyz", "unknown ending"),
        ("mesh l.txt --edge-length 0.1 -o m.msh --cells m.svg", ".geojson"),
        ("mesh empty.txt --edge-length 0.1 -o m.msh", "there is no polygon in it"),
        ("mesh missing.txt --edge-length 0.1 -o m.msh", "missing.txt"),
        ("mesh l.txt --edge-length 0.1 --fixed outside.txt -o m.msh", "outside.txt: the polygon does not hold the fixed point (5, 5)"),
        ("mesh l.txt --edge-length 0.1 --lines away.txt -o m.msh", "away.txt: the polygon does not hold the lines, that from (5, 5)"),
        ("mesh l.txt --edge-length 0.1 -o l.txt", "exists already"),
    ] {
        let found = shell.refused(line);
        assert!(found.contains(said), "{line}: {found}");
    }
}

#[test]
fn details_are_told_and_left_out() {
    let shell = shell();
    let coast: String = (0..2000)
        .map(|k| {
            let (angle, radius) = (k as f64 * std::f64::consts::TAU / 2000.0, 1.0 + 0.004 * f64::from(k * 7919 % 13));
            format!("{} {}\n", radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    shell.write("coast.txt", coast);
    let said = |line: &str| String::from_utf8(shell.run(line).stderr).unwrap();
    let told = said("mesh coast.txt -n 200 -o fine.obj");
    assert!(told.contains("the boundary's details take") && told.contains("--simplify"), "{told}");
    let told = said("mesh coast.txt -n 200 --simplify 0.05 -o coarse.obj");
    assert!(told.contains("simplified: ") && !told.contains("details take"), "{told}");
    let n_triangles = shell.read("coarse.obj").lines().filter(|line| line.starts_with("f ")).count();
    assert!(n_triangles < 600, "{n_triangles}");
    assert!(shell.refused("mesh coast.txt -n 200 --simplify 0 -o none.obj").contains("--simplify"));
}

#[test]
fn only_sharp_corners_have_small_angles_and_that_is_no_fault() {
    let shell = shell();
    shell.write("needle.txt", "0 0\n1000 0\n1000 0.01\n");
    let output = shell.run("mesh needle.txt --edge-length 10 -o needle.obj");
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(0) && told.contains("forced: "), "{told}");
    shell.ok("mesh l.txt --edge-length 0.2 --min-angle 20 -q -o l.obj");
    // A corner of 30 degrees keeps a demand of 34 from being met, one of 20 not.
    shell.write("wedge.txt", "0 0\n10 0\n8.660254 5\n");
    for (demand, is_forced) in [(34, true), (20, false)] {
        let output = shell.run(&format!("mesh wedge.txt --edge-length 1 --min-angle {demand} --force -o wedge.obj"));
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(0) && told.contains("forced: 1 triangle in sharp corners") == is_forced, "{told}");
    }
}

#[test]
fn longitudes_and_latitudes_are_told() {
    let shell = shell();
    let geojson = |ring: &str| format!(r#"{{"type":"Polygon","coordinates":[[{ring}]]}}"#);
    shell.write("degrees.json", geojson("[10,50],[12,50],[12,52],[10,50]"));
    shell.write("metres.json", geojson("[100,500],[1200,500],[1200,5200],[100,500]"));
    let parts = "[[[-180,10],[-175,10],[-175,15],[-180,10]]],[[[175,10],[180,10],[180,15],[175,10]]]";
    shell.write("both.json", format!(r#"{{"type":"MultiPolygon","coordinates":[{parts}]}}"#));
    let said = |file: &str| String::from_utf8(shell.run(&format!("mesh {file} -n 50 --force -o m.obj")).stderr).unwrap();
    assert!(said("degrees.json").contains("longitudes"));
    assert!(!said("metres.json").contains("longitudes"));
    assert!(said("both.json").contains("antimeridian"));
}

#[test]
fn regions_stay_apart() {
    let shell = shell();
    let feature = |name: &str, ring: &str| {
        format!(r#"{{"type":"Feature","properties":{{"name":"{name}"}},"geometry":{{"type":"Polygon","coordinates":[[{ring}]]}}}}"#)
    };
    // Two that touch, one in the middle of them that comes too late for what they have, and one by itself.
    let features = [
        feature("west", "[0,0],[500,0],[500,900],[0,900],[0,0]"),
        feature("east", "[500,0],[1000,0],[1000,900],[500,900],[500,0]"),
        feature("late", "[800,800],[1200,800],[1200,1000],[800,1000],[800,800]"),
        feature("apart", "[2000,0],[2300,0],[2300,300],[2000,0]"),
    ];
    shell.write("parcels.json", format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(",")));
    let record = json(&shell.ok("mesh parcels.json --edge-length 50 --regions --json -q -o parcels.msh"));
    assert!((record["quality"]["area"].as_f64().unwrap() - (900_000.0 + 60_000.0 + 45_000.0)).abs() < 1e-3);
    let text = shell.read("parcels.msh");
    for line in ["2 3 \"west\"", "2 4 \"east\"", "1 5 \"around late\"", "2 6 \"apart\""] {
        assert!(text.contains(line), "{line}");
    }
    shell.ok("mesh parcels.json --edge-length 50 --regions -q -o parcels.vtu");
    assert!(shell.read("parcels.vtu").contains("Name=\"region\""));
    shell.ok("mesh parcels.json --edge-length 50 --regions -q -o parcels.npz");
    assert!(shell.refused("mesh parcels.json --edge-length 50 --regions --simplify 1 -o no.msh").contains("--regions"));
}

/// What `mesh` writes, `analyze` and `remesh` read.
#[test]
fn meshes_are_read_again() {
    let shell = Shell::new();
    shell.write("l.txt", "0 0\n2 0\n2 1\n1 1\n1 2\n0 2\n");
    for ending in ["msh", "vtu", "npz", "obj", "ply", "off"] {
        shell.ok(&format!("mesh l.txt --edge-length 0.2 -o l.{ending} --report l.json --force"));
        let found = json(&shell.ok(&format!("analyze l.{ending} --json")));
        let made = json(&shell.read("l.json"));
        assert_eq!(
            (&found["n_triangles"], &found["n_vertices"]),
            (&made["quality"]["n_triangles"], &made["quality"]["n_vertices"]),
            "{ending}"
        );
        assert!((found["area"].as_f64().unwrap() - 3.0).abs() < 1e-9, "{ending}");
        assert!((found["min_angle_deg"].as_f64().unwrap() - made["quality"]["min_angle_deg"].as_f64().unwrap()).abs() < 1e-6, "{ending}");
    }
    shell.ok("remesh l.msh -n 200 -o again.vtu");
}
