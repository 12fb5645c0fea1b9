//! Cells in colours: how threads share a pass, so that they never meet and the result does not depend on them.
//!
//! In the plane the domain is divided into cells of at least twelve spacings a side, and each into four by four blocks. A vertex belongs to a block
//! until the division is remade, wherever it goes. A thread that works on a cell may touch the vertices of the cell and
//! of the two blocks around it: these territories are disjoint for cells of one colour, which are every second along both axes. A
//! visit that would reach further (the star, its second ring, and whatever flips and moves touch) is put off to a tail
//! that one thread works off in order. This is asked of every vertex that is touched, so it is certain, not likely.

use glam::DVec2;

use crate::triangulation::{LiveMesh, Territory};

/// The smallest side of a cell, in spacings.
const SIDE: f64 = 12.0;
/// Blocks along a cell's side.
const BLOCKS: u32 = 4;
/// Blocks that a territory holds beyond its cell, on each side.
const REACH: u32 = 2;
/// The most cells along an axis: a mark has 15 bits for a block's number.
const MAX_CELLS: u32 = 1 << 12;

/// Points in cells, the cells in colours.
pub(crate) struct Cells<T> {
    /// The points of each cell.
    members: Vec<u32>,
    starts: Vec<u32>,
    /// Cells that threads may work on at once.
    colours: Vec<Vec<u32>>,
    /// What a thread that works on a cell may touch.
    territories: Vec<T>,
}

impl<T: Copy> Cells<T> {
    /// Cells of given points: those of cell `k` are from `starts[k]` to `starts[k + 1]`.
    pub fn new(members: Vec<u32>, starts: Vec<u32>, colours: Vec<Vec<u32>>, territories: Vec<T>) -> Self {
        debug_assert_eq!(colours.iter().map(Vec::len).sum::<usize>(), territories.len());
        Self { members, starts, colours, territories }
    }

    pub fn colours(&self) -> &[Vec<u32>] {
        &self.colours
    }

    pub fn members(&self, cell: u32) -> &[u32] {
        &self.members[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }

    pub fn territory(&self, cell: u32) -> T {
        self.territories[cell as usize]
    }
}

impl Cells<Territory> {
    /// Divides the domain of a mesh in the plane, and puts every point into the cell and block where it is now, in order of their index. A cover is one cell, since the
    /// copies of a point move together.
    pub fn of_plane(mesh: &mut LiveMesh) -> Self {
        let grid = Grid::new(mesh);
        let [members, starts] = grid.assign(mesh);
        let territories = (0..grid.n_cells[0] * grid.n_cells[1]).map(|cell| grid.territory(cell)).collect();
        Self::new(members, starts, grid.colours(), territories)
    }
}

/// How many cells there are along each axis: powers of two, so that a block's number wraps by masking.
struct Grid {
    n_cells: [u32; 2],
}

impl Grid {
    fn new(mesh: &LiveMesh) -> Self {
        let size = if mesh.is_cover() { DVec2::ZERO } else { mesh.domain().size };
        let fitting = (size / (SIDE * mesh.typical_spacing())).to_array();
        let mut n_cells = fitting.map(|n| if n < 2.0 { 1 } else { 1 << (libm::log2(n) as u32) }).map(|n: u32| n.min(MAX_CELLS));
        // In a polygon's frame most may be empty.
        while n_cells[0] as usize * n_cells[1] as usize > mesh.n_points().max(1) {
            n_cells[usize::from(n_cells[1] > n_cells[0])] /= 2;
        }
        Self { n_cells }
    }

    /// The points of all cells, and where each cell's begin.
    fn assign(&self, mesh: &mut LiveMesh) -> [Vec<u32>; 2] {
        let n_blocks = DVec2::new(f64::from(BLOCKS * self.n_cells[0]), f64::from(BLOCKS * self.n_cells[1]));
        let scale = n_blocks / mesh.domain().size;
        let n_cells = (self.n_cells[0] * self.n_cells[1]) as usize;
        let n_points = mesh.n_points() as u32;
        let mut starts = vec![0; n_cells + 1];
        let cells: Vec<u32> = (0..n_points)
            .map(|v| {
                let [x, y] = (mesh.position(v) * scale).min(n_blocks - 1.0).as_uvec2().to_array();
                mesh.set_block(v, y << 16 | x);
                let cell = x / BLOCKS + y / BLOCKS * self.n_cells[0];
                starts[cell as usize + 1] += 1;
                cell
            })
            .collect();
        for cell in 0..n_cells {
            starts[cell + 1] += starts[cell];
        }
        let mut next = starts.clone();
        let mut members = vec![0; cells.len()];
        for (v, cell) in (0..).zip(cells) {
            let slot = &mut next[cell as usize];
            members[*slot as usize] = v;
            *slot += 1;
        }
        [members, starts]
    }

    fn colours(&self) -> Vec<Vec<u32>> {
        let [width, height] = self.n_cells;
        let parities = |n: u32| 0..n.min(2);
        let cells =
            |x: u32, y: u32| (y..height).step_by(2).flat_map(move |row| (x..width).step_by(2).map(move |column| row * width + column));
        parities(height).flat_map(|y| parities(width).map(move |x| cells(x, y).collect())).collect()
    }

    fn territory(&self, cell: u32) -> Territory {
        let at = [cell % self.n_cells[0], cell / self.n_cells[0]];
        let field = |axis: usize| {
            let n_blocks = BLOCKS * self.n_cells[axis];
            let first = (BLOCKS * at[axis] + n_blocks - REACH) % n_blocks;
            // A territory is eight blocks wide, a power of two: what is further away has a higher bit.
            (first, (n_blocks - 1) & !(BLOCKS + 2 * REACH - 1))
        };
        let ((x, x_outside), (y, y_outside)) = (field(0), field(1));
        Territory { first: y << 16 | x, outside: y_outside << 16 | x_outside }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::hilbert_order;
    use crate::{Space, Torus, white};

    fn divided(size: [f64; 2], n: usize) -> (LiveMesh, Cells<Territory>) {
        let space: Space = Torus::new([0.0, 0.0], size).unwrap().into();
        let (domain, positions) = white(space, n, 1).unwrap().normalized();
        let order = hilbert_order(&positions, domain.size);
        let sorted = order.iter().map(|&index| positions[index as usize]).collect();
        let mut mesh = LiveMesh::new(&domain, None, sorted, order, domain.hex_spacing(n)).unwrap();
        let cells = Cells::of_plane(&mut mesh);
        (mesh, cells)
    }

    #[test]
    fn territories_of_one_colour_are_disjoint_and_hold_their_cells() {
        for (size, n) in [([1.0, 1.0], 5000), ([20.0, 1.0], 5000), ([1.0, 1.0], 300)] {
            let (mesh, cells) = divided(size, n);
            let mut n_seen = 0;
            for colour in cells.colours() {
                let mut owner = vec![None; n];
                for &cell in colour {
                    let territory = cells.territory(cell);
                    for v in (0..n as u32).filter(|&v| mesh.is_free(v, territory)) {
                        assert_eq!(owner[v as usize].replace(cell), None);
                    }
                    assert!(cells.members(cell).iter().all(|&v| owner[v as usize] == Some(cell)));
                    n_seen += cells.members(cell).len();
                }
            }
            assert_eq!(n_seen, n);
        }
    }

    #[test]
    fn cells_are_twelve_spacings_wide_at_least() {
        let (mesh, cells) = divided([20.0, 1.0], 50_000);
        let [width, height] = Grid::new(&mesh).n_cells;
        let side = mesh.domain().size / DVec2::new(f64::from(width), f64::from(height)) / mesh.spacing();
        assert!(side.cmpge(DVec2::splat(SIDE)).all() && side.cmplt(DVec2::splat(2.0 * SIDE)).all(), "{side}");
        assert_eq!(cells.colours().iter().map(|colour| colour.len()).sum::<usize>() as u32, width * height);
    }
}
