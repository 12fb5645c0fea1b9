//! Where a node of glTF puts things.

use super::document::Node;

/// An affine map: three columns, and what is added.
#[derive(Clone, Copy)]
pub(super) struct Place {
    columns: [[f64; 3]; 3],
    shift: [f64; 3],
}

impl Default for Place {
    fn default() -> Self {
        Self { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] }
    }
}

impl Place {
    /// By a scale, then a rotation as a quaternion x, y, z, w, then a shift.
    pub fn new(scale: [f64; 3], [x, y, z, w]: [f64; 4], shift: [f64; 3]) -> Self {
        let columns = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
            [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
            [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
        ];
        Self { columns: [0, 1, 2].map(|k: usize| columns[k].map(|x| x * scale[k])), shift }
    }

    /// Of a node in this one.
    pub fn of(&self, node: &Node) -> Self {
        self.around(&own(node))
    }

    /// Another one within this one.
    pub fn around(&self, own: &Self) -> Self {
        let shift = self.apply(own.shift);
        Self { columns: own.columns.map(|column| self.turn(column)), shift }
    }

    pub fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        let turned = self.turn(p);
        [0, 1, 2].map(|k| turned[k] + self.shift[k])
    }

    fn turn(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.columns[0][k] * p[0] + self.columns[1][k] * p[1] + self.columns[2][k] * p[2])
    }

    pub fn is_mirrored(&self) -> bool {
        let [a, b, c] = self.columns;
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]) < 0.0
    }
}

/// A matrix; or a scale, then a rotation, then a shift.
fn own(node: &Node) -> Place {
    if let Some(m) = node.matrix {
        return Place { columns: [[m[0], m[1], m[2]], [m[4], m[5], m[6]], [m[8], m[9], m[10]]], shift: [m[12], m[13], m[14]] };
    }
    let turn = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    Place::new(node.scale.unwrap_or([1.0; 3]), turn, node.translation.unwrap_or_default())
}
