//! What shapes enclose together: laws against an area that is counted cell by cell, and drawings and
//! maps as people have them.

use evenly::{FillRule, Polygon, Shape};
use proptest::prelude::*;

type Ring = Vec<[f64; 2]>;

fn rectangle(low: [f64; 2], high: [f64; 2]) -> Ring {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

fn square(low: f64, high: f64) -> Ring {
    rectangle([low; 2], [high; 2])
}

/// The rings, each from its least corner on, in order.
fn sorted(polygon: &Polygon) -> Vec<Ring> {
    let less = |a: &[f64; 2], b: &[f64; 2]| a.partial_cmp(b).unwrap();
    let mut rings = polygon.rings().to_vec();
    for ring in &mut rings {
        let least = (0..ring.len()).min_by(|&i, &k| less(&ring[i], &ring[k])).unwrap();
        ring.rotate_left(least);
    }
    rings.sort_by(|a, b| a.partial_cmp(b).unwrap());
    rings
}

fn area_of(parts: Vec<Vec<Ring>>) -> f64 {
    Polygon::new(parts).unwrap().area()
}

/// Turned, moved and scaled as a map may be.
fn placed(ring: &Ring) -> Ring {
    let (sin, cos) = 0.7f64.sin_cos();
    ring.iter().map(|[x, y]| [5e5 + 31.0 * (cos * x - sin * y), 4e6 + 31.0 * (sin * x + cos * y)]).collect()
}

/// Boxes with corners on whole numbers, each with its even-odd rings.
fn boxes() -> impl Strategy<Value = Vec<Vec<[[i32; 2]; 2]>>> {
    let span = || (0..8i32, 1..5i32).prop_map(|(from, width)| [from, from + width]);
    let rings = prop::collection::vec((span(), span()).prop_map(|(x, y)| [x, y]), 1..4);
    prop::collection::vec(rings, 1..7)
}

/// How many unit cells are inside, by the rule's own words.
fn counted(shapes: &[Vec<[[i32; 2]; 2]>], rule: FillRule) -> usize {
    let cells = (0..12).flat_map(|x| (0..12).map(move |y| [x, y]));
    let is_in = |span: &[[i32; 2]; 2], cell: [i32; 2]| (0..2).all(|axis| (span[axis][0]..span[axis][1]).contains(&cell[axis]));
    let inside = |cell: [i32; 2]| {
        shapes.iter().any(|shape| {
            // A ring that is there twice counts once.
            let mut rings: Vec<_> = shape.iter().filter(|span| is_in(span, cell)).collect();
            if rule == FillRule::EvenOdd {
                rings.sort();
                rings.dedup();
            }
            let n = rings.len();
            if rule == FillRule::EvenOdd { n % 2 == 1 } else { n > 0 }
        })
    };
    cells.filter(|&cell| inside(cell)).count()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]
    #[test]
    fn the_area_is_that_of_cells_inside(boxes in boxes(), is_even_odd: bool, is_placed: bool) {
        let rule = if is_even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
        let ring = |[x, y]: &[[i32; 2]; 2]| {
            let ring = rectangle([x[0], y[0]].map(f64::from), [x[1], y[1]].map(f64::from));
            if is_placed { placed(&ring) } else { ring }
        };
        let shapes: Vec<Shape> = boxes.iter().map(|shape| Shape { rings: shape.iter().map(ring).collect(), rule, clips: Vec::new() }).collect();
        let expected = counted(&boxes, rule) as f64 * if is_placed { 31.0 * 31.0 } else { 1.0 };
        match Polygon::of_shapes(&shapes) {
            Ok(polygon) => {
                prop_assert!((polygon.area() - expected).abs() <= 1e-9 * expected, "{}, expected {expected}", polygon.area());
                let again = Polygon::from_rings(polygon.rings().to_vec()).unwrap();
                prop_assert_eq!(again.rings(), polygon.rings());
            }
            Err(_) => prop_assert_eq!(expected, 0.0),
        }
    }

    #[test]
    fn a_union_forgets_order_and_copies(boxes in boxes(), turn in 0usize..7) {
        let part = |shape: &Vec<[[i32; 2]; 2]>| {
            let [x, y] = shape[0];
            vec![rectangle([x[0], y[0]].map(f64::from), [x[1], y[1]].map(f64::from))]
        };
        let parts: Vec<Vec<Ring>> = boxes.iter().map(part).collect();
        let mut turned = parts.clone();
        turned.rotate_left(turn % parts.len());
        turned.extend(parts.clone());
        let (one, other) = (Polygon::new(parts).unwrap(), Polygon::new(turned).unwrap());
        prop_assert_eq!(sorted(&one), sorted(&other));
    }
}

#[test]
fn doubled_and_overlapping_parts_are_united() {
    let copies = |shift: f64| vec![vec![square(0.0, 6.0)], vec![square(-shift, 6.0 + shift)], vec![rectangle([10.0, 0.0], [12.0, 2.0])]];
    assert_eq!(area_of(copies(0.0)), 40.0);
    // Copies that differ by little, crossing or not.
    for shift in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, -1e-7] {
        let mut crossing = copies(shift);
        crossing[1][0].iter_mut().for_each(|p| p[1] = 3.0 + (p[1] - 3.0) * (3.0 - shift) / (3.0 + shift));
        for parts in [copies(shift), crossing] {
            let area = area_of(parts);
            assert!((area - 40.0).abs() < 30.0 * shift.abs() + 1e-9, "{shift}: {area}");
        }
    }
    // A hole that is there twice, exactly and nearly.
    assert_eq!(area_of(vec![vec![square(0.0, 6.0), square(1.0, 3.0), square(1.0, 3.0)]]), 32.0);
    let nearly = area_of(vec![vec![square(0.0, 6.0), square(1.0, 3.0), square(1.0 - 1e-7, 3.0)]]);
    assert!((nearly - 32.0).abs() < 1e-5, "{nearly}");
    // One part's hole does not cut another.
    assert_eq!(area_of(vec![vec![square(0.0, 6.0), square(1.0, 3.0)], vec![square(0.0, 6.0)]]), 36.0);
    assert_eq!(area_of(vec![vec![square(0.0, 6.0), square(1.0, 3.0)], vec![square(2.0, 4.0)]]), 33.0);
    // Islands in holes, as rings of one part.
    assert_eq!(area_of(vec![vec![square(0.0, 6.0), square(1.0, 5.0), square(2.0, 4.0)]]), 24.0);
    // Neighbours that overlap, or gape, by rounding.
    for shift in [1e-12, -1e-12, 1e-14] {
        let parcels = vec![vec![rectangle([0.0, 0.0], [5.0, 10.0])], vec![rectangle([5.0 - shift, 0.0], [10.0, 10.0])]];
        assert!((area_of(parcels) - 100.0).abs() < 1e-9, "{shift}");
    }
}

#[test]
fn what_is_done_is_told() {
    let told = |parts: Vec<Vec<Ring>>| Polygon::new(parts).unwrap().repairs().join("; ");
    assert_eq!(told(vec![vec![square(0.0, 6.0)], vec![square(0.0, 6.0)]]), "shapes overlap by an area of 36: united");
    assert_eq!(told(vec![vec![square(0.0, 6.0), rectangle([1.0, 1.0], [3.0, 2.0]).into_iter().rev().collect()]; 1]), "");
    let doubled = vec![square(0.0, 6.0), rectangle([1.0, 1.0], [3.0, 2.0]).into_iter().rev().collect::<Ring>()];
    let doubled = vec![[doubled.clone(), vec![doubled[1].clone()]].concat()];
    assert_eq!(told(doubled), "1 ring is there twice: left out");
    let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let tied = Polygon::from_rings(vec![bow_tie]).unwrap();
    assert_eq!((tied.area(), tied.rings().len()), (0.5, 2));
    assert_eq!(tied.repairs(), ["the boundary crosses itself in 1 place, the first at (0.5, 0.5): cut there"]);
}

#[test]
fn clips_leave_what_lies_in_all_of_them() {
    let shape = |ring: Ring| Shape { rings: vec![ring], ..Shape::default() };
    let clipped = |clips: Vec<Vec<Shape>>| Polygon::of_shapes(&[Shape { clips, ..shape(square(0.0, 4.0)) }]).map(|polygon| polygon.area());
    assert_eq!(clipped(vec![vec![shape(square(2.0, 9.0))]]).unwrap(), 4.0);
    assert_eq!(clipped(vec![vec![shape(square(2.0, 9.0)), shape(square(-5.0, 1.0))]]).unwrap(), 5.0);
    assert_eq!(clipped(vec![vec![shape(square(2.0, 9.0))], vec![shape(square(-9.0, 3.0))]]).unwrap(), 1.0);
    assert!(clipped(vec![vec![shape(square(5.0, 9.0))]]).is_err());
}

#[test]
fn many_parcels_and_long_rings_are_no_trouble() {
    let parcel = |k: usize| {
        let [x, y] = [k % 100, k / 100].map(|k| k as f64 * 0.1);
        vec![rectangle([x, y], [x + 0.1, y + 0.1])]
    };
    let joined = Polygon::new((0..10_000).map(parcel).collect()).unwrap();
    assert!((joined.area() - 100.0).abs() < 1e-9);
    assert_eq!(joined.rings().len(), 1);
}
