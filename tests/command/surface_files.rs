//! The command line with surfaces: `evenly remesh`, `evenly sample`, `evenly analyze` of a mesh.

use crate::shell;
use crate::solids;

use std::fmt::Write as _;

use evenly::TriangleMesh;
use shell::{Shell, json};
use solids::{cube, torus, two_at_an_edge};

fn off(mesh: &TriangleMesh) -> String {
    let mut text = format!("OFF\n{} {} 0\n", mesh.vertices.len(), mesh.triangles.len());
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} {z}");
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

fn shell() -> Shell {
    let shell = Shell::new();
    shell.write("torus.off", off(&torus(40, 16)));
    shell.write("cube.off", off(&cube(2)));
    shell.write("edge.off", off(&two_at_an_edge()));
    shell.write(
        "cloud.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 1 1\n",
    );
    shell.write("flat.txt", "# x y\n1 2\n");
    shell
}

#[test]
fn a_mesh_goes_out_in_every_format_and_is_measured_alike() {
    let shell = shell();
    for ending in ["ply", "obj", "off"] {
        shell.ok(&format!("remesh torus.off -n 600 -o m.{ending} --report r.json --force"));
        let report = json(&shell.read("r.json"));
        let found = json(&shell.ok(&format!("analyze m.{ending} --reference torus.off --json")));
        for name in ["n_vertices", "min_angle_deg", "max_angle_deg", "min_quality", "euler_characteristic", "obtuse_triangles"] {
            assert_eq!(report["quality"][name], found[name], "{ending} {name}");
        }
        assert_eq!((&found["n_vertices"], &found["euler_characteristic"]), (&600.into(), &0.into()));
        assert_eq!((&found["n_breaches"], &found["self_intersections"]), (&0.into(), &0.into()));
        assert!(found["hausdorff"].as_f64().unwrap() < 0.05);
    }
    shell.ok("remesh torus.off -n 600 -o m.stl");
    shell.ok("remesh torus.off -n 600 -o m.vtu --plot m.svg");
    assert!(shell.read("m.svg").starts_with("<svg"));
    shell.ok("remesh torus.off -n 600 --ascii -o m.ply --force");
    let ply = shell.read("m.ply");
    for name in ["nx", "facet", "bary2"] {
        assert!(ply.contains(&format!("property double {name}\n")), "{name}");
    }
}

#[test]
fn sizes_and_features_are_heard() {
    let shell = shell();
    let quality = |words: &str| {
        // On a cube this coarse not all targets are met, and that is said.
        let code = shell.run(&format!("remesh {words} -o m.ply --report r.json --force")).status.code();
        assert!(code == Some(0) || code == Some(1) && words.starts_with("cube"), "{words}: {code:?}");
        json(&shell.read("r.json"))["quality"].clone()
    };
    assert!(quality("torus.off -n 900 --density linear:x,3")["max_edge"].as_f64() > Some(0.15));
    assert_eq!(quality("torus.off -n 900 --density lfs")["n_vertices"], 900);
    assert!(quality("torus.off --density curvature:0.01")["n_vertices"].as_u64() > Some(100));
    assert!(quality("torus.off --edge-length 0.15")["n_vertices"].as_u64() > Some(500));
    let (kept, off) = (quality("cube.off -n 400"), quality("cube.off -n 400 --features off"));
    assert!((kept["area"].as_f64().unwrap() - 6.0).abs() < 1e-9);
    assert!(off["area"].as_f64() < Some(6.0 - 1e-3));
}

#[test]
fn points_are_sampled() {
    let shell = shell();
    for method in ["push-pull", "eliminate", "white"] {
        shell.ok(&format!("sample torus.off -n 300 --method {method} -o p.csv --force"));
        assert_eq!(shell.read("p.csv").lines().count(), 301, "{method}");
    }
    shell.ok("sample torus.off --spacing 0.2 --method poisson-disk -o p.ply");
    for flags in [
        "white --density linear:z,3",
        "poisson-disk --density curvature",
        "well-spaced --beta 0.8 --density linear:x,2",
        "lloyd --iterations 9",
        "capacity",
    ] {
        shell.ok(&format!("sample torus.off -n 300 --method {flags} -o p.csv --force"));
    }
    let error = shell.refused("remesh torus.off -n 300 --tolerance 0.1 -o q.off");
    assert!(error.contains("--max-deviation") && !error.contains("procrustes"), "{error}");
    for flags in ["cvt", "white --iterations 9", "lloyd --beta 0.7", "poisson-disk --density nothing"] {
        shell.refused(&format!("sample torus.off -n 300 --method {flags} -o q.csv"));
    }
    let text = shell.ok("sample torus.off -n 10 --method white -o -");
    assert_eq!(text.lines().filter(|line| !line.starts_with('#')).count(), 10);
}

#[test]
fn the_spread_of_points_on_a_mesh_is_told() {
    let shell = shell();
    shell.ok("sample torus.off -n 600 -o p.ply");
    shell.ok("sample torus.off -n 600 --method white -o w.csv");
    let measures = |words: &str| json(&shell.ok(&format!("analyze {words} --json")));
    let (even, white) = (measures("p.ply --reference torus.off --spectrum"), measures("w.csv --reference torus.off --spectrum"));
    assert!(even["effective_nyquist"].as_f64() > Some(0.8) && white["effective_nyquist"].as_f64() < Some(0.3));
    assert!(even["min_distance"].as_f64() > Some(0.85) && white["min_distance"].as_f64() < Some(0.3));
    // Of a mesh it is that of its vertices.
    shell.ok("remesh torus.off -n 600 -o m.off");
    let mesh = measures("m.off --reference torus.off --spectrum --local");
    assert!(mesh["effective_nyquist"].as_f64() > Some(0.7) && mesh["obtuse_triangles"] == 0);
    shell.ok("analyze w.csv --reference torus.off --plot w.svg");
    shell.ok("analyze m.off --spectrum --plot m.svg");
    assert!(shell.read("w.svg").contains("Pair correlation") && shell.read("m.svg").contains("Pair correlation"));
}

#[test]
fn given_points_are_a_start() {
    let shell = shell();
    for (ending, n) in [("csv", 321), ("txt", 300), ("ply", 300)] {
        shell.ok(&format!("sample torus.off -n {n} --method white -o p.{ending}"));
        shell.ok(&format!("remesh torus.off --points p.{ending} --method eliminate -o m.off --force --report r.json"));
        let record = json(&shell.read("r.json"));
        assert_eq!(record["quality"]["n_vertices"], n, "{ending}");
    }
    // Of a mesh the vertices, and fewer than there are.
    shell.ok("remesh torus.off --points m.off -n 250 -o n.off --report r.json --force");
    assert_eq!(json(&shell.read("r.json"))["quality"]["n_vertices"], 250);
}

#[test]
fn bad_input_is_one_clear_error() {
    let shell = shell();
    for (words, expected) in [
        ("remesh edge.off -n 100 -o m.ply", "edge 0-1"),
        ("remesh nothing.obj -n 100 -o m.ply", "nothing.obj"),
        ("remesh torus.off -o m.ply", "required"),
        ("remesh torus.off -n 100 --edge-length 1 -o m.ply", "cannot be used"),
        ("remesh torus.off -n 2 -o m.ply", "--n-vertices is 2"),
        ("remesh torus.off -n 300 --ascii -o m.obj", "--ascii is for .ply"),
        ("remesh torus.off -n 300 --weld 0 -o m.obj", "--weld is 0"),
        ("remesh torus.off -n 100 --density linear:w,3 -o m.ply", "linear:axis,ratio"),
        ("remesh torus.off -n 100 --density attr:heat -o m.ply", "attr"),
        ("remesh torus.off -n 100 --features 200deg -o m.ply", "below 180"),
        ("remesh torus.off -n 100 -o m.geojson", "flat"),
        ("remesh torus.off -n 100 --points edge.off -o m.ply", "at least as many"),
        ("remesh torus.off --points flat.txt -o m.ply", "flat.txt:2: 2 numbers"),
        ("remesh - --points - -o m.ply", "stdin"),
        ("analyze cloud.ply", "--reference names the mesh"),
        ("analyze cloud.ply --reference torus.off --spectrum", "too few"),
        ("analyze cloud.ply --reference torus.off --certify 0.7", "triangles"),
        ("analyze torus.off --local", "--local is for --spectrum and --plot"),
        ("analyze torus.off --local --plot p.svg", "of a mesh --plot alone"),
        ("sample torus.off --spacing=-1 -o p.csv", "positive"),
        ("analyze torus.off --certify 0.1", "0.5 or more"),
    ] {
        let said = shell.refused(words);
        assert!(said.contains(expected), "{words}: {said}");
    }
    // Repaired, it is a manifold.
    shell.run("remesh edge.off -n 100 --repair -o m.ply");
    assert!(json(&shell.ok("analyze edge.off --json"))["is_manifold"] == false);
}

#[test]
fn parts_of_files_that_are_not_kept_are_told() {
    let shell = shell();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    shell.write("parts.obj", format!("{corners}g a\nf 1 3 2\nf 1 2 4\ng b\nusemtl red\nf 2 3 4\nf 3 1 4\n"));
    shell.write("whole.obj", format!("{corners}o a\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"));
    shell.write(
        "labels.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
         property list uchar int vertex_indices\nproperty int label\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 5\n3 0 1 3 5\n3 1 2 3 6\n3 2 0 3 6\n",
    );
    for (name, told) in [
        ("parts.obj", Some("its 3 objects, groups and materials are not kept apart")),
        ("whole.obj", None),
        ("labels.ply", Some("what its faces have besides corners is not kept: label")),
    ] {
        let output = shell.run(&format!("sample {name} -n 10 -o out.ply --force"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert_eq!(told.is_some(), said.contains("kept"), "{name}: {said}");
        assert!(told.is_none_or(|told| said.contains(told)), "{name}: {said}");
    }
}

#[test]
fn a_mesh_that_misses_its_targets_says_what_and_where_and_a_coarse_one_what_it_loses() {
    let shell = shell();
    let output = shell.run("remesh cube.off -n 50 -o cube.obj --report r.json");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    let record = json(&shell.read("r.json"));
    for missed in record["missed"].as_array().unwrap() {
        let [what, n] = ["what", "n"].map(|name| missed[name].to_string().replace('"', ""));
        assert!(said.contains(&format!("not reached: {n} {what}")), "{said}");
    }
    assert_eq!(record["missed"].as_array().unwrap().len(), 2);
    let smallest: Vec<f64> =
        record["breaches"].as_array().unwrap().iter().map(|breach| breach["min_angle_deg"].as_f64().unwrap()).collect();
    assert_eq!(smallest[0], record["quality"]["min_angle_deg"].as_f64().unwrap());

    let few = |n: usize| String::from_utf8(shell.run(&format!("remesh torus.off -n {n} -o few.obj --force")).stderr).unwrap();
    assert!(few(30).contains("30 vertices are few for this surface: a mesh of them has"), "{}", few(30));
    assert!(!few(600).contains("are few"));
}
