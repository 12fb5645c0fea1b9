//! glTF, by crate `gltf`: positions and triangles of all meshes in the scene, where their nodes put them. Looks, bones and motion are skipped.

mod buffers;
mod place;

use std::path::Path;

use gltf::json::accessor::Type;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::scene::Node;
use gltf::json::validation::Checked;
use gltf::json::{Index, Root};
use serde_json::Value;

use self::buffers::Buffers;
use self::place::Place;
use super::TrianglesRead;
use super::building::Building;
use super::lines::shown;
use crate::Error;
use crate::memory::{bytes_told, memory_limit};

/// The bytes before the parts of a binary file.
const HEAD: usize = 12;
/// Extensions that hide positions where a plain reader cannot find them.
const HIDING: [&str; 3] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Extensions that are read.
const KNOWN: [&str; 2] = ["KHR_mesh_quantization", INSTANCING];
/// How extensions begin that change looks alone.
const LOOKS: [&str; 6] = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "EXT_lights_", "MSFT_texture_"];
/// A surface with a vertex takes about so much memory for it.
const BYTES_A_VERTEX: u64 = 500;
/// The extension by which a node puts its mesh in many places.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

pub(super) fn read(name: &str, bytes: &[u8], folder: &Path) -> Result<TrianglesRead, Error> {
    let problem = |problem: String| Error::content(name, problem);
    let (json, blob) = split(bytes).map_err(problem)?;
    let document: Value = serde_json::from_slice(&json).map_err(|e| problem(format!("this is no glTF: {e}")))?;
    let version = document["asset"]["version"].as_str().unwrap_or("1.0");
    if !version.starts_with("2.") {
        return Err(problem(format!("this is glTF {}; 2.0 alone is read", shown(version.as_bytes()))));
    }
    let root = Root::from_slice(&json).map_err(|e| problem(format!("this is no glTF: {e}")))?;
    for extension in &root.extensions_required {
        if HIDING.contains(&extension.as_str()) {
            return Err(problem(format!("its triangles are compressed by {extension}; export it without compression")));
        }
        if !KNOWN.contains(&extension.as_str()) && !LOOKS.iter().any(|looks| extension.starts_with(looks)) {
            return Err(problem(format!("it needs the extension {}, which is not read", shown(extension.as_bytes()))));
        }
    }
    let buffers = Buffers::new(&root, blob, folder);
    let mut walk = Walk { root: &root, document: &document, buffers, building: Building::default(), n_seen: 0, n_skipped: 0 };
    walk.scene().map_err(problem)?;
    let Walk { mut building, n_skipped, .. } = walk;
    if n_skipped > 0 {
        let (s, were) = if n_skipped > 1 { ("s", "were") } else { ("", "was") };
        building.notes.push(format!("{n_skipped} part{s} of points or lines {were} left out"));
    }
    building.finish(name, |face| format!("{name}, triangle {face}"))
}

/// The document, and the bytes that a binary file has after it.
fn split(bytes: &[u8]) -> Result<(Vec<u8>, Option<Vec<u8>>), String> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.to_vec(), None));
    }
    // The crate would subtract the head from a length that is less.
    let length = bytes.get(8..HEAD).and_then(<[u8]>::first_chunk).map_or(0, |&length| u32::from_le_bytes(length) as usize);
    if length < HEAD {
        return Err("this is no binary glTF: its head is cut short".into());
    }
    let parts = gltf::Glb::from_slice(bytes).map_err(|e| format!("this is no binary glTF: {e}"))?;
    Ok((parts.json.into_owned(), parts.bin.map(|blob| blob.into_owned())))
}

/// The way through a scene.
struct Walk<'a> {
    root: &'a Root,
    /// The same with what `root` does not know.
    document: &'a Value,
    buffers: Buffers<'a>,
    building: Building,
    n_seen: usize,
    n_skipped: usize,
}

impl Walk<'_> {
    /// All nodes of the scene; without a scene, all meshes.
    fn scene(&mut self) -> Result<(), String> {
        let root = self.root;
        let Some(scene) = root.scene.and_then(|scene| root.get(scene)).or(root.scenes.first()) else {
            return (0..root.meshes.len()).try_for_each(|mesh| self.mesh(mesh, &Place::default()));
        };
        // By a stack of our own, however deep nodes lie.
        let mut waiting: Vec<(Index<Node>, Place)> = scene.nodes.iter().rev().map(|&node| (node, Place::default())).collect();
        while let Some((index, outer)) = waiting.pop() {
            self.n_seen += 1;
            if self.n_seen > root.nodes.len() {
                return Err("its nodes are no tree: one has two parents, or is its own".into());
            }
            let node = root.get(index).ok_or_else(|| format!("there is no node {}", index.value()))?;
            let place = outer.of(node);
            if let Some(mesh) = node.mesh {
                for instance in self.instances(index.value()).map_err(|problem| format!("node {}: {problem}", index.value()))? {
                    self.mesh(mesh.value(), &place.around(&instance))?;
                }
            }
            waiting.extend(node.children.iter().flatten().rev().map(|&child| (child, place)));
        }
        Ok(())
    }

    /// Where a node puts its mesh, within its own place.
    fn instances(&self, node: usize) -> Result<Vec<Place>, String> {
        let attributes = &self.document["nodes"][node]["extensions"][INSTANCING]["attributes"];
        let column = |name: &str, kind: Type| {
            let index = attributes[name].as_u64().map(|index| usize::try_from(index).unwrap_or(usize::MAX));
            index.map(|index| self.buffers.numbers(index, kind)).transpose()
        };
        let shifts = column("TRANSLATION", Type::Vec3)?;
        let turns = column("ROTATION", Type::Vec4)?;
        let scales = column("SCALE", Type::Vec3)?;
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
        let mesh = self.root.meshes.get(index).ok_or_else(|| format!("there is no mesh {index}"))?;
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            self.primitive(primitive, place).map_err(|problem| format!("mesh {index}, part {k}: {problem}"))?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, place: &Place) -> Result<(), String> {
        let Checked::Valid(mode) = primitive.mode else { return Err("its mode is unknown".into()) };
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.n_skipped += 1;
            return Ok(());
        }
        let positions = primitive.attributes.get(&Checked::Valid(Semantic::Positions)).ok_or("it has no POSITION")?;
        let positions = self.buffers.numbers(positions.value(), Type::Vec3)?;
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
            Some(indices) => self.buffers.numbers(indices.value(), Type::Scalar)?.into_iter().map(|v| v as usize).collect(),
            None => (0..n).collect(),
        };
        if let Some(v) = corners.iter().find(|&&v| v >= n) {
            return Err(format!("a triangle has vertex {v} (counted from 0), but there are only {n}"));
        }
        for [a, b, c] in triangles(mode, &corners) {
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
fn triangles(mode: Mode, corners: &[usize]) -> Vec<[usize; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let turned = corners.windows(3).enumerate();
            let all = turned.map(|(k, t)| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] });
            all.filter(|[a, b, c]| a != b && b != c && c != a).collect()
        }
        Mode::TriangleFan => corners.get(1..).unwrap_or_default().windows(2).map(|pair| [corners[0], pair[0], pair[1]]).collect(),
        _ => corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}
