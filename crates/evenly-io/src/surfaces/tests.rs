//! What is written is read back, and what is broken is told.

mod any;

use evenly::Attribute;

use super::*;
use crate::MeshFormat;

const CUBE: &str = "# a cube\r\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    vt 0 0\nvn 0 0 1\nf 1/1/1 4/1/1 3//1 2\nf -4 -3 -2 \\\n -1\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

fn parse_text(kind: Kind, text: &str) -> TrianglesRead {
    parse(kind, "m", text.as_bytes(), Path::new("")).unwrap()
}

fn message(kind: Kind, bytes: impl AsRef<[u8]>) -> String {
    parse(kind, "m", bytes.as_ref(), Path::new("")).unwrap_err().to_string()
}

fn written(mesh: &TriangleMesh, format: MeshFormat) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh");
    write_triangles(mesh, format, "a\nrecipe", &Target::any(&path, false).unwrap()).unwrap();
    std::fs::read(path).unwrap()
}

fn cube() -> TriangleMesh {
    parse_text(Kind::Obj, CUBE).mesh
}

/// A tetrahedron in glTF, its bytes in its text, put elsewhere by two nodes.
fn gltf(node: &str) -> String {
    use base64::Engine as _;
    let mut bytes: Vec<u8> = [0f32, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.].iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]);
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1],"translation":[1,2,3]}},{{"mesh":0{node}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}},{{"attributes":{{"POSITION":0}},"mode":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},{{"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":12}}],
        "buffers":[{{"byteLength":60,"uri":"data:application/octet-stream;base64,{data}"}}]}}"#
    )
}

fn volume(mesh: &TriangleMesh) -> f64 {
    let det = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    mesh.triangles.iter().map(|t| det(t.map(|v| mesh.vertices[v]))).sum::<f64>() / 6.0
}

#[test]
fn a_cube_of_squares_is_cut_and_that_is_said() {
    let TrianglesRead { mesh, notes } = parse_text(Kind::Obj, CUBE);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    assert!((volume(&mesh) - 1.0).abs() < 1e-12);
    assert_eq!(notes, ["6 polygons with more than three corners were cut into triangles"]);
}

#[test]
fn all_kinds_of_off_are_read() {
    let expected = vec![[0.1, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1e-3, 0.0]];
    for text in [
        "OFF\n3 1 0\n0.1 0 0\n1 0 0\n0 1e-3 0\n3 0 1 2\n",
        "OFF 3 1\n\n0.1 0 0\n1 0 0\n0 1e-3 0\n3 0 1 2 255 0 0",
        "# c\nCOFF\n# c\n3 1 3\n0.1 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 .001 0 0 0 0 0 # c\n3  0 1 2  0.5 0.5 0.5\n",
        "NOFF\r\n3 1 3\r\n0.1 0 0 0 0 1\r\n1 0 0 0 0 1\r\n0 1E-3 0 0 0 1\r\n3 0 1 2\r\n",
    ] {
        let read = parse_text(Kind::Off, text);
        assert_eq!((read.mesh.vertices, read.mesh.triangles), (expected.clone(), vec![[0, 1, 2]]), "{text}");
    }
}

#[test]
fn colours_of_obj_are_attributes() {
    let mesh = parse_text(Kind::Obj, "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 0\nv 0 1 0 1 1 0.25\nf 1 2 3\n").mesh;
    let attributes: Vec<(&str, &[f64])> = mesh.attributes.iter().map(|a| (a.name.as_str(), a.values.as_slice())).collect();
    assert_eq!(attributes, [("red", &[255.0, 0.0, 255.0][..]), ("green", &[127.5, 0.0, 255.0]), ("blue", &[0.0, 0.0, 63.75])]);
    assert!(parse_text(Kind::Obj, "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0\nf 1 2 3\n").mesh.attributes.is_empty());
}

#[test]
fn binary_ply_is_read_either_way_round() {
    for is_big in [false, true] {
        let name = if is_big { "big" } else { "little" };
        let mut bytes = format!(
            "ply\nformat binary_{name}_endian 1.0\nelement junk 2\nproperty list uchar short s\nelement vertex 4\nproperty double x\nproperty float y\n\
             property uchar red\nproperty double z\nelement face 1\nproperty uchar flag\nproperty list uchar int vertex_index\nend_header\n"
        )
        .into_bytes();
        let mut push = |number: &[u8]| bytes.extend(if is_big { number.iter().rev().copied().collect() } else { number.to_vec() });
        for byte in [&[2][..], &[1, 0], &[2, 0], &[0]] {
            push(byte);
        }
        for v in 0..4u8 {
            push(&(0.1 * f64::from(v)).to_le_bytes());
            push(&(v as f32).to_le_bytes());
            push(&[200 + v]);
            push(&f64::MIN_POSITIVE.to_le_bytes());
        }
        push(&[7]);
        push(&[4]);
        (0..4i32).for_each(|v| push(&v.to_le_bytes()));
        let read = parse(Kind::Ply, "m", &bytes, Path::new("")).unwrap();
        assert_eq!(read.mesh.vertices[3], [0.1 * 3.0, 3.0, f64::MIN_POSITIVE]);
        assert_eq!(read.mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(read.mesh.attributes, [Attribute { name: "red".into(), values: vec![200.0, 201.0, 202.0, 203.0] }]);
        assert_eq!(message(Kind::Ply, &bytes[..bytes.len() - 1]), "m, face 1: the file ends within it");
    }
}

#[test]
fn stl_as_text_is_welded() {
    let facet = |a: &str, b: &str, c: &str| {
        format!(" facet normal 0 0 0\n  outer loop\n   vertex {a}\n   vertex {b}\n   vertex {c}\n  endloop\n endfacet\n")
    };
    let text = format!("solid\n{}{}endsolid\n", facet("0 0 0", "1 0 0", "0 1 0"), facet("1 0 0", "1 1 0", "-0 1e0 0"));
    let mesh = parse_text(Kind::Stl, &text).mesh;
    assert_eq!(mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(message(Kind::Stl, "solid\nfacet\nvertex 0 0 nan\n"), "m:3: NaN is not a finite number");
    assert!(message(Kind::Stl, text.replace("endsolid\n", "")).ends_with("but there should be endsolid"));
}

#[test]
fn nodes_of_gltf_put_meshes_where_they_belong() {
    let plain = parse_text(Kind::Gltf, &gltf(""));
    assert_eq!(plain.notes, ["1 part of points or lines was left out"]);
    assert_eq!(plain.mesh.vertices[3], [1.0, 2.0, 4.0]);
    assert!((volume(&plain.mesh) - 1.0 / 6.0).abs() < 1e-12);
    // A quarter turn about z takes x to y; what is mirrored keeps its outside.
    let turned = parse_text(Kind::Gltf, &gltf(r#","rotation":[0,0,0.70710678,0.70710678],"scale":[-2,1,1]"#)).mesh;
    assert!((turned.vertices[1][1] - 0.0).abs() < 1e-6 && (volume(&turned) - 2.0 / 6.0).abs() < 1e-6, "{turned:?}");
    let moved = parse_text(Kind::Gltf, &gltf(r#","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]"#)).mesh;
    assert_eq!(moved.vertices[0], [6.0, 8.0, 10.0]);
}

#[test]
fn broken_gltf_is_told() {
    let broken = |from: &str, to: &str| message(Kind::Gltf, gltf("").replace(from, to));
    assert!(broken(r#""children":[1]"#, r#""children":[0]"#).contains("no tree"));
    assert!(broken(r#""mesh":0"#, r#""mesh":9"#).contains("no mesh 9"));
    assert!(broken(r#""count":12"#, r#""count":13"#).contains("should take 13 bytes"));
    assert!(broken(r#""count":4"#, r#""count":3"#).contains("vertex 3"));
    assert!(broken(r#""count":4"#, r#""count":18446744073709551615"#).contains("should take"));
    assert!(broken("data:application/octet-stream;base64,", "../secret?").contains("not beside the file"));
    assert!(broken(r#""asset""#, r#""extensionsRequired":["KHR_draco_mesh_compression"],"asset""#).contains("without compression"));
    assert!(message(Kind::Gltf, b"glTF\x02\0\0\0\x01\0\0\0").contains("cut short"));
}

#[test]
fn gltf_reads_buffers_beside_it_and_in_binary() {
    use base64::Engine as _;
    let text = gltf("");
    let (before, rest) = text.split_once("data:").unwrap();
    let (data, after) = rest.split_once('"').unwrap();
    let bytes = base64::engine::general_purpose::STANDARD.decode(data.split_once(',').unwrap().1).unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a b.bin"), &bytes).unwrap();
    let path = folder.path().join("m.gltf");
    std::fs::write(&path, format!("{before}a%20b.bin\"{after}")).unwrap();
    let expected = parse_text(Kind::Gltf, &text);
    assert_eq!(read_triangles(&path).unwrap(), expected);
    let json = format!("{before}\"{after}").replace(r#","uri":"""#, "");
    let chunk = |kind: &[u8; 4], bytes: &[u8], filler: u8| {
        let mut padded = bytes.to_vec();
        padded.resize(bytes.len().next_multiple_of(4), filler);
        [&(padded.len() as u32).to_le_bytes(), &kind[..], &padded].concat()
    };
    let chunks = [chunk(b"JSON", json.as_bytes(), b' '), chunk(b"BIN\0", &bytes, 0)].concat();
    let whole = [&b"glTF\x02\0\0\0"[..], &(chunks.len() as u32 + 12).to_le_bytes(), &chunks].concat();
    std::fs::write(&path, &whole).unwrap();
    assert_eq!(read_triangles(&path).unwrap(), expected);
    for length in 0..whole.len() {
        assert!(parse(Kind::Gltf, "m", &whole[..length], Path::new("")).is_err());
    }
}

#[test]
fn what_cannot_be_read_is_named() {
    assert_eq!(message(Kind::Obj, "v 0 0 0\nv 0 0\n"), "m:2: the line ends where there should be z");
    assert_eq!(message(Kind::Obj, "v 0 0 inf\nf 1 1 1\n"), "m:1: the position (0, 0, inf) is not finite");
    assert_eq!(message(Kind::Obj, "v 0 \\\n x 0\n"), "m:1: 'x' is not a number");
    assert_eq!(message(Kind::Obj, "v 0 0 0\n\nf 1 2 3\n"), "m:3: a face has vertex 1 (counted from 0), but there are only 1");
    assert_eq!(message(Kind::Obj, "v 0 0 0\nf 1 0 1\n"), "m:2: a face has vertex 0, but vertices are counted from 1");
    assert_eq!(message(Kind::Obj, "v 0 0 0\nf 1 -2 1\n"), "m:2: a face has vertex -2, but there are only 1 before it");
    assert_eq!(message(Kind::Obj, "v 0 0 0\nf 1 1\n"), "m:2: a face of 2 corners, expected three or more");
    assert_eq!(message(Kind::Obj, "v 0 0 0\n"), "m: it has no triangles");
    assert_eq!(message(Kind::Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n"), "m:4: the file ends here, but there should be vertex 3 of 3");
    assert_eq!(message(Kind::Off, "OFF\n1 1 0\n0 0 0\n3 0 0 9\n"), "m:4: a face has vertex 9 (counted from 0), but there are only 1");
    assert_eq!(message(Kind::Off, "OFF\n1 1 0\n0 0 0\n3 0 0\n"), "m:4: the line ends where there should be a corner");
    assert_eq!(message(Kind::Off, "PLY\n"), "m:1: it begins with 'PLY', expected OFF, COFF or NOFF");
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    assert_eq!(message(Kind::Ply, format!("{ply}0 0 NaN\n3 0 0 0\n")), "m:10: the position (0, 0, NaN) is not finite");
    assert_eq!(message(Kind::Ply, format!("{ply}0 0 0\n3 0 -1 0\n")), "m:11: a corner is -1, expected a whole number from 0");
    assert_eq!(message(Kind::Ply, format!("{ply}0 0 0\n")), "m:10: the file ends here, but there should be face 1 of 1");
    assert_eq!(message(Kind::Ply, ply.replace("property float z\n", "") + "0 0\n3 0 0 0\n"), "m: its vertices have no z");
    assert_eq!(message(Kind::Stl, [1; 100]), "m: its head promises 16843009 triangles, but there are 0");
    let huge = ply.replace("vertex 1", "junk 99999999999999\nelement vertex 1");
    assert!(parse(Kind::Ply, "m", (huge + "0 0 0\n3 0 0 0\n").as_bytes(), Path::new("")).is_ok());
}

fn area(mesh: &TriangleMesh) -> f64 {
    let of = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|v| mesh.vertices[v]);
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        0.5 * n.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    mesh.triangles.iter().map(of).sum()
}

#[test]
fn polygons_are_cut_as_they_are_from_any_first_corner() {
    // An L, and a comb with corners on one line, upright and oblique.
    let l = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]];
    let comb = [[0, 0], [1, 0], [2, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1, 1], [1, 2], [0, 2]];
    for ring in [&l[..], &comb[..]] {
        for [p, q] in [[0, 0], [1, 2]] {
            let vertices: String = ring.iter().map(|[x, y]| format!("v {x} {y} {}\n", p * x + q * y)).collect();
            let expected = 5.0 * f64::from(1 + p * p + q * q).sqrt();
            let cut = |first: usize, step: usize| {
                let corners: String = (0..ring.len()).map(|k| format!(" {}", (first + k * step) % ring.len() + 1)).collect();
                let TrianglesRead { mesh, notes } = parse_text(Kind::Obj, &format!("{vertices}f{corners}\n"));
                assert_eq!((mesh.triangles.len(), notes.len()), (ring.len() - 2, 1), "{notes:?}");
                assert!((area(&mesh) - expected).abs() < 1e-12, "{}", area(&mesh));
                mesh.triangles
            };
            let once = cut(0, 1);
            (1..ring.len()).for_each(|first| assert_eq!(cut(first, 1), once));
            cut(0, ring.len() - 1);
        }
    }
    let crossing = parse_text(Kind::Off, "OFF\n4 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1.5 0\n4 0 1 2 3\n");
    assert_eq!(crossing.notes[1], "1 polygon is not simple and cut from one corner, the first at m:7");
    let bent = parse_text(Kind::Off, "OFF\n4 1 0\n0 0 0\n1 0 1\n1 1 0\n0 1 1\n4 0 1 2 3\n");
    assert_eq!(bent.notes[1], "1 polygon is far from flat, the first at m:7");
}

#[test]
fn a_face_of_many_corners_is_cut() {
    let n = 50_000;
    let place = |k: usize| (k as f64 * std::f64::consts::TAU / n as f64).sin_cos();
    let vertices: String = (0..n).map(place).map(|(y, x)| format!("v {x} {y} 0\n")).collect();
    let corners: String = (1..=n).map(|k| format!(" {k}")).collect();
    let mesh = parse_text(Kind::Obj, &format!("{vertices}f{corners}\n")).mesh;
    assert!((area(&mesh) - std::f64::consts::PI).abs() < 1e-7);
}

#[test]
fn what_writers_leave_is_read() {
    let three = vec![[0, 1, 2]];
    assert_eq!(parse_text(Kind::Off, "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").mesh.triangles, three);
    let stl = "\u{feff}solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    for text in [stl.to_owned(), stl.replace('\n', "\r")] {
        assert_eq!(parse_text(Kind::Stl, &text).mesh.triangles, three);
    }
    let wide: Vec<u8> = stl.encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(parse(Kind::Stl, "m", &wide, Path::new("")).unwrap().mesh.triangles, three);
    // Vertices of no face may be nowhere.
    let odd = parse_text(Kind::Obj, "v 0 0 0\nv nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 4\n");
    assert_eq!((odd.mesh.vertices.len(), odd.mesh.triangles), (3, three));
    assert_eq!(odd.notes, ["1 vertex without a finite position, of no face, was left out"]);
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    let strips = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    assert_eq!(parse_text(Kind::Ply, &format!("{head}{strips}4 0 1 2 3\n")).mesh.triangles, [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(parse_text(Kind::Ply, &format!("{head}{strips}7 0 1 2 -1 1 3 2\n")).mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
    assert!(message(Kind::Ply, head.replace("ascii 1.0", "ascii 2.0")).contains("version 2.0 of PLY"));
}

#[test]
fn colours_go_out_as_bytes_and_come_back() {
    let mut mesh = cube();
    let colours = (0..8).map(|k| f64::from(k) * 36.4);
    mesh.attributes = vec![Attribute { name: "red".into(), values: colours.clone().collect() }];
    for format in [MeshFormat::Ply, MeshFormat::PlyText] {
        let bytes = written(&mesh, format);
        assert!(String::from_utf8_lossy(&bytes).contains("property uchar red\n"));
        let read = parse(Kind::Ply, "m", &bytes, Path::new("")).unwrap().mesh;
        assert_eq!((&read.vertices, &read.triangles), (&mesh.vertices, &mesh.triangles));
        assert_eq!(read.attributes[0].values, colours.clone().map(f64::round).collect::<Vec<_>>());
    }
}

#[test]
fn extensions_of_gltf_are_read_or_named() {
    let required = |name: &str| gltf("").replacen('{', &format!("{{\"extensionsRequired\":[\"{name}\"],"), 1);
    assert!(message(Kind::Gltf, required("ACME_secret")).contains("it needs the extension ACME_secret"));
    parse_text(Kind::Gltf, &required("KHR_materials_unlit"));
    assert!(message(Kind::Gltf, gltf("").replace("\"2.0\"", "\"1.0\"")).contains("glTF 1.0"));
}

#[test]
fn single_precision_is_told() {
    let mut mesh = cube();
    assert_eq!(stl_rounding(&mesh), None);
    mesh.vertices.iter_mut().for_each(|p| p[0] += 5e8);
    assert!(stl_rounding(&mesh).unwrap().contains("lose their area"));
    mesh.vertices[0][0] = 1e39;
    let folder = tempfile::tempdir().unwrap();
    let target = Target::any(&folder.path().join("m"), false).unwrap();
    assert!(write_triangles(&mesh, MeshFormat::Stl, "", &target).unwrap_err().to_string().contains("3.4e38"));
}

#[test]
fn the_first_bytes_tell_where_the_ending_does_not() {
    let mesh = cube();
    for (format, kind) in
        [(MeshFormat::Obj, Kind::Obj), (MeshFormat::Ply, Kind::Ply), (MeshFormat::Off, Kind::Off), (MeshFormat::Stl, Kind::Stl)]
    {
        assert_eq!(evident(&written(&mesh, format)), Some(kind));
    }
    assert_eq!(evident(gltf("").as_bytes()), Some(Kind::Gltf));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.xyz");
    std::fs::write(&path, "1 2 3\n").unwrap();
    assert!(read_triangles(&path).unwrap_err().to_string().contains("use one of .obj .ply .stl .off .gltf .glb"));
}

#[test]
fn every_format_is_written_but_maps() {
    let mut mesh = cube();
    mesh.attributes = vec![Attribute { name: "heat of all".into(), values: (0..8).map(f64::from).collect() }];
    for (name, format) in MeshFormat::ALL {
        let folder = tempfile::tempdir().unwrap();
        let target = Target::any(&folder.path().join("m"), false).unwrap();
        assert_eq!(write_triangles(&mesh, format, "recipe", &target).is_ok(), format != MeshFormat::GeoJson, "{name}");
    }
    let text = String::from_utf8(written(&mesh, MeshFormat::Vtu)).unwrap();
    assert!(text.contains("<PointData>") && text.contains("Name=\"heat_of_all\"") && !text.contains("tag"));
    let read = parse(Kind::Ply, "m", &written(&mesh, MeshFormat::Ply), Path::new("")).unwrap().mesh;
    assert_eq!((read.attributes[0].name.as_str(), &read.attributes[0].values), ("heat_of_all", &mesh.attributes[0].values));
    let folder = tempfile::tempdir().unwrap();
    let target = Target::any(&folder.path().join("m"), false).unwrap();
    mesh.attributes[0].values.pop();
    assert!(write_triangles(&mesh, MeshFormat::Ply, "", &target).is_err());
    mesh.triangles[3][1] = 8;
    assert!(write_triangles(&mesh, MeshFormat::Obj, "", &target).unwrap_err().to_string().contains("triangle 3"));
}

#[test]
fn meshes_of_gmsh_2_have_triangles_and_quadrangles() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n7 0 1 0\n9 0.5 0.5 1\n$EndNodes\n\
                $Elements\n4\n1 15 2 0 1 1\n2 3 2 0 1 1 2 3 7\n3 2 2 0 1 1 2 9\n4 4 2 0 1 1 2 3 9\n$EndElements\n";
    let read = parse(Kind::Msh, "m.msh", text.as_bytes(), Path::new("")).unwrap();
    assert_eq!((read.mesh.vertices.len(), read.mesh.triangles.len()), (5, 3));
    assert!(read.notes.iter().any(|note| note.starts_with("1 elements of three dimensions")), "{:?}", read.notes);
    for (from, to, expected) in [
        ("2.2 0", "2.2 1", "it is binary"),
        ("2.2 0", "3 0", "its version is 3"),
        ("$Nodes", "$Knots", "no section $Nodes"),
        ("3 2 2 0 1 1 2 9", "3 2 2 0 1 1 2 8", "element 3 has node 8"),
        ("4 4 2", "4 99 2", "of kind 99"),
    ] {
        let error = parse(Kind::Msh, "m.msh", text.replace(from, to).as_bytes(), Path::new("")).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}

/// As other programs write it: in place, in 64 bits and 32, plain and compressed.
#[test]
fn vtk_data_in_place_are_read() {
    use base64::Engine as _;
    use base64::prelude::BASE64_STANDARD as BASE64;
    use std::io::Write as _;
    let plain = |bytes: &[u8]| BASE64.encode([&(bytes.len() as u32).to_le_bytes()[..], bytes].concat());
    let packed = |bytes: &[u8]| {
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        encoder.write_all(bytes).unwrap();
        let block = encoder.finish().unwrap();
        let header = [1, bytes.len() as u32, bytes.len() as u32, block.len() as u32].map(u32::to_le_bytes).concat();
        BASE64.encode(header) + &BASE64.encode(block)
    };
    let points: Vec<u8> = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]].iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let corners: Vec<u8> = [0i64, 1, 2].iter().flat_map(|x| x.to_le_bytes()).collect();
    let file = |coded: &dyn Fn(&[u8]) -> String, compressor: &str| {
        let array = |kind: &str, name: &str, bytes: &[u8]| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"3\" format=\"binary\">\n{}\n</DataArray>",
                coded(bytes)
            )
        };
        format!(
            "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" {compressor}><UnstructuredGrid><Piece><Points>{}</Points><Cells>{}{}{}</Cells></Piece></UnstructuredGrid></VTKFile>",
            array("Float32", "Points", &points),
            array("Int64", "connectivity", &corners),
            array("Int64", "offsets", &3i64.to_le_bytes()),
            array("UInt8", "types", &[5])
        )
    };
    for text in [file(&plain, ""), file(&packed, "compressor=\"vtkZLibDataCompressor\"")] {
        let mesh = parse(Kind::Vtu, "m.vtu", text.as_bytes(), Path::new("")).unwrap().mesh;
        assert_eq!((mesh.triangles, mesh.vertices[2]), (vec![[0, 1, 2]], [0.0, 1.0, 0.5]));
    }
    for (text, expected) in [
        (file(&plain, "compressor=\"vtkLZ4DataCompressor\""), "compressed by vtkLZ4DataCompressor"),
        (file(&plain, "").replace("format=\"binary\"", "format=\"appended\""), "with the data in place"),
        (file(&plain, "").replace("UnstructuredGrid\"", "PolyData\""), "expected UnstructuredGrid"),
        (file(&plain, "").replace("Float32", "Float16"), "of type \"Float16\""),
    ] {
        let error = parse(Kind::Vtu, "m.vtu", text.as_bytes(), Path::new("")).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}
