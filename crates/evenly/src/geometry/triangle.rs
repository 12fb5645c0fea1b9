//! The shape of a triangle, in the plane or in space.

use glam::{DVec2, DVec3};

/// A triangle is obtuse if one of its angles is above this, in degrees: a right angle, and what rounding adds to one.
pub const OBTUSE_DEG: f64 = 90.0 + 1e-6;

/// What there is to know of a triangle's shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    /// The lengths of its sides, from each corner to the next.
    pub sides: [f64; 3],
    /// Negative in the plane where its corners run clockwise.
    pub area: f64,
    /// At each corner; of the area's sign.
    pub angles_deg: [f64; 3],
}

impl Shape {
    /// In the plane.
    pub fn of_plane(corners: [DVec2; 3]) -> Self {
        Self::new(corners, |a, b| a.distance(b), |u, v| u.perp_dot(v), |u, v| u.dot(v))
    }

    /// In space.
    pub fn of_space(corners: [DVec3; 3]) -> Self {
        Self::new(corners, |a, b| a.distance(b), |u, v| u.cross(v).length(), |u, v| u.dot(v))
    }

    fn new<V: Copy + std::ops::Sub<Output = V>>(
        [a, b, c]: [V; 3],
        distance: impl Fn(V, V) -> f64,
        cross: impl Fn(V, V) -> f64,
        dot: impl Fn(V, V) -> f64,
    ) -> Self {
        let angle = |at: V, u: V, v: V| libm::atan2(cross(u - at, v - at), dot(u - at, v - at)).to_degrees();
        Self {
            sides: [distance(a, b), distance(b, c), distance(c, a)],
            area: 0.5 * cross(b - a, c - a),
            angles_deg: [angle(a, b, c), angle(b, c, a), angle(c, a, b)],
        }
    }

    /// The smallest and the largest angle, in degrees.
    pub fn extreme_angles_deg(&self) -> [f64; 2] {
        let angles = self.angles_deg.iter().copied();
        [angles.clone().fold(f64::INFINITY, f64::min), angles.fold(f64::NEG_INFINITY, f64::max)]
    }

    pub fn is_obtuse(&self) -> bool {
        self.angles_deg.iter().any(|&angle| angle > OBTUSE_DEG)
    }

    pub fn shortest(&self) -> f64 {
        self.sides.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub fn longest(&self) -> f64 {
        self.sides.iter().copied().fold(0.0, f64::max)
    }

    pub fn circumradius(&self) -> f64 {
        self.sides.iter().product::<f64>() / (4.0 * self.area)
    }

    /// 2 r / R, twice the inradius over the circumradius: 1 if equilateral. With r = 2 S / p and R = a b c / (4 S), p the perimeter, it is 16 S^2 / (p a b c).
    pub fn radius_ratio(&self) -> f64 {
        let [a, b, c] = self.sides;
        let twice_area = 2.0 * self.area;
        4.0 * (twice_area / (a * b)) * (twice_area / (c * (a + b + c)))
    }

    /// 6 S / (sqrt(3) p h), p half of the perimeter and h the longest side: 1 if equilateral (Frey and Borouchaki, "Surface mesh evaluation", 1997, as in Table 2 of Ahmed et al. 2017).
    pub fn quality(&self) -> f64 {
        6.0 * self.area / (3f64.sqrt() * 0.5 * self.sides.iter().sum::<f64>() * self.longest())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_the_same_in_the_plane_and_in_space() {
        let flat = [DVec2::new(0.0, 0.0), DVec2::new(4.0, 0.0), DVec2::new(0.0, 3.0)];
        let plane = Shape::of_plane(flat);
        let space = Shape::of_space(flat.map(|p| DVec3::new(1.0, p.x, p.y)));
        for shape in [plane, space] {
            assert_eq!(shape.sides, [4.0, 5.0, 3.0]);
            assert!((shape.area - 6.0).abs() < 1e-15 && (shape.circumradius() - 2.5).abs() < 1e-15);
            assert!(!shape.is_obtuse() && (shape.angles_deg[0] - 90.0).abs() < 1e-12);
            // The inradius is 1.
            assert!((shape.radius_ratio() - 2.0 / 2.5).abs() < 1e-15);
            assert!((shape.quality() - 36.0 / (3f64.sqrt() * 6.0 * 5.0)).abs() < 1e-15);
        }
        let turned = Shape::of_plane([flat[0], flat[2], flat[1]]);
        assert!(turned.area < 0.0 && turned.extreme_angles_deg()[1] < 0.0);
    }

    #[test]
    fn an_equilateral_triangle_is_the_best() {
        let corners = [0.0, 120.0, 240.0f64].map(|degrees| DVec2::from_angle(degrees.to_radians()));
        let shape = Shape::of_plane(corners);
        assert!((shape.radius_ratio() - 1.0).abs() < 1e-14 && (shape.quality() - 1.0).abs() < 1e-14);
        assert!(shape.angles_deg.iter().all(|angle| (angle - 60.0).abs() < 1e-12));
    }
}
