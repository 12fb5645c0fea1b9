//! What is read of a glTF document; all else is skipped.
//!
//! glTF 2.0 (ISO/IEC 12113:2022), section 5: indices count from 0, and what is not given has the default stated there.

use std::collections::HashMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

#[derive(Deserialize, Default)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Document {
    pub asset: Asset,
    pub extensions_required: Vec<String>,
    pub scene: Option<usize>,
    pub scenes: Vec<Scene>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<View>,
    pub buffers: Vec<Buffer>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Asset {
    pub version: Option<String>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Scene {
    pub nodes: Vec<usize>,
}

/// Where a mesh stands, within its parent: by a matrix, its columns one after the other, or a scale, then a rotation as a quaternion x, y, z, w, then a shift.
#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Node {
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub matrix: Option<[f64; 16]>,
    pub scale: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub translation: Option<[f64; 3]>,
    pub extensions: OfNode,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct OfNode {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instancing: Instancing,
}

/// The accessors of many places by what they hold.
#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Instancing {
    pub attributes: HashMap<String, usize>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    #[serde(default)]
    pub attributes: HashMap<String, usize>,
    pub indices: Option<usize>,
    #[serde(default = "triangles")]
    pub mode: u32,
}

fn triangles() -> u32 {
    Primitive::TRIANGLES
}

impl Primitive {
    pub const TRIANGLES: u32 = 4;
    pub const STRIP: u32 = 5;
    pub const FAN: u32 = 6;
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: usize,
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    pub count: usize,
    #[serde(rename = "type")]
    pub kind: String,
    pub sparse: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: usize,
    pub byte_stride: Option<usize>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Buffer {
    pub uri: Option<String>,
}
