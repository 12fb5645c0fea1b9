//! Polygons in space cut into triangles, by crate `earcut` in the plane that fits best.

use earcut::Earcut;

/// How a polygon was found to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cut {
    Flat,
    /// Its corners are far from one plane.
    Bent,
    /// It crosses itself, or has no area: it is a fan.
    Crossing,
}

/// Corners this far from the plane, in lengths of the polygon, are far.
const FAR: f64 = 0.1;
/// The share of the area by which triangles may miss a polygon's.
const ROUNDING: f64 = 1e-6;

/// What cutting needs room for.
#[derive(Default)]
pub(super) struct Cutter {
    earcut: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    ears: Vec<usize>,
}

impl Cutter {
    /// Writes the triangles of a polygon of four or more corners, two fewer than these, which are turned
    /// to begin with the least: so the same triangles come from any first corner.
    pub fn cut(&mut self, vertices: &[[f64; 3]], corners: &mut [usize], triangles: &mut [[usize; 3]]) -> Cut {
        let least = (0..corners.len()).min_by_key(|&k| corners[k]).unwrap_or_default();
        corners.rotate_left(least);
        let normal = normal(vertices, corners);
        let axis = (0..3).fold(0, |most, k| if normal[k].abs() > normal[most].abs() { k } else { most });
        // Of the axes that are left, in the order that sees the polygon from its front.
        let (u, v) = if normal[axis] > 0.0 { ((axis + 1) % 3, (axis + 2) % 3) } else { ((axis + 2) % 3, (axis + 1) % 3) };
        let origin = vertices[corners[0]];
        self.flat.clear();
        self.flat.extend(corners.iter().map(|&c| [vertices[c][u] - origin[u], vertices[c][v] - origin[v]]));
        self.ears.clear();
        self.earcut.earcut(self.flat.iter().copied(), &[], &mut self.ears);
        if !self.is_whole(triangles.len()) {
            for (t, pair) in triangles.iter_mut().zip(corners[1..].windows(2)) {
                *t = [corners[0], pair[0], pair[1]];
            }
            return Cut::Crossing;
        }
        for (t, ear) in triangles.iter_mut().zip(self.ears.chunks_exact(3)) {
            let [a, b, c] = [ear[0], ear[1], ear[2]];
            *t = if self.area([a, b, c]) < 0.0 { [a, c, b] } else { [a, b, c] }.map(|k| corners[k]);
        }
        if is_bent(vertices, corners, normal) { Cut::Bent } else { Cut::Flat }
    }

    /// Whether there are so many triangles, as large together as the polygon.
    fn is_whole(&self, n: usize) -> bool {
        let whole: f64 = (1..self.flat.len() - 1).map(|k| self.area([0, k, k + 1])).sum();
        let parts: f64 = self.ears.chunks_exact(3).map(|ear| self.area([ear[0], ear[1], ear[2]]).abs()).sum();
        self.ears.len() == 3 * n && (parts - whole).abs() <= ROUNDING * whole
    }

    /// Twice the area, signed.
    fn area(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [self.flat[a], self.flat[b], self.flat[c]];
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }
}

/// The normal of the plane that fits best, as long as twice the area (Newell's method).
fn normal(vertices: &[[f64; 3]], corners: &[usize]) -> [f64; 3] {
    let origin = vertices[corners[0]];
    let at = |k: usize| [0, 1, 2].map(|axis| vertices[corners[k % corners.len()]][axis] - origin[axis]);
    let mut normal = [0.0; 3];
    for k in 0..corners.len() {
        let (p, q) = (at(k), at(k + 1));
        for (axis, x) in normal.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *x += p[u] * q[v] - p[v] * q[u];
        }
    }
    normal
}

fn is_bent(vertices: &[[f64; 3]], corners: &[usize], normal: [f64; 3]) -> bool {
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    let height = |&c: &usize| (0..3).map(|axis| vertices[c][axis] * normal[axis]).sum::<f64>() / length;
    let spread = |of: &dyn Fn(&usize) -> f64| {
        let (low, high) = corners.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        high - low
    };
    let extent = (0..3).map(|axis| spread(&|&c: &usize| vertices[c][axis])).fold(0.0, f64::max);
    spread(&height) > FAR * extent
}
