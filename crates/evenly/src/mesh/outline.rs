//! [`Outline`]: what a mesh must keep: the polygon's border, points that stay, lines that become edges.

use std::collections::HashSet;

use glam::DVec2;

use crate::error::Error;
use crate::polygon::{Polygon, meetings};
use crate::space::{Domain, GRID};
use crate::triangulation::{Crossing, Graph, Planar, planar};

/// Points this near to a segment or another point, in normalised units, count as on it.
const ON_BORDER: f64 = 1e-9;
/// The shortest spacing, in normalised units.
pub(super) const LEAST: f64 = 1e3 * GRID;

/// Points, and segments between them; of the border with the inside on their left.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    pub points: Vec<DVec2>,
    /// The points as they were given; those that come later have none.
    pub given: Vec<[f64; 2]>,
    pub segments: Vec<Segment>,
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
    /// The border, in its segment of this number.
    Border(u32),
    /// This line.
    Line(u32),
    /// The base of a cap.
    Base,
}

impl Outline {
    /// The polygon's border, with points that stay and lines that become edges, all in input units.
    ///
    /// # Errors
    /// [`Error::InvalidPolygon`] where a point lies outside, or a line crosses the border or another.
    pub fn new(polygon: &Polygon, fixed: &[[f64; 2]], lines: &[Vec<[f64; 2]>]) -> Result<Self, Error> {
        let domain = polygon.domain();
        let segments = (0..).zip(polygon.border()).map(|(number, &ends)| Segment { ends, of: Of::Border(number) });
        let mut outline = Self { points: polygon.corners().to_vec(), given: polygon.given().to_vec(), segments: segments.collect() };
        for &point in fixed {
            outline.add(&domain, point)?;
        }
        for (number, line) in (0..).zip(lines) {
            let ends = line.iter().map(|&point| outline.add(&domain, point)).collect::<Result<Vec<u32>, Error>>()?;
            for pair in ends.windows(2) {
                outline.add_line([pair[0], pair[1]], number);
            }
        }
        // Where a line runs along the border or another, it is there already.
        let mut seen = HashSet::new();
        outline.segments.retain(|segment| {
            let [a, b] = segment.ends;
            seen.insert([a.min(b), a.max(b)])
        });
        let planar = outline.triangulated(&domain)?;
        let mut is_inside = vec![false; outline.points.len()];
        planar.source.iter().for_each(|&point| is_inside[point as usize] = true);
        let sorted = |ends: [u32; 2]| [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let kept: HashSet<[u32; 2]> = planar.lines.iter().map(|ends| sorted(ends.map(|v| planar.source[v as usize]))).collect();
        let is_lost = |segment: &&Segment| matches!(segment.of, Of::Line(_)) && !kept.contains(&sorted(segment.ends));
        let lost_line = outline.segments.iter().find(is_lost).map(|segment| segment.ends[0] as usize);
        match is_inside.iter().position(|&is| !is).or(lost_line) {
            Some(outside) => Err(does_not_hold(outline.given[outside])),
            None => Ok(outline),
        }
    }

    /// The number of a point, which is a new one unless it is there already. Where it lies on a segment, that becomes two.
    fn add(&mut self, domain: &Domain, given: [f64; 2]) -> Result<u32, Error> {
        let at = domain.normalize(given) + 0.0;
        let back = domain.restore(at);
        let unit = domain.restore_length(1.0);
        if !given.iter().zip(back).all(|(x, back)| (x - back).abs() <= ON_BORDER * unit) {
            return Err(does_not_hold(given));
        }
        if let Some(number) = self.points.iter().position(|p| p.distance(at) < ON_BORDER) {
            return Ok(number as u32);
        }
        let number = self.points.len() as u32;
        let near = |segment: &Segment| {
            let [from, to] = segment.ends.map(|v| self.points[v as usize]);
            let share = ((at - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
            at.distance(from + share * (to - from)) < ON_BORDER
        };
        if let Some(k) = self.segments.iter().position(near) {
            let Segment { ends: [from, to], of } = self.segments[k];
            self.segments[k].ends = [from, number];
            self.segments.push(Segment { ends: [number, to], of });
        }
        self.points.push(at);
        self.given.push(given);
        Ok(number)
    }

    /// Adds a line from point to point, in pieces where others lie on it.
    fn add_line(&mut self, [from, to]: [u32; 2], number: u32) {
        let [start, end] = [from, to].map(|v| self.points[v as usize]);
        let way = end - start;
        let share = |p: DVec2| (p - start).dot(way) / way.length_squared();
        let is_on_it = |p: DVec2| (0.0..=1.0).contains(&share(p)) && p.distance(start + share(p) * way) < ON_BORDER;
        let others = (0..).zip(&self.points).filter(|&(v, &p)| v != from && v != to && is_on_it(p));
        let mut between: Vec<(f64, u32)> = others.map(|(v, &p)| (share(p), v)).collect();
        between.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut at = from;
        for next in between.into_iter().map(|(_, v)| v).chain([to]).filter(|&next| next != from) {
            self.segments.push(Segment { ends: [at, next], of: Of::Line(number) });
            at = next;
        }
    }

    /// The triangulation of what the border encloses.
    ///
    /// # Errors
    /// [`Error::InvalidPolygon`] where segments cross.
    pub fn triangulated(&self, domain: &Domain) -> Result<Planar, Error> {
        let of_kind = |is_line: bool| -> Vec<[u32; 2]> {
            self.segments.iter().filter(|segment| matches!(segment.of, Of::Line(_)) == is_line).map(|segment| segment.ends).collect()
        };
        planar(Graph { points: &self.points, border: &of_kind(false), lines: &of_kind(true) }).map_err(|Crossing(crossed)| {
            let all: Vec<[u32; 2]> = self.segments.iter().map(|segment| segment.ends).collect();
            let met = meetings(&self.points, &all, &crossed).first().copied();
            let at = domain.restore(met.unwrap_or(self.points[crossed[0][0] as usize]));
            Error::InvalidPolygon {
                problem: "has a line that crosses another, or the border; or its border meets itself in rounding".into(),
                at,
            }
        })
    }
}

fn does_not_hold(at: [f64; 2]) -> Error {
    Error::InvalidPolygon { problem: "does not hold a fixed point or a line".into(), at }
}
