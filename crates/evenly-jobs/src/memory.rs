//! What a job takes of memory, so that one that takes too much is refused before it begins.

use evenly::Method;
use evenly_io::{bytes_told, memory_limit};

use crate::error::Error;
use crate::message::Message;

/// A point takes about so many bytes while it is moved or chosen among many, and while it is only put and measured.
const OF_MOVING: u64 = 450;
const OF_PUTTING: u64 = 150;
/// A vertex of a surface, with its triangles, while it is moved.
const OF_VERTEX: u64 = 1000;

/// That so many points by a method fit.
///
/// # Errors
/// They do not; the message has the memory that they take.
pub fn require_points(n_points: usize, method: Method) -> Result<(), Error> {
    let each = if method.holds_much() { OF_MOVING } else { OF_PUTTING };
    require(format!("{n_points} points by {method}"), n_points, each)
}

/// That a surface with so many vertices fits.
pub(crate) fn require_vertices(n_vertices: usize) -> Result<(), Error> {
    require(format!("{n_vertices} vertices"), n_vertices, OF_VERTEX)
}

fn require(what: String, n: usize, each: u64) -> Result<(), Error> {
    let (needed, allowed) = ((n as u64).saturating_mul(each), memory_limit());
    if needed <= allowed {
        return Ok(());
    }
    let message = Message::from(format!("{what} take about {} of memory; ", bytes_told(needed)));
    Err(message.name("memory").text(format!(" allows {}", bytes_told(allowed))).into())
}
