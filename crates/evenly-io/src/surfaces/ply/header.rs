//! The head of a PLY file: what comes after it, and how it is encoded.

use super::super::lines::{Line, Text, shown};
use crate::Error;

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A number, or a list of them after a count of this type.
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
    pub count: Option<Kind>,
}

impl Property {
    pub fn is_number(&self, name: &str) -> bool {
        self.count.is_none() && self.name == name
    }
}

/// So many things of the same properties.
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

/// What the head says.
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
}

impl Header {
    /// Reads up to the line `end_header`, and that.
    pub fn read(text: &mut Text) -> Result<Self, Error> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut is_first = true;
        loop {
            let mut line = text.expect_line(|| "end_header".into())?;
            let word = line.word().unwrap_or_default();
            match word {
                b"ply" if is_first => {}
                _ if is_first => return Err(line.problem("this is no PLY file; one begins with the word ply")),
                b"comment" | b"obj_info" => {}
                b"format" => encoding = Some(read_encoding(&mut line)?),
                b"element" => {
                    let name = read_name(&mut line)?;
                    elements.push(Element { name, count: line.count("the number of elements")?, properties: Vec::new() });
                }
                b"property" => {
                    let property = read_property(&mut line)?;
                    let element = elements.last_mut().ok_or_else(|| line.problem("a property before any element"))?;
                    element.properties.push(property);
                }
                b"end_header" => {
                    let encoding = encoding.ok_or_else(|| line.problem("the header ends without a format"))?;
                    return Ok(Self { encoding, elements });
                }
                _ => return Err(line.problem(format!("'{}' has no meaning in the header of a PLY file", shown(word)))),
            }
            is_first = false;
        }
    }
}

fn read_encoding(line: &mut Line) -> Result<Encoding, Error> {
    let encoding = match line.expect("ascii or binary_little_endian")? {
        b"ascii" => Encoding::Text,
        b"binary_little_endian" => Encoding::LittleEndian,
        b"binary_big_endian" => Encoding::BigEndian,
        other => {
            let problem = format!("the format is '{}', expected ascii, binary_little_endian or binary_big_endian", shown(other));
            return Err(line.problem(problem));
        }
    };
    match line.word() {
        None | Some(b"1.0") => Ok(encoding),
        Some(other) => Err(line.problem(format!("this is version {} of PLY; 1.0 alone is read", shown(other)))),
    }
}

fn read_property(line: &mut Line) -> Result<Property, Error> {
    let word = line.expect("a type")?;
    let (count, kind) = if word == b"list" {
        let (count, kind) = (line.expect("the type of the count")?, line.expect("the type of the list")?);
        (Some(read_kind(count, line)?), read_kind(kind, line)?)
    } else {
        (None, read_kind(word, line)?)
    };
    Ok(Property { name: read_name(line)?, kind, count })
}

fn read_kind(word: &[u8], line: &Line) -> Result<Kind, Error> {
    Ok(match word {
        b"char" | b"int8" => Kind::I8,
        b"uchar" | b"uint8" => Kind::U8,
        b"short" | b"int16" => Kind::I16,
        b"ushort" | b"uint16" => Kind::U16,
        b"int" | b"int32" => Kind::I32,
        b"uint" | b"uint32" => Kind::U32,
        b"float" | b"float32" => Kind::F32,
        b"double" | b"float64" => Kind::F64,
        _ => return Err(line.problem(format!("'{}' is no type of numbers, such as float, double, uchar or int", shown(word)))),
    })
}

fn read_name(line: &mut Line) -> Result<String, Error> {
    Ok(String::from_utf8_lossy(line.expect("a name")?).into_owned())
}
