//! The command line's proofs: analyze, compare, zoneplate, bilateral, reproduce.

use crate::shell;

use std::fs;

use serde_json::Value;
use shell::{Shell, json};

#[test]
fn analysis_has_every_measure() {
    let shell = Shell::new();
    shell.ok("generate -n 300 -q -o a.txt");
    let measures = json(&shell.ok("analyze a.txt --json"));
    let names = "n_points hex_spacing coincident_points min_distance mean_distance coverage_radius beta bond_order bond_order_psa bond_order_global cvt_energy \
                 capacity_sd capacity_max_deviation angle_rms_deg triangle_quality min_angle_deg max_angle_deg obtuse_fraction valence";
    for name in names.split_whitespace() {
        assert!(!measures[name].is_null(), "{name}");
    }
    let bounded = json(&shell.ok("analyze a.txt --space rect --json --plot a.svg --draw voronoi"));
    for name in ["boundary_angle_rms_deg", "interior_angle_rms_deg", "uncovered_fraction", "isolated_points"] {
        assert!(bounded[name].is_number(), "{name}");
    }
    assert!(shell.read("a.svg").contains("<path"));
    assert!(shell.ok("analyze a.txt").contains("angle_rms_deg"));
}

#[test]
fn methods_stand_side_by_side_in_every_kind_of_table() {
    let shell = Shell::new();
    let text = shell.ok("compare -n 200 --methods white,lloyd,well-spaced --runs 2 --beta 0.8");
    let heads: Vec<&str> = text.lines().nth(2).unwrap().split_whitespace().collect();
    assert_eq!(heads, ["white", "lloyd", "well-spaced"]);
    for name in ["min_distance", "beta", "cvt_energy", "valence_6_fraction", "seconds", "iterations", "reached_fraction"] {
        assert!(text.lines().any(|line| line.starts_with(name)), "{name}: {text}");
    }
    shell.ok("compare -n 200 --methods lloyd,dart --runs 3 -o t.json");
    let json: Value = serde_json::from_str(&shell.read("t.json")).unwrap();
    assert_eq!(json["methods"][1]["method"], "dart");
    assert_eq!(json["methods"][0]["runs"].as_array().unwrap().len(), 3);
    assert_eq!(json["methods"][0]["runs"][2]["measures"]["n_points"], 200);
    shell.ok("compare -n 200 --methods lloyd,dart --runs 3 -o t.csv");
    assert_eq!(shell.read("t.csv").lines().count(), 7);
    shell.ok("compare -n 200 --methods lloyd,dart --runs 1 -o t.md");
    assert!(shell.read("t.md").contains("| | lloyd | dart |"));
    shell.ok("compare -n 2000 --methods lloyd,dart --runs 1 -o t.html");
    assert_eq!(shell.read("t.html").matches("<svg").count(), 2);
    // All begin with the points that are given: without chance of its own a method gives the same each time.
    shell.ok("generate -n 100 --method white -o in.txt");
    shell.ok("compare in.txt --methods cvt --runs 2 -o given.json");
    let json: Value = serde_json::from_str(&shell.read("given.json")).unwrap();
    assert_eq!(json["methods"][0]["runs"][0]["measures"], json["methods"][0]["runs"][1]["measures"]);
}

#[test]
fn a_spectrum_comes_with_the_measures_where_it_is_asked_for() {
    let shell = Shell::new();
    shell.ok("generate -n 2000 --method lloyd -o a.txt");
    let text = shell.ok("analyze a.txt --spectrum");
    assert!(text.contains("effective_nyquist") && text.contains("oscillation") && !text.contains("radial_power"), "{text}");
    let found: Value = serde_json::from_str(&shell.ok("analyze a.txt --spectrum --json")).unwrap();
    assert_eq!(found["radial_power"].as_array().unwrap().len(), found["frequencies"].as_array().unwrap().len());
    assert!(found["effective_nyquist"].as_f64().unwrap() > 0.85 && found["beta"].as_f64().unwrap() < 1.1);
    assert!(!shell.ok("analyze a.txt --json").contains("effective_nyquist"));
    assert_eq!(found["ring_power"].as_array().unwrap().len(), found["anisotropy_db"].as_array().unwrap().len());
    // Of several sets the mean.
    shell.ok("generate -n 1900 --method lloyd --seed 1 -o b.txt");
    let both: Value = serde_json::from_str(&shell.ok("analyze a.txt b.txt --spectrum --json")).unwrap();
    assert!(both["n_sets"] == 2 && both["sets"][1]["n_points"] == 1900 && both["sets"][0]["name"] == "a.txt");
    let abreast = shell.ok("analyze a.txt b.txt");
    assert!(abreast.lines().any(|line| line.split_whitespace().eq(["n_points", "2000", "1900"])), "{abreast}");
    // Where the density varies.
    let local: Value = serde_json::from_str(&shell.ok("analyze a.txt --spectrum --local --json")).unwrap();
    assert!(local["effective_nyquist"].as_f64().unwrap() > 0.8 && local.get("ring_power").is_none());
    shell.ok("generate -n 9 --method white -o few.txt");
    assert!(shell.refused("analyze few.txt --spectrum").contains("too few points"));
    assert!(shell.refused("analyze a.txt few.txt --spectrum").contains("of 9 and of 2000 points"));
    assert!(shell.refused("analyze a.txt b.txt --spectrum --local").contains("one set"));
    assert!(shell.refused("analyze a.txt --local").contains("--spectrum and --plot"));
    assert!(shell.refused("analyze a.txt --local --plot a.svg --draw spectrum").contains("means nothing"));
    assert!(shell.refused("analyze - -").contains("read once"));
}

#[test]
fn a_report_is_a_page_of_every_figure() {
    let shell = Shell::new();
    for (n, space) in [("300", "torus"), ("1500", "rect --size 3,2"), ("3", "torus"), ("2000", "torus --size 100,1")] {
        shell.ok(&format!("generate -n {n} --space {space} -q --force -o a.txt"));
        for ending in ["svg", "png", "pdf"] {
            shell.ok(&format!("analyze a.txt --space {space} --force --plot a.{ending}"));
        }
        let svg = shell.read("a.svg");
        for title in [
            "Points",
            "Neighbours",
            "Voronoi areas",
            "Power spectrum",
            "Radial mean",
            "Anisotropy",
            "Pair correlation",
            "Angles",
            "Measures",
        ] {
            assert!(svg.contains(&format!(">{title}")), "{title}");
        }
        assert_eq!(svg.contains("too few points"), n == "3");
        assert!(fs::read(shell.path("a.png")).unwrap().starts_with(b"\x89PNG"));
        assert!(fs::read(shell.path("a.pdf")).unwrap().starts_with(b"%PDF"));
    }
    // A chart alone; several; and one that there is no data for.
    shell.ok("generate -n 300 -q -o b.pdf --draw radial,angles,capacity");
    shell.ok("generate -n 300 -q -o b.txt");
    shell.ok("analyze b.txt b.txt --plot c.svg --draw anisotropy");
    assert!(shell.read("c.svg").contains("anisotropy (dB)"));
    shell.ok("analyze b.txt --local --plot d.svg");
    assert!(!shell.read("d.svg").contains("Anisotropy"));
    shell.ok("generate -n 9 -q -o few.txt");
    assert!(shell.refused("analyze few.txt --plot few.svg --draw radial").contains("too few points"));
    assert!(!shell.path("few.svg").exists());
    assert!(shell.refused("analyze few.txt --plot few.npy").contains("use one of .svg .png .pdf"));
}

#[test]
fn a_zone_plate_tells_noise_from_aliasing() {
    let shell = Shell::new();
    shell.ok("generate -n 1024 --method white -q -o white.txt");
    shell.ok("generate -n 1024 --method cvt -q -o cvt.txt");
    let of = |name: &str| -> Value {
        serde_json::from_str(&shell.ok(&format!("zoneplate {name}.txt --pixels 256 -o {name}.png --json"))).unwrap()
    };
    let (white, cvt) = (of("white"), of("cvt"));
    let less = |key: &str| cvt[key].as_f64().unwrap() < white[key].as_f64().unwrap();
    assert!(less("noise") && less("error") && !less("aliasing") && cvt["empty_pixels"] == 0);
    assert!(fs::read(shell.path("cvt.png")).unwrap().starts_with(b"\x89PNG"));
    assert!(shell.ok("zoneplate cvt.txt --filter gaussian --frequency 1").contains("aliasing"));
    for (flags, reason) in [
        ("--pixels 3", "from 16 to 4096"),
        ("--frequency 0", "above 0"),
        ("--space rect", "sample 32 x 32 pixels"),
        ("-o plate.svg", "plate.svg: a picture has pixels; use one of .png"),
        ("-o cvt.png", "exists already"),
    ] {
        assert!(shell.refused(&format!("zoneplate cvt.txt {flags}")).contains(reason), "{flags}");
    }
}

#[test]
fn a_bilateral_filter_needs_few_samples_and_any_picture() {
    let shell = Shell::new();
    shell.ok("generate -n 500 -m procrustes -q -o even.txt");
    shell.ok("generate -n 500 --method white -q -o white.txt");
    // Any picture will do, such as one of our own.
    shell.ok("generate -n 50 -q -o picture.png --draw valence");
    let of = |flags: &str| -> Value { serde_json::from_str(&shell.ok(&format!("bilateral small.png --json --force {flags}"))).unwrap() };
    shell.ok("zoneplate even.txt --pixels 100 -o small.png");
    let (even, white) = (of("--samples even.txt -o few.png --full all.png"), of("--samples white.txt"));
    assert!(even["mean_error"].as_f64().unwrap() < white["mean_error"].as_f64().unwrap() && white["rmse"].as_f64().unwrap() > 0.0);
    let again: Value =
        serde_json::from_str(&shell.ok("bilateral few.png --samples even.txt --json -j 1 --kernel 8 --count 10 --range 0.5")).unwrap();
    assert!(again["rmse"].as_f64().unwrap() < 0.1 && shell.path("all.png").exists());
    shell.write("broken.png", "\u{89}PNG and no more");
    shell.write("cut.jpg", b"\xff\xd8\xff\xe0\xff\xd9\xff\xda and the scan ends");
    for (flags, reason) in [
        ("broken.png --samples even.txt", "broken.png: not a readable PNG, JPEG, TIFF, WebP, GIF or BMP"),
        ("cut.jpg --samples even.txt", "not a whole JPEG"),
        ("small.png --samples even.txt --range -1", "--range is -1"),
        ("no.png --samples even.txt", "no.png: No such file"),
        ("even.txt --samples even.txt", "even.txt: not a readable PNG, JPEG, TIFF, WebP, GIF or BMP"),
        ("small.png --samples even.txt --kernel 0", "--kernel is 0"),
        ("small.png --samples even.txt --range 1e-200", "a millionth at least"),
        ("small.png --samples even.txt -o new.png --full ./new.png", "the same file"),
        ("- --samples -", "read once"),
        ("small.png --samples even.txt --space rect --count 900", "are too many"),
    ] {
        assert!(shell.refused(&format!("bilateral {flags}")).contains(reason), "{flags}");
    }
}

#[test]
fn a_paper_is_reproduced_part_by_part_and_goes_on_after_an_interruption() {
    let shell = Shell::new();
    // What an earlier run left is kept; what another version left, or is broken, is done again.
    fs::create_dir_all(shell.path("procrustes-quick.parts")).unwrap();
    let kept = r#"{"about":"kept from before","tables":[],"figures":[],"remarks":[],"seconds":1}"#;
    shell.write("procrustes-quick.parts/figure-5.json", format!("[\"{}\",{kept}]", env!("CARGO_PKG_VERSION")));
    shell.write("procrustes-quick.parts/figure-1.json", format!("[\"0.0.0\",{kept}]"));
    shell.write("procrustes-quick.parts/table-1.json", "broken");
    shell.ok("reproduce procrustes --quick");
    let page = shell.read("procrustes-quick.html");
    assert_eq!(page.matches("kept from before").count(), 1);
    assert!(page.contains("<h2>Table 1</h2>") && page.contains("angle RMS error") && page.contains("<i>11.70</i>"), "{}", page.len());
    let json: Value = serde_json::from_str(&shell.read("procrustes-quick.json")).unwrap();
    let parts: Vec<&str> = json["parts"].as_array().unwrap().iter().map(|part| part["name"].as_str().unwrap()).collect();
    assert_eq!(parts, ["Figure 1", "Figure 4", "Figure 5", "Table 1"]);
    let rows = json["parts"][3]["tables"][0]["rows"].as_array().unwrap();
    let ours = rows.iter().find(|row| row["name"] == "Procrustes, paper mode").unwrap();
    assert!(ours["cells"][0]["paper"] == 11.7 && (11.0..13.0).contains(&ours["cells"][0]["ours"].as_f64().unwrap()));
    assert!(!shell.path("procrustes-quick.parts").exists());
    assert!(shell.refused("reproduce procrustes --quick").contains("exists already"));
    assert!(shell.refused("reproduce nothing").contains("opt-beta"));
    shell.write("file", "");
    assert!(shell.refused("reproduce opt-beta -o file").starts_with("error: file: "));
}
