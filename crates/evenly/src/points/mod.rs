//! [`PointSet`], and the starting points that every method can begin from.

mod bins;
mod dart;
mod eliminate;
mod hexagonal;
mod jittered;
mod order;
mod point_set;
mod poisson_disk;
mod radius_bins;
mod random;
mod separate;
mod strata;
mod uniform;
mod varying_disk;
mod warp;
mod white;

pub use dart::{DartParams, dart};
pub use eliminate::{CANDIDATES_A_POINT, eliminate};
pub use hexagonal::hexagonal;
pub use jittered::jittered;
pub(crate) use order::hilbert_order;
pub use point_set::{MAX_POINTS, PointSet};
pub use poisson_disk::{PoissonDiskParams, poisson_disk, poisson_disk_around, poisson_disk_of};
pub(crate) use random::Random;
pub(crate) use separate::{leave_line, make_distinct, part, separate};
pub use varying_disk::{poisson_disk_by_density, poisson_disk_of_density};
pub use warp::{warp, warp_isotropic};
pub use white::{white, white_by_density};
