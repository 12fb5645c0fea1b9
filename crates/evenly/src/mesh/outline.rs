//! [`Outline`]: what a mesh must keep: the polygon's boundary, points that stay, lines that become edges.

use std::collections::HashSet;

use glam::DVec2;

use super::MeshRegion;
use super::arrangement::{ON_BOUNDARY, Places, arranged, within};
use crate::error::Error;
use crate::polygon::Polygon;
use crate::space::{Domain, GRID, snap};
use crate::triangulation::{Crossing, Graph, Planar, planar};

/// The shortest spacing, in normalised units.
pub(super) const LEAST: f64 = 1e3 * GRID;
/// How far outside of the frame lines are looked at, in normalised units.
const MARGIN: f64 = 0.01;
/// Where segments cross they are split; rounding then moves them, so that they may cross again.
const MOST_SPLITS: usize = 8;

/// Points, and segments between them; of the boundary with the inside on their left.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    pub points: Vec<DVec2>,
    /// The points as they were given; those that come later have none.
    pub given: Vec<[f64; 2]>,
    pub segments: Vec<Segment>,
    /// What was done to lines, in plain words.
    pub notes: Vec<String>,
}

/// From one point to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub ends: [u32; 2],
    pub of: Of,
}

/// What a segment is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// The boundary, in its segment of this number.
    Boundary(u32),
    /// This line.
    Line(u32),
    /// The base of a cap.
    Base,
}

impl Outline {
    /// The ends of all segments, to which what lies on them keeps.
    pub fn rails(&self) -> Vec<[DVec2; 2]> {
        self.segments.iter().map(|segment| segment.ends.map(|v| self.points[v as usize])).collect()
    }

    /// The polygon's boundary, with points that stay and lines that become edges, all in input units. Lines
    /// are split where they cross, and clipped at the boundary. The regions' outlines are lines, too, and
    /// have the numbers after the others'.
    ///
    /// # Errors
    /// [`Error::NotInside`] where a point, or all of all lines, lies outside.
    pub fn new(polygon: &Polygon, fixed: &[[f64; 2]], lines: &[Vec<[f64; 2]>], regions: &[MeshRegion]) -> Result<Self, Error> {
        let domain = polygon.domain();
        let boundary = (0..).zip(polygon.boundary()).map(|(number, &ends)| Segment { ends, of: Of::Boundary(number) });
        let mut segments: Vec<Segment> = boundary.collect();
        let mut places = Places::new(polygon.corners());
        let mut given = polygon.given().to_vec();
        let mut number = |at: DVec2, input: [f64; 2]| {
            let v = places.number(at + 0.0);
            if v as usize == given.len() {
                given.push(input);
            }
            v
        };

        // All points, and segments between them.
        let mut stay = Vec::new();
        for &point in fixed {
            let at = domain.normalize(point);
            let unit = domain.restore_length(1.0);
            if !point.iter().zip(domain.restore(at)).all(|(x, back)| (x - back).abs() <= ON_BOUNDARY * unit) {
                return Err(Error::NotInside { what: "fixed point", at: point });
            }
            stay.push(number(at, point));
        }
        let (low, high) = (DVec2::splat(-MARGIN), domain.size + MARGIN);
        let outlines = (lines.len() as u32..)
            .zip(regions)
            .flat_map(|(line, region)| region.polygon.rings().iter().map(move |ring| (line, closed(ring))));
        let all = (0..).zip(lines.iter().cloned()).chain(outlines);
        let mut is_cut = false;
        for (line, points) in all {
            for pair in points.windows(2) {
                let ends = [pair[0], pair[1]].map(|p| (p, domain.place(p)));
                let Some(part) = within(ends.map(|(_, at)| at), low, high) else {
                    is_cut = true;
                    continue;
                };
                let is_given = |at: DVec2| ends.iter().find(|(_, end)| *end == at).map(|&(p, _)| p);
                let ends = part.map(|at| number(snap(at), is_given(at).unwrap_or_else(|| domain.restore(at))));
                if ends[0] != ends[1] {
                    segments.push(Segment { ends, of: Of::Line(line) });
                }
            }
        }

        // Pieces that do not cross.
        let mut outline = Self { points: Vec::new(), given, segments, notes: Vec::new() };
        let mut n_splits = 0;
        let planar = loop {
            outline.segments = arranged(&mut places, &outline.segments);
            outline.points.clone_from(&places.points);
            n_splits += 1;
            match outline.triangulated(&domain) {
                Err(_) if n_splits < MOST_SPLITS => {}
                found => break found?,
            }
        };
        let restored = outline.points[outline.given.len()..].iter().map(|&at| domain.restore(at));
        outline.given.extend(restored.collect::<Vec<_>>());

        // Those inside.
        let mut is_inside = vec![false; outline.points.len()];
        planar.source.iter().for_each(|&point| is_inside[point as usize] = true);
        if let Some(&outside) = stay.iter().find(|&&v| !is_inside[v as usize]) {
            return Err(Error::NotInside { what: "fixed point", at: outline.given[outside as usize] });
        }
        outline.keep_lines_inside(&planar, lines, is_cut)?;
        outline.keep_points(&stay);
        Ok(outline)
    }

    /// Leaves out what of lines lies outside, and says so, as where some of it has gone before.
    fn keep_lines_inside(&mut self, planar: &Planar, lines: &[Vec<[f64; 2]>], is_cut: bool) -> Result<(), Error> {
        let sorted = |ends: [u32; 2]| [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let kept: HashSet<[u32; 2]> = planar.lines.iter().map(|ends| sorted(ends.map(|v| planar.source[v as usize]))).collect();
        let n = self.segments.iter().filter(|segment| matches!(segment.of, Of::Line(line) if (line as usize) < lines.len())).count();
        self.segments.retain(|segment| !matches!(segment.of, Of::Line(_)) || kept.contains(&sorted(segment.ends)));
        if lines.is_empty() {
            return Ok(());
        }
        let is_there = |line: usize| self.segments.iter().any(|segment| segment.of == Of::Line(line as u32));
        let is_line = |segment: &Segment| matches!(segment.of, Of::Line(line) if (line as usize) < lines.len());
        let has_lines = self.segments.iter().any(is_line);
        if !is_cut && self.segments.iter().filter(|segment| is_line(segment)).count() == n {
            return Ok(());
        }
        let at = lines.iter().flatten().next().copied();
        if let (false, Some(at)) = (has_lines, at) {
            return Err(Error::NotInside { what: "lines, that from", at });
        }
        let n_outside = (0..lines.len()).filter(|&line| !is_there(line)).count();
        self.notes.push(match n_outside {
            0 => "lines reach outside of the polygon: clipped at its boundary".into(),
            n => format!("{n} of {} lines lie outside of the polygon, or on its boundary: left out; others are clipped there", lines.len()),
        });
        Ok(())
    }

    /// Leaves out points that nothing needs any more.
    fn keep_points(&mut self, stay: &[u32]) {
        let mut is_kept = vec![false; self.points.len()];
        self.segments.iter().flat_map(|segment| &segment.ends).chain(stay).for_each(|&v| is_kept[v as usize] = true);
        let mut number = vec![0; self.points.len()];
        let kept = (0..number.len()).filter(|&v| is_kept[v]);
        (0..).zip(kept).for_each(|(n, v)| number[v] = n);
        let mut is_kept_too = is_kept.iter();
        self.points.retain(|_| is_kept_too.next().copied().unwrap_or_default());
        let mut is_kept = is_kept.iter();
        self.given.retain(|_| is_kept.next().copied().unwrap_or_default());
        self.segments.iter_mut().for_each(|segment| segment.ends = segment.ends.map(|v| number[v as usize]));
    }

    /// The triangulation of what the boundary encloses.
    ///
    /// # Errors
    /// [`Error::InvalidPolygon`] where segments cross.
    pub fn triangulated(&self, domain: &Domain) -> Result<Planar, Error> {
        let of_kind = |is_line: bool| -> Vec<[u32; 2]> {
            self.segments.iter().filter(|segment| matches!(segment.of, Of::Line(_)) == is_line).map(|segment| segment.ends).collect()
        };
        planar(Graph { points: &self.points, boundary: &of_kind(false), lines: &of_kind(true) }).map_err(|Crossing(crossed)| {
            let at = domain.restore(self.points[crossed[0][0] as usize]);
            Error::InvalidPolygon { problem: "has a boundary or a line that meets another in rounding".into(), at }
        })
    }
}

/// A ring that ends where it begins.
fn closed(ring: &[[f64; 2]]) -> Vec<[f64; 2]> {
    ring.iter().chain(ring.first()).copied().collect()
}
