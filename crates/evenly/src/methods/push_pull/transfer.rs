//! Transfers: a pocket between fixed points, or behind a neck of a polygon, may lack points that
//! cannot get there. Points of small cells are put into the largest ones.

use glam::DVec2;

use crate::error::Error;
use crate::methods::prepare::triangulated;
use crate::points::PointSet;
use crate::run::{Report, RunContext};
use crate::star::Senses;
use crate::triangulation::StarBuffer;

/// A cell of this many times the mean capacity has room for another point.
const ROOMY: f64 = 1.6;
/// A point whose cell has less than this part of it can be spared.
const SPARE: f64 = 0.75;

/// A point's cell.
struct Cell {
    point: u32,
    /// Relative to the mean.
    capacity: f64,
    farthest: DVec2,
}

/// The same points with as many transferred as there are roomy cells and points to spare; `None`
/// where there are none.
///
/// # Errors
/// Those of a triangulation of the points.
pub(super) fn transferred(points: &PointSet) -> Result<Option<PointSet>, Error> {
    let mut scratch = Report::new("", points.n_points());
    let Some((domain, mut mesh)) = triangulated(points, &mut scratch, &mut RunContext::default())? else { return Ok(None) };
    let senses = Senses { mass: true, ..Senses::default() };
    let looked = mesh.look(senses, |mesh, v, buffer| {
        let (capacity, way) = (super::rule::capacity(&mut buffer.star), farthest(buffer));
        (capacity, mesh.position(v) + way)
    })?;
    let order = mesh.into_order();
    let mut cells: Vec<Cell> =
        order.into_iter().zip(looked).map(|(point, (capacity, farthest))| Cell { point, capacity, farthest }).collect();
    cells.sort_by(|a, b| b.capacity.total_cmp(&a.capacity).then(a.point.cmp(&b.point)));
    let roomy = cells.iter().take_while(|cell| cell.capacity > ROOMY);
    let spare = cells.iter().rev().take_while(|cell| cell.capacity < SPARE).filter(|cell| cell.point as usize >= points.n_fixed());
    let (order, places): (Vec<u32>, Vec<DVec2>) =
        roomy.zip(spare).map(|(roomy, spare)| (spare.point, domain.inside(roomy.farthest))).unzip();
    Ok((!order.is_empty()).then(|| points.moved(&domain, &order, &places)))
}

/// The way to the farthest place of the cell that is seen.
fn farthest(StarBuffer { star, spokes, sight, .. }: &StarBuffer) -> DVec2 {
    let longer = |longest: DVec2, way: DVec2| if way.length_squared() > longest.length_squared() { way } else { longest };
    if !sight.outline.is_empty() {
        return sight.outline.iter().copied().fold(DVec2::ZERO, longer);
    }
    let corner = |k: usize| {
        let [along_u, along_v] = star.centre(k);
        along_u * spokes[k].way + along_v * spokes[star.after(k)].way
    };
    (0..star.n_spokes()).map(corner).fold(DVec2::ZERO, longer)
}
