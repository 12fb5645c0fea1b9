//! [`Polygon`]: what rings of straight segments enclose, with holes, in one part or several.

mod clean;
mod crossings;

use std::collections::{HashMap, HashSet};

use glam::DVec2;

use self::clean::{Corner, clean};
pub(crate) use self::crossings::meetings;
use self::crossings::{Meeting, cut, is_minor, twice_area};
use crate::error::Error;
use crate::space::{Domain, Rectangle, Region, Space};
use crate::triangulation::{Crossing, Graph, HalfEdges, Planar, next, planar};

/// A bounded domain with a border of straight segments. It may have holes and several parts, and parts may touch in points.
///
/// Its border is clean: no segment crosses another, no corner is there twice in a row, and none lies on a straight line, unless another ring touches it there.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    rings: Vec<Vec<[f64; 2]>>,
    frame: Rectangle,
    area: f64,
    repairs: Vec<String>,
    /// Distinct corners in normalised coordinates, and as they were given.
    corners: Vec<DVec2>,
    given: Vec<[f64; 2]>,
    /// The border's segments, by their corners; the inside is on their left.
    border: Vec<[u32; 2]>,
}

/// Clean rings stay as they are from the second time on, and where parts touch from the third.
const MOST_CLEANINGS: usize = 4;
/// Rings are cut anew so often where cuts, rounded, lead to new crossings.
const MOST_CUTS: usize = 5;
/// With more crossings than this nobody knows what was meant.
const MOST_CROSSINGS: usize = 1000;

/// What a ring is said to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    Outer,
    Hole,
    /// An odd number of rings enclose the inside.
    Any,
}

impl Polygon {
    /// What the parts enclose: of each the first ring is the outer one, the others are its holes. Rings may be closed by their first point once more.
    ///
    /// What can be repaired without doubt is, and told by [`Self::repairs`]: doubled and collinear points, spikes, rings without an area, rings that run the wrong way,
    /// segments that two parts share, crossings that change the area by less than a ten-thousandth of it.
    ///
    /// # Errors
    /// [`Error::InvalidPolygon`] where segments cross by more, a hole is not inside or a part inside of another, nothing is enclosed, or a coordinate is not finite;
    /// [`Error::InvalidSpace`] where f64 cannot tell its width from nothing.
    ///
    /// # Example
    /// ```
    /// let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
    /// let polygon = evenly::Polygon::new(vec![vec![square(0.0, 3.0), square(1.0, 2.0)]])?;
    /// assert_eq!((polygon.area(), polygon.rings().len()), (8.0, 2));
    /// # Ok::<(), evenly::Error>(())
    /// ```
    pub fn new(parts: Vec<Vec<Vec<[f64; 2]>>>) -> Result<Self, Error> {
        let roles = parts.iter().flat_map(|part| (0..part.len()).map(|k| if k == 0 { Role::Outer } else { Role::Hole })).collect();
        Self::cleaned(parts.into_iter().flatten().collect(), roles)
    }

    /// What an odd number of the rings enclose, whichever way they run.
    ///
    /// # Errors
    /// As [`Self::new`], but for what is inside of what.
    pub fn from_rings(rings: Vec<Vec<[f64; 2]>>) -> Result<Self, Error> {
        let roles = vec![Role::Any; rings.len()];
        Self::cleaned(rings, roles)
    }

    /// Cleans rings until they stay as they are: so a polygon is the same, to the bit, as that of its own rings.
    fn cleaned(given: Vec<Vec<[f64; 2]>>, roles: Vec<Role>) -> Result<Self, Error> {
        let mut polygon = Self::of(&given, &roles)?;
        let mut before = given;
        for _ in 0..MOST_CLEANINGS {
            if polygon.rings == before {
                break;
            }
            before = polygon.rings;
            polygon = Self { repairs: polygon.repairs, ..Self::of(&before, &vec![Role::Any; before.len()])? };
        }
        Ok(polygon)
    }

    fn of(given: &[Vec<[f64; 2]>], roles: &[Role]) -> Result<Self, Error> {
        let frame = frame(given)?;
        let domain = Space::from(frame).domain();
        let mut repairs = Vec::new();

        // Clean rings, and their corners by number.
        let clean = clean(given, &domain, &mut repairs);
        let (mut corners, mut inputs, mut numbers) = (Vec::new(), Vec::new(), HashMap::new());
        let mut rings: Vec<(Role, Vec<u32>)> = clean
            .into_iter()
            .map(|(ring, kept)| {
                let number = |Corner { at, input }: Corner| {
                    *numbers.entry([at.x.to_bits(), at.y.to_bits()]).or_insert_with(|| {
                        corners.push(at);
                        inputs.push(input);
                        corners.len() as u32 - 1
                    })
                };
                (roles[ring], kept.into_iter().map(number).collect())
            })
            .collect();
        let Some(&first) = inputs.first() else {
            let at = given.iter().flatten().next().copied().unwrap_or_default();
            return Err(Error::InvalidPolygon { problem: "encloses nothing".into(), at });
        };

        // What they enclose.
        let mut planar = Self::enclosed(&corners, &rings);
        let mut crossing = None;
        for _ in 0..MOST_CUTS {
            let Err(Crossing(crossed)) = &planar else { break };
            let sides: Vec<[u32; 2]> = rings.iter().flat_map(|(_, ring)| segments(ring)).collect();
            let found = meetings(&corners, &sides, crossed);
            let error = || crosses(&domain, &corners, found.first(), crossed[0]);
            let (_, n_cuts) = crossing.get_or_insert_with(|| (error(), 0));
            *n_cuts += found.len();
            if found.is_empty() || found.len() > MOST_CROSSINGS {
                break;
            }
            cut(rings.iter_mut().map(|(_, ring)| ring), &mut corners, &found);
            planar = Self::enclosed(&corners, &rings);
        }
        inputs.extend(corners[inputs.len()..].iter().map(|&at| domain.restore(at)));
        let planar = match (planar, &crossing) {
            (Ok(planar), _) => planar,
            (Err(_), Some((error, _))) => return Err(error.clone()),
            (Err(Crossing(crossed)), None) => return Err(crosses(&domain, &corners, None, crossed[0])),
        };
        let twice_inside: f64 = planar.half_edges.triangles().map(|[a, b, c]| twice_area(&[a, b, c], &planar.positions)).sum();
        if planar.half_edges.n_triangles() == 0 {
            return Err(Error::InvalidPolygon { problem: "encloses nothing".into(), at: first });
        }
        let loops = loops(&planar);
        let border: Vec<[u32; 2]> = loops.iter().flat_map(|ring| segments(ring)).collect();
        if let Some((error, n_cuts)) = crossing {
            let inside: HashSet<[u32; 2]> = border.iter().copied().collect();
            if !is_minor(rings.iter().map(|(_, ring)| &ring[..]), &corners, &inside, twice_inside) {
                return Err(error);
            }
            repairs.push(format!(
                "the border crosses itself by a little in {n_cuts} places, the first {}; it was cut there",
                place_of(&error)
            ));
        }
        check_roles(&rings, &corners, &inputs, &border, &mut repairs)?;
        let mut seen = HashSet::new();
        let n_shared = rings.iter().flat_map(|(_, ring)| segments(ring)).filter(|&[a, b]| !seen.insert([a.min(b), a.max(b)])).count();
        if n_shared > 0 {
            repairs.push(format!("{n_shared} segments that two rings share were left out"));
        }
        let unit = domain.restore_length(1.0);
        let rings = loops.iter().map(|ring| ring.iter().map(|&v| inputs[v as usize]).collect()).collect();

        // Only what is on the border is a corner.
        let mut number = vec![None; corners.len()];
        let (mut kept, mut given) = (Vec::new(), Vec::new());
        for &v in border.iter().flatten() {
            number[v as usize].get_or_insert_with(|| {
                kept.push(corners[v as usize]);
                given.push(inputs[v as usize]);
                kept.len() as u32 - 1
            });
        }
        let border = border.into_iter().map(|segment| segment.map(|v| number[v as usize].unwrap_or_default())).collect();
        Ok(Self { rings, frame, area: 0.5 * twice_inside * unit * unit, repairs, corners: kept, given, border })
    }

    fn enclosed(corners: &[DVec2], rings: &[(Role, Vec<u32>)]) -> Result<Planar, Crossing> {
        let sides: Vec<[u32; 2]> = rings.iter().flat_map(|(_, ring)| segments(ring)).collect();
        planar(Graph { points: corners, border: &sides, lines: &[] })
    }

    /// The rings, in input units, without a closing point: the inside is on their left, so outer ones run counter-clockwise, and holes clockwise.
    pub fn rings(&self) -> &[Vec<[f64; 2]>] {
        &self.rings
    }

    /// The area inside, in input units squared.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The smallest rectangle around it.
    pub fn frame(&self) -> &Rectangle {
        &self.frame
    }

    /// What was repaired, in plain words.
    pub fn repairs(&self) -> &[String] {
        &self.repairs
    }

    /// The frame in normalised coordinates.
    pub(crate) fn domain(&self) -> Domain {
        Space::from(self.frame).domain()
    }

    /// Distinct corners in normalised coordinates.
    pub(crate) fn corners(&self) -> &[DVec2] {
        &self.corners
    }

    /// The corners as they were given.
    pub(crate) fn given(&self) -> &[[f64; 2]] {
        &self.given
    }

    /// The border's segments, by their corners; the inside is on their left.
    pub(crate) fn border(&self) -> &[[u32; 2]] {
        &self.border
    }
}

impl From<&Polygon> for Space {
    /// The inside of the polygon, for points.
    fn from(polygon: &Polygon) -> Self {
        let Polygon { corners, border, .. } = polygon;
        // Its border is clean, so nothing crosses.
        let inside = planar(Graph { points: corners, border, lines: &[] }).unwrap_or_default();
        let part_of = inside.half_edges.components();
        let mut parts = vec![Vec::new(); part_of.iter().max().map_or(0, |&last| last as usize + 1)];
        for (corners, &part) in inside.half_edges.triangles().zip(&part_of) {
            parts[part as usize].push(corners.map(|v| inside.positions[v as usize]));
        }
        // Each segment belongs to the part on its left.
        let half_edges = (0..inside.half_edges.origin.len() as u32).filter(|&h| inside.half_edges.is_border(h));
        let ends = |h: u32| [inside.half_edges.origin[h as usize], inside.half_edges.target(h)].map(|v| inside.source[v as usize]);
        let by_ends: HashMap<[u32; 2], u32> = half_edges.map(|h| (ends(h), part_of[h as usize / 3])).collect();
        let part = |ends: &[u32; 2]| by_ends.get(ends).copied().unwrap_or_default();
        let segments = border.iter().map(|ends| (ends.map(|v| corners[v as usize]), part(ends))).collect();
        Region::new(polygon.frame, polygon.rings.clone(), polygon.area, parts, segments).into()
    }
}

/// The rectangle around all points.
fn frame(rings: &[Vec<[f64; 2]>]) -> Result<Rectangle, Error> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for &at in rings.iter().flatten() {
        if !at.iter().all(|x| x.is_finite()) {
            return Err(Error::InvalidPolygon { problem: "has a coordinate that is not finite".into(), at });
        }
        for axis in 0..2 {
            (low[axis], high[axis]) = (low[axis].min(at[axis]), high[axis].max(at[axis]));
        }
    }
    if low[0] > high[0] {
        return Err(Error::InvalidSpace("the polygon has no points".into()));
    }
    Rectangle::new(low, [high[0] - low[0], high[1] - low[1]])
}

/// The segments of a ring.
fn segments(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]])
}

/// The rings of points around a triangulation's border, with the inside on their left; each begins with its first point, and they come in the order of these: so what is clean stays as it is.
fn loops(planar: &Planar) -> Vec<Vec<u32>> {
    let Planar { half_edges, source, .. } = planar;
    let mut is_seen = vec![false; half_edges.origin.len()];
    let mut loops = Vec::new();
    for start in (0..half_edges.origin.len() as u32).filter(|&h| half_edges.is_border(h)) {
        let mut ring = Vec::new();
        let mut h = start;
        while !std::mem::replace(&mut is_seen[h as usize], true) {
            ring.push(source[half_edges.origin[h as usize] as usize]);
            h = following(half_edges, h);
        }
        let first = (0..ring.len()).min_by_key(|&k| [ring[k], ring[(k + 1) % ring.len()]]);
        if let Some(first) = first {
            ring.rotate_left(first);
            loops.push(ring);
        }
    }
    loops.sort();
    loops
}

/// The half-edge of the border that leaves where `h`, on the border, arrives.
fn following(half_edges: &HalfEdges, h: u32) -> u32 {
    let mut at = next(h);
    while !half_edges.is_border(at) {
        at = next(half_edges.twin[at as usize]);
    }
    at
}

/// That segments cross: where, if that is known, or one of them.
fn crosses(domain: &Domain, corners: &[DVec2], meeting: Option<&Meeting>, segment: [u32; 2]) -> Error {
    let show = |[a, b]: [u32; 2]| {
        let [[ax, ay], [bx, by]] = [a, b].map(|v| domain.restore(corners[v as usize]));
        format!("({ax}, {ay}) to ({bx}, {by})")
    };
    let [a, b] = segment.map(|v| corners[v as usize]);
    let (problem, at) = match meeting {
        Some(&Meeting { at, segments: [one, other] }) => (format!("crosses itself, {} and {}", show(one), show(other)), at),
        None => (format!("crosses itself, {} and another segment", show(segment)), 0.5 * (a + b)),
    };
    Error::InvalidPolygon { problem, at: domain.restore(at) }
}

fn place_of(error: &Error) -> String {
    if let Error::InvalidPolygon { at: [x, y], .. } = error { format!("at ({x}, {y})") } else { String::new() }
}

/// Checks that outer rings have the inside within, and holes without.
fn check_roles(
    rings: &[(Role, Vec<u32>)],
    corners: &[DVec2],
    inputs: &[[f64; 2]],
    border: &[[u32; 2]],
    repairs: &mut Vec<String>,
) -> Result<(), Error> {
    let border: HashSet<[u32; 2]> = border.iter().copied().collect();
    let mut n_turned = 0;
    for (role, ring) in rings.iter().filter(|(role, _)| *role != Role::Any) {
        let is_counter_clockwise = twice_area(ring, corners) > 0.0;
        let is_outer = *role == Role::Outer;
        // A segment of the border runs with the ring, or against it.
        let side = segments(ring).find_map(|[a, b]| {
            let is_left = border.contains(&[a, b]);
            (is_left || border.contains(&[b, a])).then_some(is_left)
        });
        if side.is_some_and(|is_left| (is_left == is_counter_clockwise) != is_outer) {
            let what =
                if is_outer { "has an outer ring that lies inside of another" } else { "has a hole that lies outside, or in another hole" };
            return Err(Error::InvalidPolygon { problem: what.into(), at: inputs[ring[0] as usize] });
        }
        n_turned += usize::from(is_counter_clockwise != is_outer);
    }
    if n_turned > 0 {
        repairs.push(format!("{n_turned} rings ran the wrong way, and were turned"));
    }
    Ok(())
}
