//! Triangles that miss something, by the places where they are.

/// A place: how many triangles are there, and the worst of them.
pub struct Place<'a, T> {
    pub n: usize,
    pub worst: &'a T,
}

/// Groups what is given the worst first: what is nearer than `reach` to the worst of a place belongs there.
pub fn places<'a, T, const N: usize>(all: &'a [T], reach: f64, at: impl Fn(&T) -> [f64; N]) -> Vec<Place<'a, T>> {
    let mut places: Vec<Place<T>> = Vec::new();
    for each in all {
        let is_near = |place: &Place<T>| {
            let (a, b) = (at(place.worst), at(each));
            a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() <= reach * reach
        };
        match places.iter().position(is_near) {
            Some(k) => places[k].n += 1,
            None if places.len() < MOST => places.push(Place { n: 1, worst: each }),
            None => {}
        }
    }
    places
}

/// No more places are told apart.
const MOST: usize = 1000;

/// How many triangles there are at how many places.
pub fn counted<T>(n: usize, places: &[Place<T>]) -> String {
    let s = |n: usize| if n == 1 { "" } else { "s" };
    let (n_places, more) = (places.len(), if places.len() == MOST { " or more" } else { "" });
    format!("{n} triangle{} at {n_places} place{}{more}", s(n), s(n_places))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_one_place() {
        let all = [[0.0, 0.0], [5.0, 0.0], [0.5, 0.5], [5.0, 0.9], [0.0, 9.0]];
        let places = places(&all, 1.0, |&at| at);
        assert_eq!(
            places.iter().map(|place| (place.n, *place.worst)).collect::<Vec<_>>(),
            [(2, [0.0, 0.0]), (2, [5.0, 0.0]), (1, [0.0, 9.0])]
        );
        assert_eq!(counted(5, &places), "5 triangles at 3 places");
    }
}
