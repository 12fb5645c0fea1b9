//! Cells of meshes: as large as the places are many that see no nearer vertex.

use evenly::{MeshParams, Polygon, RunContext, mesh, mesh_cells};
use glam::DVec2;

use super::visibility::Walls;
use super::{area, assert_near};
use crate::shapes::{Ring, holed_square, l_shape};

/// An L with a crooked hole in its corner.
fn holed_l() -> Vec<Ring> {
    let mut rings = l_shape();
    rings.push(vec![[0.15, 0.2], [0.35, 0.1], [0.4, 0.35], [0.2, 0.3]]);
    rings
}

#[test]
fn cells_of_a_mesh_share_its_places_by_the_nearest_vertex() {
    const SIDE: usize = 250;
    for (case, rings, edge_length, seed) in [("L", holed_l(), 0.1, 1), ("L", holed_l(), 0.06, 2), ("square", holed_square(), 0.12, 3)] {
        let (polygon, walls) = (Polygon::from_rings(rings.clone()).unwrap(), Walls::new(&rings));
        let (made, _) = mesh(&polygon, &MeshParams { seed, ..MeshParams::new(edge_length) }, &mut RunContext::default()).unwrap();
        let areas: Vec<f64> = mesh_cells(&made).iter().map(|cell| area(&cell.iter().map(|&p| p.into()).collect::<Vec<_>>())).collect();
        assert_near(areas.iter().sum(), walls.area(), 1e-9, case);
        let vertices: Vec<DVec2> = made.vertices.iter().map(|&p| p.into()).collect();
        let nearest = |place: DVec2| {
            let mut order: Vec<usize> = (0..vertices.len()).collect();
            order.sort_by(|&a, &b| vertices[a].distance_squared(place).total_cmp(&vertices[b].distance_squared(place)));
            // A vertex on the boundary is seen up to just before it.
            order.into_iter().find(|&v| walls.sees(vertices[v].lerp(place, 1e-9), place)).unwrap()
        };
        let step = 1.0 / SIDE as f64;
        let place = |k: usize| step * (DVec2::new((k % SIDE) as f64, (k / SIDE) as f64) + 0.5);
        let owners: Vec<Option<usize>> = (0..SIDE * SIDE).map(|k| walls.contains(place(k)).then(|| nearest(place(k)))).collect();
        let (mut n_places, mut n_doubtful) = (vec![0.0; vertices.len()], vec![0.0; vertices.len()]);
        for (k, owner) in owners.iter().enumerate() {
            let Some(owner) = *owner else { continue };
            let beside = [(k + 1) % (SIDE * SIDE), k.saturating_sub(1), (k + SIDE) % (SIDE * SIDE), k.saturating_sub(SIDE)];
            n_places[owner] += 1.0;
            n_doubtful[owner] += f64::from(u8::from(beside.into_iter().any(|other| owners[other] != Some(owner))));
        }
        for (v, area) in areas.iter().enumerate() {
            assert_near(area / (step * step), n_places[v], n_doubtful[v] + 1.0, &format!("{case}, {edge_length}, {v}"));
        }
    }
}
