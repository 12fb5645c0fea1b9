//! The hexagonal lattice, to which lengths are relative.

/// The distance of neighbours in a hexagonal lattice of so many points in such an area: sqrt(2 A / (sqrt(3) n)), in units of the area's root. No set of as many points has a larger smallest distance there.
pub fn hexagonal_spacing(area: f64, n_points: f64) -> f64 {
    (2.0 * area / (3f64.sqrt() * n_points)).sqrt()
}

/// How many points a hexagonal lattice of this spacing has in an area: 2 A / (sqrt(3) h^2).
pub fn hexagonal_count(area: f64, spacing: f64) -> f64 {
    2.0 * area / (3f64.sqrt() * spacing * spacing)
}

/// The side of equilateral triangles, so many of which fill such an area. There are two for each point of the lattice.
pub fn triangle_side(area: f64, n_triangles: f64) -> f64 {
    hexagonal_spacing(area, 0.5 * n_triangles)
}

/// How many equilateral triangles of this side fill an area.
pub fn triangle_count(area: f64, side: f64) -> f64 {
    2.0 * hexagonal_count(area, side)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacings_and_counts_are_each_others_inverses() {
        for (area, n) in [(1.0, 1.0), (3e-9, 17.0), (4e12, 1e6)] {
            assert!((hexagonal_count(area, hexagonal_spacing(area, n)) / n - 1.0).abs() < 1e-15);
            assert!((triangle_count(area, triangle_side(area, n)) / n - 1.0).abs() < 1e-15);
        }
        // Two triangles of side 1 are a rhombus of height sqrt(3) / 2.
        assert!((triangle_side(0.5 * 3f64.sqrt(), 2.0) - 1.0).abs() < 1e-15);
    }
}
