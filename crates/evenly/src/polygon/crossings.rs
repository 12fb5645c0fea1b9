//! Where segments cross.

use glam::DVec2;

use crate::predicates::is_left_turn;
use crate::space::snap;

/// The places where `crossed` segments cross others.
pub(crate) fn meetings(corners: &[DVec2], sides: &[[u32; 2]], crossed: &[[u32; 2]]) -> Vec<DVec2> {
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
                meetings.push(snap(a + (b - a) * (at_a / (at_a - at_b))));
            }
        }
    }
    meetings
}
