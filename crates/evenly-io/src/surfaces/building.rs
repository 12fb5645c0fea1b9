//! A mesh while it is read: faces are cut into triangles, and checked at the end.

use evenly::TriangleMesh;

use super::TrianglesRead;
use crate::Error;

/// A mesh while it is read.
#[derive(Default)]
pub(super) struct Building {
    pub mesh: TriangleMesh,
    pub notes: Vec<String>,
    /// The line or the number of the face that each triangle comes from.
    places: Vec<usize>,
    n_cut: usize,
}

impl Building {
    /// Adds a face of three or more corners, which stands in this line or has this number.
    pub fn push_face(&mut self, corners: &[usize], place: usize) -> Result<(), String> {
        let [first, rest @ ..] = corners else { return Err("a face without corners".into()) };
        if rest.len() < 2 {
            return Err(format!("a face of {} corner{}, expected three or more", corners.len(), if rest.is_empty() { "" } else { "s" }));
        }
        self.n_cut += usize::from(corners.len() > 3);
        for pair in rest.windows(2) {
            self.mesh.triangles.push([*first, pair[0], pair[1]]);
            self.places.push(place);
        }
        Ok(())
    }

    /// The whole mesh, if it makes sense; `place` names the place of a face.
    pub fn finish(mut self, name: &str, place: impl Fn(usize) -> String) -> Result<TrianglesRead, Error> {
        let n = self.mesh.vertices.len();
        if self.mesh.triangles.is_empty() {
            return Err(Error::content(name, "it has no triangles"));
        }
        for (t, &number) in self.mesh.triangles.iter().zip(&self.places) {
            if let Some(v) = t.iter().find(|&&v| v >= n) {
                return Err(Error::content(place(number), format!("a face has vertex {v} (counted from 0), but there are only {n}")));
            }
        }
        if self.n_cut > 0 {
            let (s, were) = if self.n_cut > 1 { ("s", "were") } else { ("", "was") };
            self.notes.insert(0, format!("{} polygon{s} with more than three corners {were} cut into triangles", self.n_cut));
        }
        Ok(TrianglesRead { mesh: self.mesh, notes: self.notes })
    }
}
