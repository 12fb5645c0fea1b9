//! Shapes, each defined once: triangles, and the lattice that lengths are relative to.

pub(crate) mod spacing;
pub(crate) mod triangle;
