//! Everything of evenly that touches files: points, polygons, meshes and pictures in and out, figures out.
//!
//! A file is written whole or not at all; an error names the file, the line and the value.

mod clouds;
mod density;
mod drawing;
mod error;
mod extent;
mod figure;
mod file;
mod format;
mod image;
mod memory;
mod meshes;
mod message;
mod npy;
mod output;
mod pdf;
mod photograph;
mod pixels;
mod render;
mod scraps;
mod shapes;
mod surfaces;
mod table;
mod text;
mod tiff;

pub use clouds::{CloudFormat, write_cloud};
pub use density::DensityFile;
pub use drawing::{Drawing, Layer, Marks};
pub use error::Error;
pub use extent::Extent;
pub use figure::{Axis, Curve, Draw, Subject, chart, compared_svg, figure, picture};
pub use file::{Target, discard_temporaries, make_folder, read_numbers, read_positions, read_rows, read_table, write_together};
pub use format::Format;
pub use image::{read_image, write_image};
pub use memory::{bytes_told, limit_memory, memory_limit, usual_memory};
pub use meshes::{MeshFormat, encode_mesh, encode_polygons, mesh_svg, write_mesh, write_polygons};
pub use message::presentable;
pub use output::{write_figure, write_points, write_table};
pub use photograph::{Photograph, Tone, luma};
pub use render::rendered;
pub use scraps::Scraps;
pub use shapes::{read_lines, read_polygon, read_regions};
pub use surfaces::{
    TrianglesRead, is_mesh_file, read_triangles, read_triangles_or_points, round_as_stl, stl_rounding, triangles_svg, write_triangles,
    write_triangles_figure,
};
pub use table::{Columns, Table};
