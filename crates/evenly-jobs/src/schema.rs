//! The schema of requests: docs/request.schema.json is what these types say.

use std::borrow::Cow;

use evenly::{Method, ParameterKind, Unit};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::{
    CompareRequest, Domain, DrawOrder, GenerateRequest, InkTone, Layers, MeshRequest, Metric, OptimizeRequest, OrOff, RemeshRequest,
    Request, Resource, SampleRequest, StippleRequest,
};

/// A method of the registry.
pub struct MethodName;

impl JsonSchema for MethodName {
    fn schema_name() -> Cow<'static, str> {
        "Method".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let named = |method: Method| json!({ "const": method.name(), "description": method.title() });
        json_schema!({ "oneOf": Method::all().map(named).collect::<Vec<Value>>() })
    }
}

/// What methods are told: all parameters of the registry.
pub struct Parameters;

impl JsonSchema for Parameters {
    fn schema_name() -> Cow<'static, str> {
        "Parameters".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut all = Map::new();
        for (about, _) in Method::all().flat_map(|method| method.parameters()) {
            let mut numbers = vec![json!({ "type": "number" })];
            if about.unit != Unit::None {
                numbers.push(json!({ "type": "string", "pattern": "^[-+0-9.eE]+u$", "description": "a length in input units" }));
            }
            if about.kind == ParameterKind::Target {
                numbers.extend([json!({ "const": "off" }), json!({ "type": "null" })]);
            }
            let value = match about.kind {
                ParameterKind::Number | ParameterKind::Target => json!({ "anyOf": numbers }),
                ParameterKind::Count => json!({ "type": "integer", "minimum": 1 }),
                ParameterKind::Flag => json!({ "type": "boolean" }),
                ParameterKind::Choice(choices) => json!({ "enum": choices.iter().map(|choice| choice.name).collect::<Vec<_>>() }),
            };
            all.entry(about.name).or_insert(value);
        }
        json_schema!({ "type": "object", "properties": all, "additionalProperties": false })
    }
}

/// A number, or `"off"`.
pub struct NumberOrOff;

impl JsonSchema for NumberOrOff {
    fn schema_name() -> Cow<'static, str> {
        "NumberOrOff".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "number" }, { "const": "off" }] })
    }
}

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/request.schema.json");

/// `EVENLY_WRITE_SCHEMA=1` writes it.
#[test]
fn the_schema_in_the_docs_is_that_of_the_types() {
    let schema = serde_json::to_string_pretty(&schemars::schema_for!(Request)).unwrap() + "\n";
    if std::env::var_os("EVENLY_WRITE_SCHEMA").is_some() {
        std::fs::write(FILE, &schema).unwrap();
    }
    assert!(std::fs::read_to_string(FILE).unwrap() == schema, "docs/request.schema.json: EVENLY_WRITE_SCHEMA=1 writes it");
}

/// One request of each kind, with nothing left at its default.
fn requests() -> Vec<Request> {
    let told = |text: &str| serde_json::from_str(text).unwrap();
    let parameters = told(r#"{"min_distance": "8u", "coverage_radius": "off", "iterations": 7}"#);
    let polygon = Domain::Polygon { polygon: Resource::Data(crate::Rings(vec![vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]])) };
    let method = Method::default();
    let fixed = Some(Resource::Name("fixed.csv".into()));
    let density = Some(Resource::Data(crate::Pixels { width: 2, height: 1, values: vec![0.25, 1.0] }));
    let start = Method::named("jittered");
    let mesh = || Resource::Name("part.obj".to_owned());
    let (seed, no_warp, metric) = (7, true, Metric::Unit);
    let generate = GenerateRequest {
        n_points: Some(5),
        method,
        parameters,
        start,
        no_warp,
        seed,
        space: polygon.clone(),
        metric,
        density: density.clone(),
        fixed: fixed.clone(),
    };
    let parameters = generate.parameters.clone();
    let optimize = OptimizeRequest {
        points: Resource::Data(crate::Positions(vec![[0.1, 1e-300]])),
        method,
        parameters: parameters.clone(),
        no_warp,
        seed,
        space: Some(Domain::Rectangle { origin: Some([1.0, 2.0]), size: Some([3.0, 4.0]) }),
        metric,
        density: density.clone(),
        fixed: fixed.clone(),
    };
    let triangles = MeshRequest {
        polygon: Some(Resource::Name("area.geojson".into())),
        regions: Some(Resource::Data(crate::Regions(vec![("a".into(), crate::Rings(vec![vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]))]))),
        edge_length: Some(0.1),
        n_triangles: Some(9),
        simplify: Some(0.01),
        seed,
        method,
        parameters: parameters.clone(),
        grade: Some(0.2),
        max_edge_length: Some(2.0),
        sizes: Some(Resource::Data(crate::Lengths(vec![[0.0, 0.0, 0.1]]))),
        density: density.clone(),
        min_angle: Some(28.0),
        no_obtuse: true,
        fixed: fixed.clone(),
        lines: Some(Resource::Data(crate::Lines(vec![vec![[0.0, 0.0], [1.0, 1.0]]]))),
    };
    let remesh = RemeshRequest {
        n_vertices: Some(5),
        edge_length: Some(0.5),
        points: Some(Resource::Data(crate::Places(vec![[0.0, 1.0, 2.0]]))),
        seed,
        parameters: parameters.clone(),
        density: Some(Resource::Name("curvature:0.01".into())),
        features: OrOff(None),
        max_deviation: Some(OrOff(Some(0.3))),
        repair: true,
        weld: Some(1e-6),
        ..RemeshRequest::of(mesh())
    };
    let sample = SampleRequest {
        n_points: Some(5),
        spacing: Some(0.1),
        parameters: parameters.clone(),
        density: Some(Resource::Data(crate::Sizing(vec![1.0, 2.0]))),
        seed,
        repair: true,
        weld: Some(1e-6),
        ..SampleRequest::of(mesh())
    };
    let stipple = StippleRequest {
        parameters: parameters.clone(),
        seed,
        tone: InkTone { invert: true, contrast: 1.5, gamma: 2.0, floor: 0.1, white: 0.9 },
        layers: Layers::Cmyk,
        order: DrawOrder::Progressive,
        is_measured: true,
        ..StippleRequest::of(Resource::Name("photo.jpg".into()), 5)
    };
    let compare = CompareRequest {
        points: Some(Resource::Name("points.csv".into())),
        n_points: Some(5),
        methods: vec![method.into()],
        parameters,
        runs: 2,
        start,
        no_warp,
        seed,
        space: Some(polygon),
        metric,
        density,
    };
    vec![
        Request::Generate(generate),
        Request::Optimize(optimize),
        Request::Mesh(triangles),
        Request::Remesh(remesh),
        Request::Sample(sample),
        Request::Stipple(stipple),
        Request::Compare(compare),
    ]
}

#[test]
fn requests_come_back_from_json_and_nothing_unknown_is_taken() {
    for request in requests() {
        let value = serde_json::to_value(&request).unwrap();
        assert_eq!(serde_json::from_value::<Request>(value.clone()).unwrap(), request, "{value}");
        let text = value.to_string();
        assert_eq!(serde_json::from_str::<Request>(&text).unwrap(), request, "{text}");
        let mut wrong = value;
        wrong["colour"] = json!("red");
        let error = serde_json::from_value::<Request>(wrong).unwrap_err().to_string();
        assert!(error.contains("colour"), "{error}");
    }
}

#[test]
fn methods_and_settings_come_back_from_json() {
    for method in Method::all() {
        let told = method.parameters().into_iter().filter_map(|(about, default)| Some((about.name, default?)));
        let settings = told.fold(evenly::Settings::default(), |all, (name, value)| all.with(name, value));
        let text = serde_json::to_string(&(method, &settings)).unwrap();
        assert_eq!(serde_json::from_str::<(Method, evenly::Settings)>(&text).unwrap(), (method, settings), "{text}");
    }
    assert!(serde_json::from_str::<Method>("\"nonsense\"").is_err());
}
