//! The numbers of a glTF file: in the file itself, written into its text, or in a file beside it.

use std::cell::OnceCell;
use std::path::{Component, Path};

use base64::Engine as _;
use gltf::json::Root;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::validation::Checked;

/// Where numbers are.
pub(super) struct Buffers<'a> {
    root: &'a Root,
    /// What a binary file has after its text.
    blob: Option<Vec<u8>>,
    folder: &'a Path,
    /// All buffers, each read when it is first needed.
    read: Vec<OnceCell<Result<Vec<u8>, String>>>,
}

impl<'a> Buffers<'a> {
    pub fn new(root: &'a Root, blob: Option<Vec<u8>>, folder: &'a Path) -> Self {
        Self { root, blob, folder, read: root.buffers.iter().map(|_| OnceCell::new()).collect() }
    }

    /// All numbers of an accessor that has things of this kind.
    pub fn numbers(&self, index: usize, wanted: Type) -> Result<Vec<f64>, String> {
        let accessor = self.root.accessors.get(index).ok_or_else(|| format!("there is no accessor {index}"))?;
        self.read_numbers(accessor, wanted).map_err(|problem| format!("accessor {index}: {problem}"))
    }

    fn read_numbers(&self, accessor: &Accessor, wanted: Type) -> Result<Vec<f64>, String> {
        let (Checked::Valid(kind), Checked::Valid(things)) = (&accessor.component_type, &accessor.type_) else {
            return Err("its type is unknown".into());
        };
        if *things != wanted {
            return Err(format!("it has {things:?}, expected {wanted:?}"));
        }
        if accessor.sparse.is_some() {
            return Err("it is sparse, which is not read; export the mesh without sparse accessors".into());
        }
        let view = accessor.buffer_view.and_then(|view| self.root.get(view)).ok_or("it has no view of a buffer")?;
        let buffer = self.bytes(view.buffer.value())?;
        let start = view.byte_offset.map_or(0, |offset| offset.0).checked_add(accessor.byte_offset.map_or(0, |offset| offset.0));
        let bytes = start.and_then(|start| buffer.get(usize::try_from(start).ok()?..)).unwrap_or_default();
        let kind = kind.0;
        let n_each = wanted.multiplicity();
        let each = n_each * kind.size();
        let stride = view.byte_stride.map_or(each, |stride| stride.0).max(1);
        let n = usize::try_from(accessor.count.0).unwrap_or(usize::MAX);
        let needed = n.saturating_sub(1).checked_mul(stride).and_then(|before| before.checked_add(each)).unwrap_or(usize::MAX);
        if n > 0 && needed > bytes.len() {
            return Err(format!("{n} of its things should take {needed} bytes, but there are {}", bytes.len()));
        }
        let scale = if accessor.normalized { largest(kind) } else { 1.0 };
        let things = (0..n).flat_map(|k| bytes[k * stride..][..each].chunks_exact(kind.size()));
        Ok(things.map(|bytes| (number(kind, bytes) / scale).max(if accessor.normalized { -1.0 } else { f64::NEG_INFINITY })).collect())
    }

    fn bytes(&self, index: usize) -> Result<&[u8], String> {
        let cell = self.read.get(index).ok_or_else(|| format!("there is no buffer {index}"))?;
        let uri = self.root.buffers.get(index).and_then(|buffer| buffer.uri.as_deref());
        if let (None, Some(blob)) = (uri, &self.blob) {
            return Ok(blob);
        }
        let read = cell.get_or_init(|| self.fetch(uri.ok_or("it names no file and has no bytes of its own")?));
        read.as_deref().map_err(|problem| format!("buffer {index}: {problem}"))
    }

    fn fetch(&self, uri: &str) -> Result<Vec<u8>, String> {
        if let Some(data) = uri.strip_prefix("data:") {
            let (_, text) = data.split_once(";base64,").ok_or("its data is not in base64")?;
            let config =
                base64::engine::GeneralPurposeConfig::new().with_decode_padding_mode(base64::engine::DecodePaddingMode::Indifferent);
            let engine = base64::engine::GeneralPurpose::new(&base64::alphabet::STANDARD, config);
            return engine.decode(text).map_err(|e| format!("its data is no base64: {e}"));
        }
        let name = decoded(uri);
        // A mesh has no business with files elsewhere.
        if !Path::new(&name).components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
            return Err(format!("{name} is not beside the file; put both into one folder"));
        }
        std::fs::read(self.folder.join(&name)).map_err(|e| format!("{name}: {e}"))
    }
}

/// The largest number of a type, which stands for 1 where numbers are normalized.
fn largest(kind: ComponentType) -> f64 {
    match kind {
        ComponentType::I8 => f64::from(i8::MAX),
        ComponentType::U8 => f64::from(u8::MAX),
        ComponentType::I16 => f64::from(i16::MAX),
        ComponentType::U16 => f64::from(u16::MAX),
        ComponentType::U32 => f64::from(u32::MAX),
        ComponentType::F32 => 1.0,
    }
}

/// A number from as many bytes as it has, the lowest first.
fn number(kind: ComponentType, bytes: &[u8]) -> f64 {
    let mut four = [0; 4];
    for (to, &byte) in four.iter_mut().zip(bytes) {
        *to = byte;
    }
    let two = [four[0], four[1]];
    match kind {
        ComponentType::I8 => f64::from(four[0] as i8),
        ComponentType::U8 => f64::from(four[0]),
        ComponentType::I16 => f64::from(i16::from_le_bytes(two)),
        ComponentType::U16 => f64::from(u16::from_le_bytes(two)),
        ComponentType::U32 => f64::from(u32::from_le_bytes(four)),
        ComponentType::F32 => f64::from(f32::from_le_bytes(four)),
    }
}

/// A file's name whose odd letters are written as %20 and such.
fn decoded(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let hex = after.get(..2).filter(|_| first == b'%').and_then(|digits| std::str::from_utf8(digits).ok());
        match hex.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
