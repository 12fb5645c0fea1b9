//! Cells on a surface, as in [`Cells`], by the mesh alone: runs of vertices that follow each other in memory, and so are near to each other.
//!
//! A cell's territory is what few edges lead to from its vertices. Where territories meet, cells have different colours. However a surface bends, and however the
//! spacing varies, visits are put off only where flips have brought far vertices near since.

use super::live::LiveSurface;
use crate::sweep::{Cells, Ground as _};

/// Vertices in a cell.
const RUN: usize = 128;
/// So many edges lead from a cell to the end of its territory: a visit moves neighbours, and what stands around these may be flipped.
const REACH: usize = 3;
const NONE: u32 = u32::MAX;

/// The vertices that one thread may touch: those that a cell owns in its colour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Territory {
    colour: u32,
    cell: u32,
}

impl Territory {
    /// All vertices.
    pub const EVERYTHING: Self = Self { colour: NONE, cell: NONE };
}

impl LiveSurface<'_> {
    /// Whether a vertex lies in a territory.
    #[inline]
    pub(super) fn holds(&self, territory: Territory, v: u32) -> bool {
        territory.colour == NONE || self.owners[territory.colour as usize][v as usize] == territory.cell
    }

    /// Puts vertices into cells, and cells into colours, of those that are free for one into that which has fewest.
    pub(super) fn divide(&mut self) -> Cells<Territory> {
        let n_points = self.n_points();
        let members: Vec<u32> = (0..n_points as u32).collect();
        let starts: Vec<u32> = (0..n_points).step_by(RUN).chain([n_points]).map(|start| start as u32).collect();
        let mut owners: Vec<Vec<u32>> = Vec::new();
        let mut colours: Vec<Vec<u32>> = Vec::new();
        let mut territories = Vec::new();
        let (mut reached, mut reached_by) = (Vec::new(), vec![NONE; n_points]);
        for (cell, run) in (0..).zip(members.chunks(RUN)) {
            self.reach(cell, run, &mut reached, &mut reached_by);
            let is_free = |&colour: &usize| reached.iter().all(|&v| owners[colour][v as usize] == NONE);
            let free = (0..colours.len()).filter(is_free).min_by_key(|&colour| colours[colour].len());
            let colour = free.unwrap_or_else(|| {
                colours.push(Vec::new());
                owners.push(vec![NONE; n_points]);
                colours.len() - 1
            });
            reached.iter().for_each(|&v| owners[colour][v as usize] = cell);
            colours[colour].push(cell);
            territories.push(Territory { colour: colour as u32, cell });
        }
        self.owners = owners;
        Cells::new(members, starts, colours, territories)
    }

    /// Finds what is in a cell's territory, ring by ring.
    fn reach(&self, cell: u32, run: &[u32], reached: &mut Vec<u32>, reached_by: &mut [u32]) {
        reached.clear();
        reached.extend(run);
        run.iter().for_each(|&v| reached_by[v as usize] = cell);
        let mut ring = 0..reached.len();
        for _ in 0..REACH {
            for k in ring.clone() {
                self.each_neighbour(reached[k], |other| {
                    if std::mem::replace(&mut reached_by[other as usize], cell) != cell {
                        reached.push(other);
                    }
                });
            }
            ring = ring.end..reached.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::remesh::start::{Wanted, start};
    use crate::surface::{Features, Surface, TriangleMesh};

    #[test]
    fn territories_of_one_colour_are_disjoint_and_hold_their_cells() {
        // An octahedron, and one triangle for a boundary.
        let vertices = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        let closed = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
        for triangles in [closed.clone(), closed[..1].to_vec()] {
            let surface = Surface::new(&TriangleMesh { vertices: vertices.clone(), triangles, attributes: Vec::new() }).unwrap();
            let (features, sizes, n_points) = (Features::boundaries(&surface), vec![1.0; surface.n_vertices()], 2000);
            let wanted = Wanted { surface: &surface, features: &features, sizes: &sizes, n_points, has_rows: false, given: &[], seed: 1 };
            let mut live = LiveSurface::new(&surface, &features, &sizes, start(wanted).unwrap().unwrap());
            let cells = live.divide();
            let mut n_seen = 0;
            for colour in cells.colours() {
                let n_holders = |v: u32| colour.iter().filter(|&&cell| live.holds(cells.territory(cell), v)).count();
                assert!((0..n_points as u32).all(|v| n_holders(v) <= 1));
                for &cell in colour {
                    assert!(cells.members(cell).iter().all(|&v| live.holds(cells.territory(cell), v)));
                    n_seen += cells.members(cell).len();
                }
            }
            assert_eq!(n_seen, n_points);
        }
    }
}
