//! glTF: positions and triangles of all meshes in the scene, where their nodes put them. Looks, bones and motion are skipped.

mod binary;
mod buffers;
mod document;
mod place;

use std::path::Path;

use self::binary::split;
use self::buffers::{Buffers, Things};
use self::document::{Document, Node, Primitive};
use self::place::Place;
use super::TrianglesRead;
use super::building::Building;
use super::lines::shown;
use crate::Error;
use crate::memory::{bytes_told, memory_limit};

/// Extensions that hide positions where a plain reader cannot find them.
const HIDING: [&str; 3] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Extensions that are read.
const KNOWN: [&str; 2] = ["KHR_mesh_quantization", "EXT_mesh_gpu_instancing"];
/// How extensions begin that change looks alone.
const LOOKS: [&str; 6] = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "EXT_lights_", "MSFT_texture_"];
/// A surface with a vertex takes about so much memory for it.
const BYTES_A_VERTEX: u64 = 500;

pub(super) fn read(name: &str, bytes: &[u8], folder: &Path) -> Result<TrianglesRead, Error> {
    let problem = |problem: String| Error::content(name, problem);
    let (json, blob) = split(bytes).map_err(problem)?;
    let document: Document = serde_json::from_slice(json).map_err(|e| problem(format!("this is no glTF: {e}")))?;
    let version = document.asset.version.as_deref().unwrap_or("1.0");
    if !version.starts_with("2.") {
        return Err(problem(format!("this is glTF {}; 2.0 alone is read", shown(version.as_bytes()))));
    }
    for extension in &document.extensions_required {
        if HIDING.contains(&extension.as_str()) {
            return Err(problem(format!("its triangles are compressed by {extension}; export it without compression")));
        }
        if !KNOWN.contains(&extension.as_str()) && !LOOKS.iter().any(|looks| extension.starts_with(looks)) {
            return Err(problem(format!("it needs the extension {}, which is not read", shown(extension.as_bytes()))));
        }
    }
    let buffers = Buffers::new(&document, blob, folder);
    let mut walk = Walk { document: &document, buffers, building: Building::default(), n_seen: 0, n_skipped: 0 };
    walk.scene().map_err(problem)?;
    let Walk { mut building, n_skipped, .. } = walk;
    if n_skipped > 0 {
        let (s, were) = if n_skipped > 1 { ("s", "were") } else { ("", "was") };
        building.notes.push(format!("{n_skipped} part{s} of points or lines {were} left out"));
    }
    building.finish(name, |face| format!("{name}, triangle {face}"))
}

/// The way through a scene.
struct Walk<'a> {
    document: &'a Document,
    buffers: Buffers<'a>,
    building: Building,
    n_seen: usize,
    n_skipped: usize,
}

impl Walk<'_> {
    /// All nodes of the scene; without a scene, all meshes.
    fn scene(&mut self) -> Result<(), String> {
        let document = self.document;
        let Some(scene) = document.scene.and_then(|scene| document.scenes.get(scene)).or(document.scenes.first()) else {
            return (0..document.meshes.len()).try_for_each(|mesh| self.mesh(mesh, &Place::default()));
        };
        // By a stack of our own, however deep nodes lie.
        let mut waiting: Vec<(usize, Place)> = scene.nodes.iter().rev().map(|&node| (node, Place::default())).collect();
        while let Some((index, outer)) = waiting.pop() {
            self.n_seen += 1;
            if self.n_seen > document.nodes.len() {
                return Err("its nodes are no tree: one has two parents, or is its own".into());
            }
            let node = document.nodes.get(index).ok_or_else(|| format!("there is no node {index}"))?;
            let place = outer.of(node);
            if let Some(mesh) = node.mesh {
                for instance in self.instances(node).map_err(|problem| format!("node {index}: {problem}"))? {
                    self.mesh(mesh, &place.around(&instance))?;
                }
            }
            waiting.extend(node.children.iter().rev().map(|&child| (child, place)));
        }
        Ok(())
    }

    /// Where a node puts its mesh, within its own place.
    fn instances(&self, node: &Node) -> Result<Vec<Place>, String> {
        let attributes = &node.extensions.instancing.attributes;
        let column = |name: &str, things: Things| attributes.get(name).map(|&index| self.buffers.numbers(index, things)).transpose();
        let shifts = column("TRANSLATION", Things::Vec3)?;
        let turns = column("ROTATION", Things::Vec4)?;
        let scales = column("SCALE", Things::Vec3)?;
        let numbers = [(&shifts, 3), (&turns, 4), (&scales, 3)].map(|(column, n)| column.as_ref().map(|column| column.len() / n));
        let Some(n) = numbers.into_iter().flatten().next() else { return Ok(vec![Place::default()]) };
        if numbers.into_iter().flatten().any(|other| other != n) {
            return Err("its instances have columns of different lengths".into());
        }
        let instance = |k: usize| {
            let shift = shifts.as_ref().map_or([0.0; 3], |all| [0, 1, 2].map(|axis| all[3 * k + axis]));
            let turn = turns.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |all| [0, 1, 2, 3].map(|axis| all[4 * k + axis]));
            let scale = scales.as_ref().map_or([1.0; 3], |all| [0, 1, 2].map(|axis| all[3 * k + axis]));
            Place::new(scale, turn, shift)
        };
        Ok((0..n).map(instance).collect())
    }

    fn mesh(&mut self, index: usize, place: &Place) -> Result<(), String> {
        let mesh = self.document.meshes.get(index).ok_or_else(|| format!("there is no mesh {index}"))?;
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            self.primitive(primitive, place).map_err(|problem| format!("mesh {index}, part {k}: {problem}"))?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, place: &Place) -> Result<(), String> {
        match primitive.mode {
            Primitive::TRIANGLES..=Primitive::FAN => {}
            0..Primitive::TRIANGLES => {
                self.n_skipped += 1;
                return Ok(());
            }
            _ => return Err("its mode is unknown".into()),
        }
        let positions = primitive.attributes.get("POSITION").ok_or("it has no POSITION")?;
        let positions = self.buffers.numbers(*positions, Things::Vec3)?;
        let first = self.building.mesh.vertices.len();
        let n = positions.len() / 3;
        require_few(first + n)?;
        for (v, p) in positions.chunks_exact(3).enumerate() {
            let position = place.apply([p[0], p[1], p[2]]);
            if let Some(x) = position.iter().find(|x| !x.is_finite()) {
                return Err(format!("vertex {v} has the coordinate {x}, which is not finite"));
            }
            self.building.mesh.vertices.push(position);
        }
        let corners: Vec<usize> = match primitive.indices {
            Some(indices) => self.buffers.numbers(indices, Things::Scalar)?.into_iter().map(|v| v as usize).collect(),
            None => (0..n).collect(),
        };
        if let Some(v) = corners.iter().find(|&&v| v >= n) {
            return Err(format!("a triangle has vertex {v} (counted from 0), but there are only {n}"));
        }
        for [a, b, c] in triangles(primitive.mode, &corners) {
            // What mirrors a mesh turns it inside out.
            let t = if place.is_mirrored() { [a, c, b] } else { [a, b, c] };
            let number = self.building.mesh.triangles.len() + 1;
            self.building.push_face(&t.map(|v| first + v), number)?;
        }
        Ok(())
    }
}

/// That so many vertices, of as many triangles or so, fit in memory.
fn require_few(n_vertices: usize) -> Result<(), String> {
    let needed = n_vertices as u64 * BYTES_A_VERTEX;
    if needed <= memory_limit() {
        return Ok(());
    }
    let [needed, allowed] = [needed, memory_limit()].map(bytes_told);
    Err(format!("{n_vertices} vertices or more would take {needed}; at most {allowed} of memory may be used"))
}

/// The triangles of a list, a strip or a fan; those of a strip without area only join its parts.
fn triangles(mode: u32, corners: &[usize]) -> Vec<[usize; 3]> {
    match mode {
        Primitive::STRIP => {
            let turned = corners.windows(3).enumerate();
            let all = turned.map(|(k, t)| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] });
            all.filter(|[a, b, c]| a != b && b != c && c != a).collect()
        }
        Primitive::FAN => corners.get(1..).unwrap_or_default().windows(2).map(|pair| [corners[0], pair[0], pair[1]]).collect(),
        _ => corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}
