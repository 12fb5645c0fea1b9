//! Where rings cross themselves or each other. Outlines that were rounded do so by a little: cut at the crossings, they enclose what they did. Where much is in doubt, nobody
//! knows what was meant.

use std::collections::{HashMap, HashSet};

use glam::DVec2;

use crate::predicates::is_left_turn;
use crate::space::snap;

/// The share of the area that may be in doubt.
const DOUBT: f64 = 1e-4;

/// A place where two segments cross.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    pub at: DVec2,
    pub segments: [[u32; 2]; 2],
}

/// Where `crossed` segments cross others.
pub(crate) fn meetings(corners: &[DVec2], sides: &[[u32; 2]], crossed: &[[u32; 2]]) -> Vec<Meeting> {
    let mut meetings = Vec::new();
    for &segment in crossed {
        let [a, b] = segment.map(|v| corners[v as usize]);
        for &other in sides {
            let [c, d] = other.map(|v| corners[v as usize]);
            let is_between = |from: DVec2, to: DVec2, p: DVec2, q: DVec2| {
                is_left_turn(to - from, p - from) && is_left_turn(q - from, to - from)
                    || is_left_turn(to - from, q - from) && is_left_turn(p - from, to - from)
            };
            if is_between(a, b, c, d) && is_between(c, d, a, b) {
                let (at_a, at_b) = ((d - c).perp_dot(a - c), (d - c).perp_dot(b - c));
                meetings.push(Meeting { at: snap(a + (b - a) * (at_a / (at_a - at_b))), segments: [segment, other] });
            }
        }
    }
    meetings
}

/// Puts the places into the rings as corners.
pub(super) fn cut<'a>(rings: impl Iterator<Item = &'a mut Vec<u32>>, corners: &mut Vec<DVec2>, meetings: &[Meeting]) {
    let bits = |p: DVec2| [p.x.to_bits(), p.y.to_bits()];
    let mut numbers: HashMap<[u64; 2], u32> = corners.iter().map(|&p| bits(p)).zip(0..).collect();
    let mut on: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for meeting in meetings {
        let number = *numbers.entry(bits(meeting.at + 0.0)).or_insert_with(|| {
            corners.push(meeting.at + 0.0);
            corners.len() as u32 - 1
        });
        for segment in meeting.segments {
            let [a, b] = segment;
            on.entry([a.min(b), a.max(b)]).or_default().push(number);
        }
    }
    for ring in rings {
        let mut cut = Vec::with_capacity(ring.len());
        for (k, &from) in ring.iter().enumerate() {
            let to = ring[(k + 1) % ring.len()];
            cut.push(from);
            let mut between = on.get(&[from.min(to), from.max(to)]).cloned().unwrap_or_default();
            let distance = |v: &u32| corners[*v as usize].distance_squared(corners[from as usize]);
            between.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
            between.retain(|&v| v != from && v != to);
            between.dedup();
            cut.extend(between);
        }
        *ring = cut;
    }
}

/// Twice the area that a ring encloses, negative if it runs clockwise.
pub(super) fn twice_area(ring: &[u32], corners: &[DVec2]) -> f64 {
    let Some(&first) = ring.first() else { return 0.0 };
    let from = corners[first as usize];
    let ways = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b].map(|v| corners[v as usize] - from));
    ways.map(|[u, v]| u.perp_dot(v)).sum()
}

/// Whether rings that cross enclose, cut, about what they say: `twice_inside`, whose border's segments have it on their left. A ring says its area, for the inside or against
/// it as most of its length does.
pub(super) fn is_minor<'a>(
    rings: impl Iterator<Item = &'a [u32]>,
    corners: &[DVec2],
    border: &HashSet<[u32; 2]>,
    twice_inside: f64,
) -> bool {
    let of_ring = |ring: &[u32]| {
        let area = twice_area(ring, corners);
        let sides = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]);
        let for_inside: f64 = sides
            .map(|[a, b]| {
                let length = corners[a as usize].distance(corners[b as usize]);
                f64::from(u8::from(border.contains(&[a, b]))) * length - f64::from(u8::from(border.contains(&[b, a]))) * length
            })
            .sum();
        area * for_inside.signum()
    };
    let said: f64 = rings.map(of_ring).sum();
    (said - twice_inside).abs() <= DOUBT * twice_inside
}
