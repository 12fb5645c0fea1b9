//! The triangles of a mesh as they are seen: which, in what order, and in what light.

use evenly::TriangleMesh;

use super::view::{Vector, View, cross, dot, minus, unit};

/// Where the light comes from: rightwards, upwards, and towards the viewer.
const LIGHT: Vector = [-0.45, 0.6, 0.66];

/// A triangle that is seen.
pub(super) struct Facet {
    /// Rightwards and upwards.
    pub corners: [[f64; 2]; 3],
    pub angles_deg: [f64; 3],
    /// From 0 for shade to 1 for light from straight above.
    pub light: f64,
    /// Whether it is seen from its back.
    pub is_inside: bool,
    /// Larger is nearer.
    depth: f64,
}

/// What is seen of a mesh.
pub(super) struct Relief {
    /// The farthest first.
    pub facets: Vec<Facet>,
    /// The left and the upper boundary.
    pub corner: [f64; 2],
    /// In pixels.
    pub line_width: f64,
}

impl Relief {
    pub fn of(mesh: &TriangleMesh, view: &View) -> Self {
        let [[left, _], [_, top]] = view.bounds(mesh);
        let places: Vec<Vector> = mesh.vertices.iter().map(|&p| view.place(p)).collect();
        let whole = mesh.triangles.iter().filter_map(|t| Some([*places.get(t[0])?, *places.get(t[1])?, *places.get(t[2])?]));
        let all: Vec<[Vector; 3]> = whole.filter(|corners| corners.iter().flatten().all(|x| x.is_finite())).collect();
        let is_closed = is_closed(&mesh.triangles);
        // A closed mesh that is inside out is seen from outside all the same.
        let middle = all.first().map_or([0.0; 3], |t| t[0]);
        let volume: f64 = all.iter().map(|t| dot(minus(t[0], middle), cross(minus(t[1], middle), minus(t[2], middle)))).sum();
        let outwards = if is_closed && volume < 0.0 { -1.0 } else { 1.0 };
        let normal = |[a, b, c]: [Vector; 3]| cross(minus(b, a), minus(c, a)).map(|x| outwards * x);
        let area: f64 = all.iter().map(|&t| 0.5 * dot(normal(t), normal(t)).sqrt()).sum();
        let mut facets: Vec<Facet> = all.iter().filter(|&&t| !is_closed || normal(t)[2] > 0.0).map(|&t| Facet::of(t, normal(t))).collect();
        facets.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        // Lines become thinner where triangles are small.
        let typical = view.scale * (area / all.len().max(1) as f64).sqrt();
        Self { facets, corner: [left, top], line_width: (0.04 * typical).clamp(0.08, 0.8) }
    }
}

impl Facet {
    fn of(corners: [Vector; 3], normal: Vector) -> Self {
        let is_inside = normal[2] < 0.0;
        let facing = if is_inside { normal.map(|x| -x) } else { normal };
        let angle = |k: usize| {
            let [u, v] = [1, 2].map(|n| minus(corners[(k + n) % 3], corners[k]));
            let wide = cross(u, v);
            dot(wide, wide).sqrt().atan2(dot(u, v)).to_degrees()
        };
        Self {
            corners: corners.map(|[x, y, _]| [x, y]),
            angles_deg: [angle(0), angle(1), angle(2)],
            light: dot(unit(facing), unit(LIGHT)).clamp(0.0, 1.0),
            is_inside,
            depth: corners.iter().map(|p| p[2]).sum(),
        }
    }
}

/// Whether every edge has two triangles, one on each side.
fn is_closed(triangles: &[[usize; 3]]) -> bool {
    let mut edges: Vec<[usize; 2]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    edges.sort_unstable();
    let is_simple = edges.windows(2).all(|pair| pair[0] != pair[1]);
    is_simple && edges.iter().all(|&[a, b]| edges.binary_search(&[b, a]).is_ok())
}
