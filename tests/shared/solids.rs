//! Surfaces made by code.

#![allow(dead_code)]

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use evenly::TriangleMesh;

fn mesh(vertices: Vec<[f64; 3]>, triangles: Vec<[usize; 3]>) -> TriangleMesh {
    TriangleMesh { vertices, triangles, attributes: Vec::new() }
}

/// A sphere of radius 1 by latitudes and longitudes.
pub fn sphere(n: usize) -> TriangleMesh {
    let mut vertices = vec![[0.0, 0.0, 1.0]];
    for i in 1..n {
        let polar = PI * i as f64 / n as f64;
        for j in 0..2 * n {
            let around = PI * j as f64 / n as f64;
            vertices.push([polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()]);
        }
    }
    vertices.push([0.0, 0.0, -1.0]);
    let (south, at) = (vertices.len() - 1, |i: usize, j: usize| 1 + (i - 1) * 2 * n + j % (2 * n));
    let mut triangles = Vec::new();
    for j in 0..2 * n {
        triangles.extend([[0, at(1, j), at(1, j + 1)], [south, at(n - 1, j + 1), at(n - 1, j)]]);
        for i in 1..n - 1 {
            triangles.extend([[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]);
        }
    }
    mesh(vertices, triangles)
}

/// A torus with radii 1 and 0.4.
pub fn torus(n: usize, m: usize) -> TriangleMesh {
    let place = |i: usize, j: usize| {
        let (u, v) = (TAU * i as f64 / n as f64, TAU * j as f64 / m as f64);
        let r = 1.0 + 0.4 * v.cos();
        [r * u.cos(), r * u.sin(), 0.4 * v.sin()]
    };
    let at = |i: usize, j: usize| (i % n) * m + j % m;
    let vertices = (0..n * m).map(|k| place(k / m, k % m)).collect();
    let cell = |k: usize| {
        let (i, j) = (k / m, k % m);
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    };
    mesh(vertices, (0..n * m).flat_map(cell).collect())
}

/// The surface of some unit cells.
fn cells(is_filled: impl Fn([i64; 3]) -> bool, n: [i64; 3], size: [f64; 3]) -> TriangleMesh {
    let mut numbers: HashMap<[i64; 3], usize> = HashMap::new();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let inside = |c: [i64; 3]| (0..3).all(|k| (0..n[k]).contains(&c[k])) && is_filled(c);
    for x in 0..n[0] {
        for y in 0..n[1] {
            for z in 0..n[2] {
                let cell = [x, y, z];
                if !inside(cell) {
                    continue;
                }
                for axis in 0..3 {
                    for side in [0, 1] {
                        let mut other = cell;
                        other[axis] += 2 * side - 1;
                        if inside(other) {
                            continue;
                        }
                        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                        let mut quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| {
                            let mut corner = cell;
                            corner[axis] += side;
                            corner[u] += a;
                            corner[v] += b;
                            *numbers.entry(corner).or_insert_with(|| {
                                vertices.push([0, 1, 2].map(|k| corner[k] as f64 * size[k]));
                                vertices.len() - 1
                            })
                        });
                        if side == 0 {
                            quad.reverse();
                        }
                        triangles.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
                    }
                }
            }
        }
    }
    mesh(vertices, triangles)
}

/// The unit cube, each side of n by n squares.
pub fn cube(n: i64) -> TriangleMesh {
    cells(|_| true, [n; 3], [1.0 / n as f64; 3])
}

/// An L with square creases.
pub fn l_shape() -> TriangleMesh {
    cells(|[x, y, _]| x < 2 || y < 2, [4, 4, 2], [0.5; 3])
}

/// A slab with three holes through it.
pub fn genus_3() -> TriangleMesh {
    cells(|[x, y, _]| !(y == 1 && x % 2 == 1), [7, 3, 1], [1.0; 3])
}

/// A box 40 times as long as thick.
pub fn needle() -> TriangleMesh {
    cells(|_| true, [40, 1, 1], [0.1, 0.1, 0.1])
}

/// A box 1 by 1, 0.05 thick.
pub fn sheet() -> TriangleMesh {
    cells(|_| true, [8, 8, 1], [0.125, 0.125, 0.05])
}

/// A cylinder of height 2 over a disk, closed.
pub fn cylinder(n: usize) -> TriangleMesh {
    let rim = |z: f64| (0..n).map(move |k| [(TAU * k as f64 / n as f64).cos(), (TAU * k as f64 / n as f64).sin(), z]);
    let mut vertices = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]];
    vertices.extend(rim(0.0).chain(rim(2.0)));
    let (low, high) = (|k: usize| 2 + k % n, |k: usize| 2 + n + k % n);
    let sector =
        |k| [[0, low(k + 1), low(k)], [1, high(k), high(k + 1)], [low(k), low(k + 1), high(k + 1)], [low(k), high(k + 1), high(k)]];
    mesh(vertices, (0..n).flat_map(sector).collect())
}

/// A cone of height 2 over a disk.
pub fn cone(n: usize) -> TriangleMesh {
    let mut vertices = vec![[0.0, 0.0, 2.0], [0.0, 0.0, 0.0]];
    vertices.extend((0..n).map(|k| [(TAU * k as f64 / n as f64).cos(), (TAU * k as f64 / n as f64).sin(), 0.0]));
    let at = |k: usize| 2 + k % n;
    mesh(vertices, (0..n).flat_map(|k| [[0, at(k), at(k + 1)], [1, at(k + 1), at(k)]]).collect())
}

/// Two spheres that share a vertex.
pub fn touching_spheres() -> TriangleMesh {
    let one = sphere(16);
    let n = one.vertices.len();
    let other = one.vertices.iter().map(|&[x, y, z]| [x, y, z + 2.0]);
    let vertices = one.vertices.iter().copied().chain(other).collect();
    // The north pole of the one is the south pole of the other.
    let shifted = one.triangles.iter().map(|t| t.map(|v| if v == n - 1 { 0 } else { v + n }));
    mesh(vertices, one.triangles.iter().copied().chain(shifted).collect())
}

/// A wavy square with a boundary.
pub fn patch(n: usize) -> TriangleMesh {
    let at = |i: usize, j: usize| i * (n + 1) + j;
    let place = |k: usize| {
        let (x, y) = ((k / (n + 1)) as f64 / n as f64, (k % (n + 1)) as f64 / n as f64);
        [x, y, 0.1 * (TAU * x).sin() * (TAU * y).cos()]
    };
    let cell = |k: usize| {
        let (i, j) = (k / n, k % n);
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    };
    mesh((0..(n + 1) * (n + 1)).map(place).collect(), (0..n * n).flat_map(cell).collect())
}

/// A band with a half turn.
pub fn moebius(n: usize) -> TriangleMesh {
    const WIDE: usize = 5;
    let place = |k: usize| {
        let (u, v) = (TAU * (k / WIDE) as f64 / n as f64, 0.2 * ((k % WIDE) as f64 - 2.0));
        let r = 1.0 + 0.5 * v * (0.5 * u).cos();
        [r * u.cos(), r * u.sin(), 0.5 * v * (0.5 * u).sin()]
    };
    let at = |i: usize, j: usize| if i == n { WIDE - 1 - j } else { i * WIDE + j };
    let cell = |k: usize| {
        let (i, j) = (k / (WIDE - 1), k % (WIDE - 1));
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    };
    mesh((0..n * WIDE).map(place).collect(), (0..n * (WIDE - 1)).flat_map(cell).collect())
}

/// Two tetrahedra with one edge in common, 0-1.
pub fn two_at_an_edge() -> TriangleMesh {
    let vertices = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.5, 0.5], [1.0, -0.5, 0.5], [-1.0, -0.5, 0.5], [-1.0, 0.5, 0.5]];
    let tetrahedron = |[a, b, c, d]: [usize; 4]| [[a, d, b], [a, b, c], [b, d, c], [c, d, a]];
    // Seen from outside, both run counter-clockwise.
    let triangles = [tetrahedron([0, 1, 2, 3]), tetrahedron([0, 1, 4, 5])].concat();
    mesh(vertices, triangles)
}

/// A slice of a cake: two sides of length 1 at an angle in degrees, half as high.
pub fn slice(angle_deg: f64) -> TriangleMesh {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let base = [[0.0, 0.0], [1.0, 0.0], [cos, sin]];
    let vertices = [0.0, 0.5].into_iter().flat_map(|z| base.map(|[x, y]| [x, y, z])).collect();
    let sides = (0..3).flat_map(|k| [[k, (k + 1) % 3, 3 + (k + 1) % 3], [k, 3 + (k + 1) % 3, 3 + k]]);
    mesh(vertices, [[0, 2, 1], [3, 4, 5]].into_iter().chain(sides).collect())
}
