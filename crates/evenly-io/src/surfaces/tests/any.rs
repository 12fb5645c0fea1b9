//! Meshes of any numbers, and files of any bytes.

use proptest::prelude::*;

use super::*;

/// A mesh of any numbers.
fn any_mesh() -> impl Strategy<Value = TriangleMesh> {
    let number = || prop_oneof![proptest::num::f64::NORMAL, proptest::num::f64::SUBNORMAL, -2.0..2.0f64, Just(-0.0)];
    let vertices = proptest::collection::vec([number(), number(), number()], 1..20);
    let triangles = proptest::collection::vec([any::<usize>(), any::<usize>(), any::<usize>()], 1..20);
    (vertices, triangles, number()).prop_map(|(vertices, triangles, value)| {
        let n = vertices.len();
        let attributes = vec![Attribute { name: "value".into(), values: vec![value; n] }];
        TriangleMesh { vertices, triangles: triangles.into_iter().map(|t| t.map(|v| v % n)).collect(), attributes }
    })
}

fn bits(mesh: &TriangleMesh) -> Vec<[u64; 3]> {
    mesh.vertices.iter().map(|p| p.map(f64::to_bits)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    #[test]
    fn what_is_written_is_read_back_to_the_last_bit(mesh in any_mesh()) {
        for (format, kind) in [
            (MeshFormat::Obj, Kind::Obj),
            (MeshFormat::Ply, Kind::Ply),
            (MeshFormat::Off, Kind::Off),
            (MeshFormat::Msh, Kind::Msh),
            (MeshFormat::Vtu, Kind::Vtu),
            (MeshFormat::Npz, Kind::Npz),
        ] {
            let read = parse(kind, "m", &written(&mesh, format), Path::new("")).unwrap();
            prop_assert_eq!(bits(&read.mesh), bits(&mesh));
            prop_assert_eq!(&read.mesh.triangles, &mesh.triangles);
            prop_assert!(read.notes.is_empty());
            if kind == Kind::Ply {
                prop_assert_eq!(&read.mesh.attributes, &mesh.attributes);
            }
        }
    }

    #[test]
    fn stl_keeps_single_precision(mut mesh in any_mesh()) {
        for x in mesh.vertices.iter_mut().flatten() {
            *x = f64::from(x.clamp(-1e30, 1e30) as f32);
        }
        let read = parse(Kind::Stl, "m", &written(&mesh, MeshFormat::Stl), Path::new("")).unwrap().mesh;
        let corners = |mesh: &TriangleMesh| mesh.triangles.iter().map(|t| t.map(|v| mesh.vertices[v])).collect::<Vec<_>>();
        prop_assert_eq!(corners(&read), corners(&mesh));
    }

    #[test]
    fn nothing_makes_a_reader_fall(
        kind in prop::sample::select(vec![Kind::Obj, Kind::Ply, Kind::Stl, Kind::Off, Kind::Gltf, Kind::Msh, Kind::Vtu, Kind::Npz]),
        bytes in proptest::collection::vec(any::<u8>(), 0..200),
        words in "(v|f|OFF|ply|solid|vertex|element|property|list|int|end_header|format|ascii|[0-9.eE/\\\\-]{1,4}|[ \n]){0,60}",
        cut in 0.0..1.0f64,
        at in 0.0..1.0f64,
    ) {
        let _ = parse(kind, "m", &bytes, Path::new(""));
        let _ = parse(kind, "m", words.as_bytes(), Path::new(""));
        let mut whole = match kind {
            Kind::Obj => CUBE.as_bytes().to_vec(),
            Kind::Ply => written(&cube(), MeshFormat::Ply),
            Kind::Stl => written(&cube(), MeshFormat::Stl),
            Kind::Off => written(&cube(), MeshFormat::Off),
            Kind::Gltf => gltf(r#","scale":[1,2,3]"#).into_bytes(),
            Kind::Msh => written(&cube(), MeshFormat::Msh),
            Kind::Vtu => written(&cube(), MeshFormat::Vtu),
            Kind::Npz => written(&cube(), MeshFormat::Npz),
        };
        // Some bytes changed, then cut.
        for (k, &byte) in bytes.iter().take(3).enumerate() {
            let place = (at * whole.len() as f64) as usize + k;
            if let Some(old) = whole.get_mut(place) {
                *old = byte;
            }
        }
        let _ = parse(kind, "m", &whole, Path::new(""));
        whole.truncate((cut * whole.len() as f64) as usize);
        let _ = parse(kind, "m", &whole, Path::new(""));
    }

    #[test]
    fn any_mesh_is_drawn(mesh in any_mesh()) {
        let svg = triangles_svg(&mesh);
        prop_assert!(!svg.contains("NaN") && !svg.contains("inf"));
        crate::rendered(&svg).unwrap();
    }
}
