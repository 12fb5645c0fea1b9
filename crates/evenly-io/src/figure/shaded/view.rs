//! Where a mesh in space is seen from, without perspective.

use evenly::TriangleMesh;

/// Towards the viewer; y points upwards.
const TOWARDS: [f64; 3] = [0.5, 0.35, 1.0];

pub(super) type Vector = [f64; 3];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Of length one, or nothing.
pub(super) fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|x| x / length) } else { [0.0; 3] }
}

/// How positions come onto paper.
pub(super) struct View {
    /// Rightwards and upwards on paper, and towards the viewer.
    axes: [Vector; 3],
    /// Positions are divided by this first, so that none is too large to reckon with.
    largest: f64,
    /// Then pixels to a unit.
    pub scale: f64,
}

impl View {
    /// A view in which the longest side of these meshes has this length.
    pub fn of(meshes: &[&TriangleMesh], side: f64) -> Self {
        let towards = unit(TOWARDS);
        let right = unit(cross([0.0, 1.0, 0.0], towards));
        let coordinates = meshes.iter().flat_map(|mesh| mesh.vertices.iter().flatten());
        let largest = coordinates.map(|x| x.abs()).filter(|x| x.is_finite()).fold(0.0, f64::max);
        let mut view = Self { axes: [right, cross(towards, right), towards], largest: largest.max(f64::MIN_POSITIVE), scale: 1.0 };
        let longest = meshes.iter().flat_map(|mesh| view.size(mesh)).fold(1e-9, f64::max);
        view.scale = side / longest;
        view
    }

    /// Rightwards, upwards, and towards the viewer.
    pub fn place(&self, p: Vector) -> Vector {
        let small = p.map(|x| x / self.largest);
        self.axes.map(|axis| dot(axis, small))
    }

    /// The lower left and the upper right corner of what is seen, before it is scaled.
    pub fn bounds(&self, mesh: &TriangleMesh) -> [[f64; 2]; 2] {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in mesh.triangles.iter().flatten().filter_map(|&v| mesh.vertices.get(v)) {
            let p = self.place(*p);
            for axis in 0..2 {
                (low[axis], high[axis]) = (low[axis].min(p[axis]), high[axis].max(p[axis]));
            }
        }
        if low[0] <= high[0] && low[1] <= high[1] { [low, high] } else { [[0.0; 2]; 2] }
    }

    /// The size on paper.
    pub fn size(&self, mesh: &TriangleMesh) -> [f64; 2] {
        let [low, high] = self.bounds(mesh);
        [self.scale * (high[0] - low[0]), self.scale * (high[1] - low[1])]
    }
}
