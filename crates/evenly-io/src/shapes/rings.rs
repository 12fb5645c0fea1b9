//! Rings as text: `x y` a line, a blank line between rings; `#` comments.

use evenly::Shape;

use super::{Points, Shapes};
use crate::{Error, text};

pub(super) fn read(name: &str, text: &str) -> Result<Shapes, Error> {
    let mut rings: Vec<Points> = vec![Vec::new()];
    for (number, line) in (1..).zip(text.lines()) {
        if line.trim().is_empty() {
            rings.push(Vec::new());
            continue;
        }
        if let Some(point) = text::read_line(&format!("{name}:{number}"), line)? {
            rings.last_mut().into_iter().for_each(|ring| ring.push(point));
        }
    }
    rings.retain(|ring| !ring.is_empty());
    // Blocks of text may be either.
    let filled = vec![Shape { rings: rings.clone(), ..Shape::default() }];
    Ok(Shapes { filled, lines: rings, is_plain: true, ..Shapes::default() })
}
