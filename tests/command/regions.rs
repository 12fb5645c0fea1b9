//! Points in polygons and points that stay, as a user of the command line meets them.

use crate::shell;

use shell::{Shell, json};

const L: &str = "0 0\n2 0\n2 1\n1 1\n1 2\n0 2\n";
const METHODS: [&str; 14] = [
    "procrustes",
    "push-pull",
    "well-spaced",
    "capacity",
    "lloyd",
    "distmesh",
    "opt-beta",
    "cvt",
    "farthest-point",
    "poisson-disk",
    "eliminate",
    "dart",
    "jittered",
    "white",
];

fn numbers(text: &str) -> Vec<[f64; 2]> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let pair = |line: &str| {
        let numbers: Vec<f64> = line.split_whitespace().map(|number| number.parse().unwrap()).collect();
        [numbers[0], numbers[1]]
    };
    lines.map(pair).collect()
}

#[test]
fn every_method_makes_points_in_a_polygon() {
    let shell = Shell::new();
    shell.write("l.txt", L);
    for method in METHODS {
        shell.run(&format!("generate -n 200 --space l.txt --method {method} -q -o {method}.txt"));
        let points = numbers(&shell.read(&format!("{method}.txt")));
        assert!(points.len() == 200 || method == "poisson-disk", "{method}: {}", points.len());
        assert!(points.iter().all(|[x, y]| *x >= 0.0 && *y >= 0.0 && *x <= 2.0 && *y <= 2.0 && (*x <= 1.0 || *y <= 1.0)), "{method}");
        let measures = json(&shell.ok(&format!("analyze {method}.txt --space l.txt --json")));
        assert!(measures["coverage_radius"].as_f64().unwrap() < 4.0, "{method}: {measures}");
    }
    shell.ok("generate -n 100 --space l.txt --method lloyd -q -o l.svg --draw voronoi,delaunay,points,valence,capacity");
    assert!(shell.read("l.svg").contains("<path"));
}

#[test]
fn the_record_names_the_polygon() {
    let shell = Shell::new();
    shell.write("l.txt", L);
    let record = json(&shell.ok("generate -n 100 --space l.txt --method push-pull --json -q -o points.txt"));
    assert_eq!(
        (&record["space"]["kind"], &record["space"]["n_corners"], &record["space"]["area"]),
        (&"polygon".into(), &6.into(), &3.0.into())
    );
}

#[test]
fn pins_stay_to_the_bit_and_come_first() {
    let shell = Shell::new();
    shell.write("l.txt", L);
    shell.write("pins.txt", "0.1 0.3\n1.7 0.2\n0.7 0.7000000000000001\n");
    for method in METHODS {
        shell.run(&format!("generate -n 150 --space l.txt --fixed pins.txt --method {method} -q -o {method}.txt"));
        let points = numbers(&shell.read(&format!("{method}.txt")));
        assert_eq!(points[..3], [[0.1, 0.3], [1.7, 0.2], [0.7, 0.7000000000000001]], "{method}");
        assert!(points.len() == 150 || method == "poisson-disk", "{method}: {}", points.len());
    }
    // What they share with the input is there once.
    shell.ok("optimize jittered.txt --space l.txt --fixed pins.txt --method lloyd -i 5 -q -o again.txt");
    let again = numbers(&shell.read("again.txt"));
    assert_eq!((again.len(), again[1]), (150, [1.7, 0.2]));
}

#[test]
fn what_cannot_be_is_said() {
    let shell = Shell::new();
    shell.write("l.txt", L);
    shell.write("pins.txt", "1.5 1.5\n");
    shell.write("twice.txt", "0.5 0.5\n0.5 0.5\n");
    for (arguments, told) in [
        ("generate -n 100 --space l.txt --fixed pins.txt -o a.txt", "outside the domain of the polygon"),
        ("generate -n 100 --space l.txt --fixed twice.txt -o a.txt", "have a place each"),
        ("generate -n 1 --space rect --fixed l.txt --size 2,2 -o a.txt", "6 points stay"),
        ("generate -n 100 --space l.txt --size 2,2 -o a.txt", "has its own"),
        ("generate -n 100 --space nowhere.txt -o a.txt", "no file of that name"),
        ("generate -n 100 --space l.txt --method hexagonal -o a.txt", "hexagonal lattice"),
        ("analyze pins.txt --space l.txt", "outside the domain of the polygon"),
        ("generate -n 100 --space - --fixed - -o a.txt", "stdin"),
    ] {
        let error = shell.refused(arguments);
        assert!(error.contains(told), "{arguments}: {error}");
    }
}
