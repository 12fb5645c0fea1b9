//! A mesh while it is read: faces are cut into triangles, and checked at the end.

use evenly::TriangleMesh;

use super::TrianglesRead;
use super::polygons::{Cut, Cutter};
use crate::Error;

/// A mesh while it is read.
#[derive(Default)]
pub(super) struct Building {
    pub mesh: TriangleMesh,
    pub notes: Vec<String>,
    /// The line or the number of the face that each triangle comes from.
    places: Vec<usize>,
    /// Faces with more than three corners: the first of their triangles, which are a fan until the end,
    /// and how many these are.
    polygons: Vec<(usize, usize)>,
    /// Vertices without a finite position, and where each stands.
    nowhere: Vec<(usize, String)>,
}

impl Building {
    /// Adds a vertex; `place` says where it stands. It may be anywhere or nowhere if no face has it.
    pub fn push_vertex(&mut self, position: [f64; 3], place: impl FnOnce() -> String) {
        if position.iter().any(|x| !x.is_finite()) {
            self.nowhere.push((self.mesh.vertices.len(), place()));
        }
        self.mesh.vertices.push(position);
    }

    /// Adds a face of three or more corners, which stands in this line or has this number.
    pub fn push_face(&mut self, corners: &[usize], place: usize) -> Result<(), String> {
        let [first, rest @ ..] = corners else { return Err("a face without corners".into()) };
        if rest.len() < 2 {
            return Err(format!("a face of {} corner{}, expected three or more", corners.len(), if rest.is_empty() { "" } else { "s" }));
        }
        if corners.len() > 3 {
            self.polygons.push((self.mesh.triangles.len(), corners.len() - 2));
        }
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
        self.leave_out_nowhere()?;
        self.cut_polygons(place);
        Ok(TrianglesRead { mesh: self.mesh, notes: self.notes })
    }

    /// Leaves out vertices without a finite position; a face that has one is an error.
    fn leave_out_nowhere(&mut self) -> Result<(), Error> {
        if self.nowhere.is_empty() {
            return Ok(());
        }
        let mut is_kept = vec![true; self.mesh.vertices.len()];
        self.nowhere.iter().for_each(|&(v, _)| is_kept[v] = false);
        let used = self.mesh.triangles.iter().flatten().find(|&&v| !is_kept[v]);
        if let Some((v, place)) = self.nowhere.iter().find(|(v, _)| used == Some(v)) {
            let [x, y, z] = self.mesh.vertices[*v];
            return Err(Error::content(place, format!("the position ({x}, {y}, {z}) is not finite")));
        }
        let mut next = 0;
        let number = is_kept.iter().map(|&is_kept| {
            next += usize::from(is_kept);
            next.saturating_sub(1)
        });
        let number: Vec<usize> = number.collect();
        self.mesh.triangles.iter_mut().for_each(|t| *t = t.map(|v| number[v]));
        keep(&mut self.mesh.vertices, &is_kept);
        self.mesh.attributes.iter_mut().for_each(|attribute| keep(&mut attribute.values, &is_kept));
        let (which, were) = if self.nowhere.len() > 1 { ("vertices", "were") } else { ("vertex", "was") };
        self.notes.push(format!("{} {which} without a finite position, of no face, {were} left out", self.nowhere.len()));
        Ok(())
    }

    /// Cuts the faces with more than three corners, whose fans tell the corners.
    fn cut_polygons(&mut self, place: impl Fn(usize) -> String) {
        let mut cutter = Cutter::default();
        let (mut crossing, mut bent) = (Vec::new(), Vec::new());
        let mut corners = Vec::new();
        for &(first, n) in &self.polygons {
            let fan = &mut self.mesh.triangles[first..first + n];
            corners.clear();
            corners.push(fan[0][0]);
            corners.push(fan[0][1]);
            corners.extend(fan.iter().map(|t| t[2]));
            match cutter.cut(&self.mesh.vertices, &mut corners, fan) {
                Cut::Flat => {}
                Cut::Bent => bent.push(self.places[first]),
                Cut::Crossing => crossing.push(self.places[first]),
            }
        }
        let n = self.polygons.len();
        if n > 0 {
            let (s, were) = if n > 1 { ("s", "were") } else { ("", "was") };
            self.notes.insert(0, format!("{n} polygon{s} with more than three corners {were} cut into triangles"));
        }
        for (places, what) in [(crossing, "not simple and cut from one corner"), (bent, "far from flat")] {
            if let [first, ..] = places[..] {
                let (s, are) = if places.len() > 1 { ("s", "are") } else { ("", "is") };
                self.notes.push(format!("{} polygon{s} {are} {what}, the first at {}", places.len(), place(first)));
            }
        }
    }
}

fn keep<T>(all: &mut Vec<T>, is_kept: &[bool]) {
    let mut flags = is_kept.iter();
    all.retain(|_| flags.next().copied().unwrap_or(true));
}
