//! Points from a file or stdin, brought into a domain.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use evenly::{PointSet, Space};
use evenly_io::{Columns, Table};

use crate::talk::say;

/// Refuses to read stdin twice.
pub fn require_one_stdin<'a>(inputs: impl IntoIterator<Item = &'a PathBuf>) -> anyhow::Result<()> {
    if inputs.into_iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        bail!("- is stdin, which can be read once");
    }
    Ok(())
}

/// Reads points; if some lay outside a torus and were wrapped, it says so.
pub fn read_and_tell(input: &Path, space: &Space) -> anyhow::Result<PointSet> {
    let (points, note) = read(input, space)?;
    if let Some(note) = note {
        say(format_args!("note: {}: {note}", input.display()));
    }
    Ok(points)
}

/// Reads points; on a torus also a note if some lay outside and were wrapped.
pub fn read(input: &Path, space: &Space) -> anyhow::Result<(PointSet, Option<String>)> {
    read_with_columns(input, space).map(|(points, note, _)| (points, note))
}

/// As [`read`], with the other columns of the file.
pub fn read_with_columns(input: &Path, space: &Space) -> anyhow::Result<(PointSet, Option<String>, Columns)> {
    let Table { positions, columns } = evenly_io::read_table(input)?;
    let n_outside = positions.iter().filter(|p| is_outside(space, p)).count();
    let points = PointSet::new(space, positions).with_context(|| input.display().to_string())?;
    let lie = if n_outside == 1 { "1 point lies".into() } else { format!("{n_outside} points lie") };
    let were = if n_outside == 1 { "was" } else { "were" };
    let note = format!("{lie} outside the torus {space} and {were} wrapped into it; are --size and --origin right?");
    Ok((points, (n_outside > 0).then_some(note), columns))
}

fn is_outside(space: &Space, p: &[f64; 2]) -> bool {
    let (origin, size) = (space.origin(), space.size());
    (0..2).any(|axis| p[axis] < origin[axis] || p[axis] > origin[axis] + size[axis])
}

/// Points that stay, and after them the others that do not share a place with one.
pub fn joined(fixed: &PointSet, points: PointSet) -> anyhow::Result<PointSet> {
    if fixed.n_points() == 0 {
        return Ok(points);
    }
    let bits = |p: &[f64; 2]| p.map(|x| (x + 0.0).to_bits());
    let taken: HashSet<[u64; 2]> = fixed.positions().iter().map(bits).collect();
    let others = points.positions().iter().filter(|p| !taken.contains(&bits(p)));
    let all = fixed.positions().iter().chain(others).copied().collect();
    Ok(PointSet::new(points.space(), all)?.with_fixed(fixed.n_points())?)
}
