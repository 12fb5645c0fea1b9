//! The numbers of a PLY file, one after the other, as text or binary.

use super::super::lines::{Line, Text, shown};
use super::header::{Element, Encoding, Kind, Property};
use crate::Error;

/// What is left of the numbers.
pub(super) struct Values<'a> {
    name: &'a str,
    encoding: Encoding,
    text: Text<'a>,
    /// The element that is being read: its line, its name and its number from 1.
    line: Option<Line<'a>>,
    element: String,
    number: usize,
}

impl<'a> Values<'a> {
    pub fn new(name: &'a str, text: Text<'a>, encoding: Encoding) -> Self {
        Self { name, encoding, text, line: None, element: String::new(), number: 0 }
    }

    pub fn name(&self) -> &'a str {
        self.name
    }

    pub fn is_text(&self) -> bool {
        self.encoding == Encoding::Text
    }

    /// Begins an element, counted from 0: in text it has a line of its own.
    pub fn begin(&mut self, element: &Element, number: usize) -> Result<(), Error> {
        if number == 0 {
            self.element.clone_from(&element.name);
        }
        self.number = number + 1;
        if self.is_text() {
            self.line = Some(self.text.expect_line(|| format!("{} {} of {}", element.name, number + 1, element.count))?);
        }
        Ok(())
    }

    /// The line of the element in text, else its number.
    pub fn place(&self) -> usize {
        self.line.as_ref().map_or(self.number, |line| line.number)
    }

    /// That something is wrong with the element.
    pub fn problem(&self, problem: impl Into<String>) -> Error {
        Error::content(self.place_name(), problem)
    }

    /// The next number. As text it has all its digits, whatever its type.
    pub fn number(&mut self, kind: Kind) -> Result<f64, Error> {
        if let Some(line) = &mut self.line {
            let word = line.expect("a number")?;
            let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
            return number.ok_or_else(|| self.problem(format!("'{}' is not a number", shown(word))));
        }
        let is_big = self.encoding == Encoding::BigEndian;
        let rest = &mut self.text.rest;
        let number = match kind {
            Kind::I8 => take(rest, is_big).map(|bytes| f64::from(i8::from_le_bytes(bytes))),
            Kind::U8 => take(rest, is_big).map(|bytes| f64::from(u8::from_le_bytes(bytes))),
            Kind::I16 => take(rest, is_big).map(|bytes| f64::from(i16::from_le_bytes(bytes))),
            Kind::U16 => take(rest, is_big).map(|bytes| f64::from(u16::from_le_bytes(bytes))),
            Kind::I32 => take(rest, is_big).map(|bytes| f64::from(i32::from_le_bytes(bytes))),
            Kind::U32 => take(rest, is_big).map(|bytes| f64::from(u32::from_le_bytes(bytes))),
            Kind::F32 => take(rest, is_big).map(|bytes| f64::from(f32::from_le_bytes(bytes))),
            Kind::F64 => take(rest, is_big).map(f64::from_le_bytes),
        };
        number.ok_or_else(|| self.problem("the file ends within it"))
    }

    /// The element's place, for messages.
    pub fn place_name(&self) -> String {
        match &self.line {
            Some(line) => line.place(),
            None => format!("{}, {} {}", self.name, self.element, self.number),
        }
    }

    /// The next list, its numbers where there is room for them.
    pub fn list(&mut self, property: &Property, mut room: Option<&mut Vec<f64>>) -> Result<(), Error> {
        let n = self.number(property.count.unwrap_or(property.kind))?;
        for _ in 0..self.whole(n, "a list's count")? {
            let number = self.number(property.kind)?;
            if let Some(room) = &mut room {
                room.push(number);
            }
        }
        Ok(())
    }

    /// A number of a vertex.
    pub fn corner(&self, number: f64) -> Result<usize, Error> {
        self.whole(number, "a corner")
    }

    fn whole(&self, number: f64, what: &str) -> Result<usize, Error> {
        let is_whole = number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0;
        if is_whole { Ok(number as usize) } else { Err(self.problem(format!("{what} is {number}, expected a whole number from 0"))) }
    }
}

/// The next bytes, the lowest first.
fn take<const N: usize>(rest: &mut &[u8], is_big: bool) -> Option<[u8; N]> {
    let (&first, after) = rest.split_first_chunk::<N>()?;
    *rest = after;
    let mut bytes = first;
    if is_big {
        bytes.reverse();
    }
    Some(bytes)
}
