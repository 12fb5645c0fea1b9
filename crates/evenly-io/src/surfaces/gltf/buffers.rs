//! The numbers of a glTF file: in the file itself, written into its text, or in a file beside it.

use std::cell::OnceCell;
use std::path::{self, Path};

use base64::Engine as _;

use super::super::lines::shown;
use super::document::{Accessor, Document};

/// Where numbers are.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    /// What a binary file has after its text.
    blob: Option<&'a [u8]>,
    folder: &'a Path,
    /// All buffers, each read when it is first needed.
    read: Vec<OnceCell<Result<Vec<u8>, String>>>,
}

impl<'a> Buffers<'a> {
    pub fn new(document: &'a Document, blob: Option<&'a [u8]>, folder: &'a Path) -> Self {
        Self { document, blob, folder, read: document.buffers.iter().map(|_| OnceCell::new()).collect() }
    }

    /// All numbers of an accessor that has things of this kind.
    pub fn numbers(&self, index: usize, wanted: Things) -> Result<Vec<f64>, String> {
        let accessor = self.document.accessors.get(index).ok_or_else(|| format!("there is no accessor {index}"))?;
        self.read_numbers(accessor, wanted).map_err(|problem| format!("accessor {index}: {problem}"))
    }

    fn read_numbers(&self, accessor: &Accessor, wanted: Things) -> Result<Vec<f64>, String> {
        let kind = Component::of(accessor.component_type).ok_or("its type is unknown")?;
        if accessor.kind != wanted.name() {
            return Err(format!("it has {}, expected {}", shown(accessor.kind.as_bytes()), wanted.name()));
        }
        if accessor.sparse.is_some() {
            return Err("it is sparse, which is not read; export the mesh without sparse accessors".into());
        }
        let view = accessor.buffer_view.and_then(|view| self.document.buffer_views.get(view)).ok_or("it has no view of a buffer")?;
        let buffer = self.bytes(view.buffer)?;
        let start = view.byte_offset.checked_add(accessor.byte_offset);
        let bytes = start.and_then(|start| buffer.get(start..)).unwrap_or_default();
        let each = wanted.n_numbers() * kind.size();
        let stride = view.byte_stride.unwrap_or(each).max(1);
        let n = accessor.count;
        let needed = n.saturating_sub(1).checked_mul(stride).and_then(|before| before.checked_add(each)).unwrap_or(usize::MAX);
        if n > 0 && needed > bytes.len() {
            return Err(format!("{n} of its things should take {needed} bytes, but there are {}", bytes.len()));
        }
        let scale = if accessor.normalized { kind.largest() } else { 1.0 };
        let things = (0..n).flat_map(|k| bytes[k * stride..][..each].chunks_exact(kind.size()));
        Ok(things.map(|bytes| (kind.number(bytes) / scale).max(if accessor.normalized { -1.0 } else { f64::NEG_INFINITY })).collect())
    }

    fn bytes(&self, index: usize) -> Result<&[u8], String> {
        let cell = self.read.get(index).ok_or_else(|| format!("there is no buffer {index}"))?;
        let uri = self.document.buffers.get(index).and_then(|buffer| buffer.uri.as_deref());
        if let (None, Some(blob)) = (uri, self.blob) {
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
        if !Path::new(&name).components().all(|part| matches!(part, path::Component::Normal(_) | path::Component::CurDir)) {
            return Err(format!("{name} is not beside the file; put both into one folder"));
        }
        std::fs::read(self.folder.join(&name)).map_err(|e| format!("{name}: {e}"))
    }
}

/// Numbers that make one thing.
#[derive(Clone, Copy)]
pub(super) enum Things {
    Scalar,
    Vec3,
    Vec4,
}

impl Things {
    fn name(self) -> &'static str {
        match self {
            Self::Scalar => "SCALAR",
            Self::Vec3 => "VEC3",
            Self::Vec4 => "VEC4",
        }
    }

    fn n_numbers(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Vec3 => 3,
            Self::Vec4 => 4,
        }
    }
}

/// The type of a number.
#[derive(Clone, Copy)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// By the number that stands for it.
    fn of(code: u32) -> Option<Self> {
        match code {
            5120 => Some(Self::I8),
            5121 => Some(Self::U8),
            5122 => Some(Self::I16),
            5123 => Some(Self::U16),
            5125 => Some(Self::U32),
            5126 => Some(Self::F32),
            _ => None,
        }
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// What stands for 1 where numbers are normalized.
    fn largest(self) -> f64 {
        match self {
            Self::I8 => f64::from(i8::MAX),
            Self::U8 => f64::from(u8::MAX),
            Self::I16 => f64::from(i16::MAX),
            Self::U16 => f64::from(u16::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 => 1.0,
        }
    }

    /// A number from as many bytes as it has, the lowest first.
    fn number(self, bytes: &[u8]) -> f64 {
        let mut four = [0; 4];
        for (to, &byte) in four.iter_mut().zip(bytes) {
            *to = byte;
        }
        let two = [four[0], four[1]];
        match self {
            Self::I8 => f64::from(four[0] as i8),
            Self::U8 => f64::from(four[0]),
            Self::I16 => f64::from(i16::from_le_bytes(two)),
            Self::U16 => f64::from(u16::from_le_bytes(two)),
            Self::U32 => f64::from(u32::from_le_bytes(four)),
            Self::F32 => f64::from(f32::from_le_bytes(four)),
        }
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
