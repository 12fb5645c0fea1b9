//! The command line with pictures: `--density`, and `stipple`.

use crate::shell;

use evenly::Image;
use evenly_io::{Target, write_image};
use serde_json::Value;
use shell::{Shell, json};

/// Writes a picture; grey for one channel, colour for three.
fn picture(shell: &Shell, name: &str, [width, height]: [usize; 2], n_channels: usize, value: impl Fn(f64, f64, usize) -> f64) {
    let at = |k: usize, n: usize| (k as f64 + 0.5) / n as f64;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (at(x, width), at(y, height))));
    let values = pixels.flat_map(|(x, y)| (0..n_channels).map(move |channel| (x, y, channel))).map(|(x, y, channel)| value(x, y, channel));
    let image = Image::new(width, height, n_channels, values.collect()).unwrap();
    write_image(&image, "", &Target::picture(&shell.path(name), true).unwrap()).unwrap();
}

/// Dark on the left, and a white disk in its middle.
fn photograph(x: f64, y: f64, _: usize) -> f64 {
    if (x - 0.5).hypot(y - 0.5) < 0.2 { 1.0 } else { 0.1 + 0.7 * x }
}

fn points(text: &str) -> Vec<[f64; 2]> {
    let line = |line: &str| {
        let mut numbers = line.split_whitespace().map(|number| number.parse().unwrap());
        [numbers.next().unwrap(), numbers.next().unwrap()]
    };
    text.lines().filter(|line| !line.starts_with('#')).map(line).collect()
}

#[test]
fn every_verb_of_points_goes_by_a_picture() {
    let shell = Shell::new();
    picture(&shell, "photo.png", [120, 80], 1, photograph);
    let space = "--space rect --size 3,2 --density photo.png:invert";
    for method in
        ["push-pull --preset fast", "procrustes", "poisson-disk", "white", "eliminate", "lloyd", "distmesh", "capacity", "well-spaced"]
    {
        let output = shell.run(&format!("generate -n 900 --method {method} {space} -o a.txt --force -q"));
        assert!(matches!(output.status.code(), Some(0 | 1)), "{method}: {}", String::from_utf8_lossy(&output.stderr));
        let measures = json(&shell.ok(&format!("analyze a.txt {space} --json")));
        let error = measures["density_error"].as_f64().unwrap();
        assert!(error < 0.15 && measures["cvt_energy"].is_null(), "{method}: {error}");
        let is_in_disk = |p: &&[f64; 2]| (p[0] / 3.0 - 0.5).hypot(p[1] / 2.0 - 0.5) < 0.19;
        assert!(!points(&shell.read("a.txt")).iter().any(|p| is_in_disk(&p)), "{method}");
    }
    shell.ok("generate -n 900 -q -o even.txt --space rect --size 3,2");
    let of = |file: &str| json(&shell.ok(&format!("analyze {file} {space} --json")))["density_error"].as_f64().unwrap();
    shell.ok(&format!("optimize even.txt --method procrustes {space} -q -o moved.txt"));
    assert!(of("even.txt") > 0.3 && of("moved.txt") < 0.1, "{} {}", of("even.txt"), of("moved.txt"));
    // Distances in the spacing of their place: no power spectrum, and a correlation that begins at 0.
    let spectrum = json(&shell.ok(&format!("analyze moved.txt {space} --spectrum --json --plot report.svg")));
    assert!(spectrum["pair_correlation"][10].as_f64().unwrap() < 0.05 && spectrum["ring_power"].is_null());
    // A floor leaves nothing empty; without an inversion, light counts.
    shell.ok("generate -n 500 --space rect --size 3,2 --density photo.png:invert,gamma=2,contrast=0.9,floor=0.2 -q -o floor.txt");
    shell.ok("generate -n 500 --space rect --size 3,2 --density photo.png -q -o light.txt");
    let left = |name: &str| points(&shell.read(name)).iter().filter(|p| p[0] < 1.0).count();
    assert!(left("floor.txt") > 200 && left("light.txt") < 150);
}

#[test]
fn a_drawing_has_its_dots_on_the_page_in_millimetres() {
    let shell = Shell::new();
    picture(&shell, "photo.png", [60, 40], 1, photograph);
    let said = shell.run("stipple photo.png -n 500 -o a.svg --preview --report a.json");
    let said = String::from_utf8(said.stderr).unwrap();
    assert!(said.contains("500 dots") && said.contains("297 x 210 mm") && said.contains("the pen goes"), "{said}");
    let svg = shell.read("a.svg");
    assert!(svg.contains("width=\"297mm\" height=\"210mm\" viewBox=\"0 0 297 210\"") && svg.contains("evenly stipple photo.png"));
    assert_eq!(svg.matches("h.01").count(), 500);
    // All on the picture: inside margins of 10 mm, and as high as its proportions have it.
    let places: Vec<[f64; 2]> = svg
        .split('M')
        .skip(1)
        .map(|part| {
            let (place, _) = part.split_once('h').unwrap();
            let (x, y) = place.split_once(' ').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect();
    let height = 277.0 * 40.0 / 60.0;
    let inside = |p: &[f64; 2]| (10.0..=287.0).contains(&p[0]) && (p[1] - 105.0).abs() <= 0.5 * height + 1e-3;
    assert!(places.len() == 500 && places.iter().all(inside));
    assert!(shell.files().contains(&"a.png".to_owned()));
    let report = json(&shell.read("a.json"));
    let layer = &report["layers"][0];
    assert!(layer["psnr_db"].as_f64().unwrap() > 25.0 && layer["ssim"].as_f64().unwrap() > 0.9, "{layer}");
    assert_eq!((report["n_points"].as_u64(), report["page_mm"][0].as_f64()), (Some(500), Some(297.0)));
    // The way of the pen is what was said, and shorter than without a tour.
    let way: f64 = places.windows(2).map(|step| (step[1][0] - step[0][0]).hypot(step[1][1] - step[0][1])).sum();
    assert!((way - report["pen_up_mm"].as_f64().unwrap()).abs() < 0.1);
    shell.ok("stipple photo.png -n 500 -o b.svg --order input --report b.json -q");
    assert!(json(&shell.read("b.json"))["pen_up_mm"].as_f64().unwrap() > 1.3 * way);
    // The points themselves are in pixels, and the same.
    shell.ok("stipple photo.png -n 500 -o c.txt -q");
    let dots = points(&shell.read("c.txt"));
    assert!(dots.len() == 500 && dots.iter().all(|p| p[0] <= 60.0 && p[1] <= 40.0));
    let mm = 277.0 / 60.0;
    assert!(dots.iter().zip(&places).all(|(dot, place)| (10.0 + dot[0] * mm - place[0]).abs() < 1e-3));
    let measures = json(&shell.ok("analyze c.txt --space rect --size 60,40 --density photo.png:invert --json"));
    assert!(measures["density_error"].as_f64().unwrap() < 0.1);
}

#[test]
fn drawings_come_in_all_styles_and_formats() {
    let shell = Shell::new();
    picture(&shell, "photo.png", [60, 40], 3, |x, y, channel| [x, y, 0.5][channel]);
    let svg = |flags: &str| {
        shell.ok(&format!("stipple photo.png -n 300 -q --force -o x.svg {flags}"));
        shell.read("x.svg")
    };
    assert_eq!(svg("--dots circle").matches("<circle").count(), 300);
    assert!(svg("--dots circle --sizes tone").matches("r=\"0.").count() + svg("--sizes tone").matches("stroke-width").count() > 20);
    assert!(svg("--pen 0.5mm").contains("stroke-width=\"0.5\"") && svg("--pen 1in --page 30x20cm").contains("stroke-width=\"25.4\""));
    let layers = svg("--layers cmyk");
    for name in ["1 cyan", "2 magenta", "3 yellow", "4 black"] {
        assert!(layers.contains(&format!("inkscape:label=\"{name}\"")), "{name}");
    }
    assert_eq!(layers.matches("h.01").count(), 300);
    assert!(svg("--edges delaunay").matches('L').count() > 700 && svg("--edges voronoi").matches('L').count() > 700);
    // The first dots of a progressive order are all over the picture.
    let first = svg("--order progressive")
        .split('M')
        .skip(1)
        .take(12)
        .map(|p| p.split(' ').next().unwrap().parse::<f64>().unwrap() > 148.5)
        .filter(|is| *is)
        .count();
    assert!((3..=9).contains(&first), "{first}");
    for method in ["lloyd", "procrustes", "poisson-disk", "eliminate", "white", "capacity", "well-spaced", "distmesh"] {
        assert_eq!(svg(&format!("--method {method}")).matches("h.01").count(), 300, "{method}");
    }
    for name in ["a.png", "a.pdf", "a.csv", "a.npy"] {
        shell.ok(&format!("stipple photo.png -n 200 -q -o {name}"));
        assert!(shell.path(name).metadata().unwrap().len() > 1000, "{name}");
    }
    assert!(shell.ok("stipple photo.png -n 50 -q -o - --format svg").contains("<svg"));
    // The same seed, the same drawing, on any number of threads.
    assert!(svg("-j 1") == svg("-j 2").replace("-j 2", "-j 1") && svg("--seed 1") != svg("--seed 2").replace("--seed 2", "--seed 1"));
}

#[test]
fn odd_pictures_are_drawn_or_refused() {
    let shell = Shell::new();
    picture(&shell, "black.png", [30, 20], 1, |_, _, _| 0.0);
    picture(&shell, "white.png", [30, 20], 1, |_, _, _| 1.0);
    picture(&shell, "pixel.png", [1, 1], 1, |_, _, _| 0.5);
    picture(&shell, "long.png", [10_000, 1], 1, |x, _, _| x);
    picture(&shell, "dot.png", [500, 500], 1, |x, y, _| if (x - 0.3).hypot(y - 0.7) < 0.002 { 0.0 } else { 1.0 });
    for name in ["black.png", "pixel.png", "long.png", "dot.png"] {
        for flags in ["", "--layers cmyk", "--order progressive", "--sizes tone", "--edges voronoi", "--method procrustes"] {
            shell.ok(&format!("stipple {name} -n 60 -q --force -o a.svg --report a.json {flags}"));
            let report: Value = json(&shell.read("a.json"));
            assert_eq!(report["n_points"], 60, "{name} {flags}");
            assert!(!shell.read("a.svg").contains("NaN"), "{name} {flags}");
        }
    }
    for n in [1, 2, 3] {
        shell.ok(&format!("stipple black.png -n {n} -q --force -o a.svg --report a.json"));
        assert_eq!(shell.read("a.svg").matches("h.01").count(), n);
    }
    let whole = std::fs::read(shell.path("black.png")).unwrap();
    shell.write("cut.png", &whole[..whole.len() / 2]);
    shell.write("text.png", "no picture");
    shell.write("moving.gif", b"GIF89a\x01\x00\x01\x00\x80\x00\x00");
    for (line, reason) in [
        ("stipple white.png -o a.txt", "no place for points"),
        ("stipple cut.png -o b.svg", "cut.png: not a readable PNG"),
        ("stipple text.png -o b.svg", "text.png: not a readable PNG"),
        ("stipple moving.gif -o b.svg", "moving.gif: not a readable PNG"),
        ("stipple none.png -o b.svg", "No such file"),
        ("stipple black.png -o b.svg --page 20x20mm", "no room inside margins"),
        ("stipple black.png -o b.svg --page a9", "--page a9"),
        ("stipple black.png -o b.svg --pen 0", "--pen is 0"),
        ("stipple black.png -o b.svg --pen 1e-9", "0.001 mm or more"),
        ("stipple black.png -o b.svg --pen wide", "must be a length"),
        ("stipple black.png -o b.svg --gamma 0", "--gamma is 0"),
        ("stipple black.png -o b.svg --floor 2", "--floor is 2"),
        ("stipple black.png -o b.svg -n 0", "whole number"),
        ("stipple black.png -o b.svg -i 0", "--iterations is 0"),
        ("stipple black.png -o b.svg --method opt-beta", "opt-beta"),
        ("stipple black.png -o b.svg -n 2 --edges voronoi", "edges take 3 dots"),
        ("stipple black.png -o b.png --preview", "files of their own"),
        ("stipple black.png -o b.svg --report b.svg", "files of their own"),
        ("stipple black.png -o - --preview", "stdout"),
        ("stipple black.png -o white.png", "exists already"),
        ("stipple black.png -o ./black.png --force", "files of their own"),
        ("stipple black.png -o black.svg --preview --force", "files of their own"),
        ("generate -n 9 -o b.txt --density white.png:invert=no", "invert takes no value"),
        ("generate -n 9 -o b.txt --density white.png:gamma=2,gamma=3", "there twice"),
        ("generate -n 9 -o b.txt --density white.png:inverted", "is none of invert"),
        ("generate -n 9 -o b.txt --density white.png:invert", "no place for points"),
        ("generate -n 9 -o b.txt --density black.png", "no place for points"),
        ("generate -n 9 -o b.txt --density white.png:gamma=x", "gamma"),
        ("generate -n 9 -o b.txt --density none.png:invert", "none.png: No such file"),
        ("generate -n 9 -o b.txt --density white.png --method opt-beta", "--density is for --method"),
        ("generate -n 9 -o b.txt --density white.png --start jittered", "goes by no density"),
        ("generate --spacing 0.1 --coverage 0.2 --method poisson-disk -o b.txt --density white.png", "--coverage"),
        ("optimize - -o b.txt --density -", "read once"),
    ] {
        let said = shell.refused(line);
        assert!(said.contains(reason), "{line}: {said}");
    }
}

#[test]
fn what_is_lighter_than_white_stays_empty_and_ink_that_cannot_be_is_told() {
    let shell = Shell::new();
    picture(&shell, "p.png", [60, 40], 1, photograph);
    for flags in ["", "--floor 0.5", "--contrast 0.5"] {
        shell.ok(&format!("stipple p.png -n 400 --white 0.7 {flags} -o dots.txt --force"));
        let dots = points(&shell.read("dots.txt"));
        let is_light = |x: f64, y: f64| photograph((x.floor() + 0.5) / 60.0, (y.floor() + 0.5) / 40.0, 0) > 0.71;
        assert_eq!((dots.len(), dots.iter().filter(|[x, y]| is_light(*x, *y)).count()), (400, 0), "{flags}");
    }
    assert!(shell.refused("stipple p.png -n 9 --white 0 -o out.svg").contains("--white is 0"));

    let said = |flags: &str| String::from_utf8(shell.run(&format!("stipple p.png -n 400 {flags} -o d.svg --force")).stderr).unwrap();
    let told = said("--pen 0.1mm");
    assert!(told.contains("% of the picture's darkness") && told.contains("dots would have all of it, or a pen of"), "{told}");
    // Then it has.
    let pen = told.rsplit("a pen of ").next().unwrap().trim().replace(' ', "");
    assert!(!said(&format!("--pen {pen}")).contains("darkness"));
}

#[test]
fn a_method_is_compared_with_itself_under_other_parameters_and_by_a_density() {
    let shell = Shell::new();
    let line = "compare -n 200 --runs 1 --methods white --method push-pull:preset=fast --method push-pull:min-distance=0.9,coverage-radius=0.65 -q";
    let table = shell.ok(&format!("{line} -o t.csv")) + &shell.read("t.csv");
    for label in ["white", "push-pull:preset=fast", "push-pull:min-distance=0.9"] {
        assert!(table.contains(label), "{table}");
    }
    picture(&shell, "ramp.png", [60, 30], 1, photograph);
    let table = shell.ok("compare -n 200 --runs 1 --density ramp.png --size 2,1 -q");
    assert!(table.contains("push-pull") && table.contains("density_error") && !table.contains("hexagonal"), "{table}");
    for wrong in ["--method lloyd:beta=1", "--method push-pull:min-distance", "--methods dart --density ramp.png", "--method none"] {
        shell.refused(&format!("compare -n 200 {wrong}"));
    }
}
