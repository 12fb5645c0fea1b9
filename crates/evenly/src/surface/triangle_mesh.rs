//! [`TriangleMesh`]: triangles in space, as a file has them or is to have them.

/// Triangles in space. Nothing is known of how they hang together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TriangleMesh {
    /// Positions, in whatever units the input has.
    pub vertices: Vec<[f64; 3]>,
    /// Three vertices each, counter-clockwise as seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// What each vertex carries along: colours, texture coordinates, or whatever a file has.
    pub attributes: Vec<Attribute>,
}

/// One number for each vertex.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attribute {
    /// Its name, as a file has it.
    pub name: String,
    /// As many as there are vertices.
    pub values: Vec<f64>,
}
