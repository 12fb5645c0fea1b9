//! What shapes enclose together. Positions lie on a grid, so a library for booleans of integers loses
//! nothing of them; only where segments cross new corners come, on the grid.

use glam::DVec2;
use i_overlay::core::fill_rule::FillRule as Rule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

use super::clean::Corner;
use super::{FillRule, twice_area};
use crate::space::GRID;

/// A ring of places on the grid.
pub(super) type Ring = Vec<DVec2>;
type Contour = Vec<IntPoint<i64>>;

/// Rings that differ by less than this part of their area are one ring that is there twice.
const SAME: f64 = 1e-4;

/// A shape in normalised coordinates.
pub(super) struct Figure {
    pub rings: Vec<Vec<Corner>>,
    pub rule: FillRule,
    /// Only what each of these encloses, too, belongs to it.
    pub clips: Vec<Vec<Figure>>,
}

/// What shapes enclose together.
#[derive(Default)]
pub(super) struct Union {
    /// Rings that do not cross, with the inside on their left.
    pub rings: Vec<Ring>,
    /// Rings of one shape that were there twice.
    pub n_doubled: usize,
    /// The area that shapes have in common, counted once for each shape beyond the first.
    pub shared_area: f64,
}

/// The union of shapes.
pub(super) fn union(figures: &[Figure]) -> Union {
    let mut n_doubled = 0;
    let mut all = Vec::new();
    for figure in figures {
        all.extend(enclosed(figure, &mut n_doubled));
    }
    let sum = area(&all);
    if figures.len() > 1 {
        all = resolved(all.into_iter(), FillRule::NonZero);
    }
    Union { rings: all.iter().map(of_grid).collect(), n_doubled, shared_area: sum - area(&all) }
}

/// What one shape encloses: contours that do not cross, with the inside on their left.
fn enclosed(figure: &Figure, n_doubled: &mut usize) -> Vec<Contour> {
    let mut rings: Vec<Ring> = figure.rings.iter().map(|ring| ring.iter().map(|corner| corner.at).collect()).collect();
    if figure.rule == FillRule::EvenOdd {
        *n_doubled += leave_out_doubled(&mut rings);
    }
    let whole = resolved(rings.iter().map(|ring| to_grid(ring)), figure.rule);
    figure.clips.iter().fold(whole, |left, clip| {
        let mut overlay = Overlay::new(0);
        left.iter().for_each(|contour| overlay.add_contour(contour, ShapeType::Subject));
        let clip = union(clip).rings;
        clip.iter().for_each(|ring| overlay.add_contour(&to_grid(ring), ShapeType::Clip));
        overlay.overlay(OverlayRule::Intersect, Rule::NonZero).into_iter().flatten().collect()
    })
}

/// What contours enclose, in the same form.
fn resolved(contours: impl Iterator<Item = Contour>, rule: FillRule) -> Vec<Contour> {
    let mut overlay = Overlay::new(0);
    contours.for_each(|contour| overlay.add_contour(&contour, ShapeType::Subject));
    let rule = match rule {
        FillRule::EvenOdd => Rule::EvenOdd,
        FillRule::NonZero => Rule::NonZero,
    };
    overlay.overlay(OverlayRule::Subject, rule).into_iter().flatten().collect()
}

/// Leaves out each ring that is the same as another, and counts them.
fn leave_out_doubled(rings: &mut Vec<Ring>) -> usize {
    let areas: Vec<f64> = rings.iter().map(|ring| twice_area(ring).abs()).collect();
    let boxes: Vec<[DVec2; 2]> = rings.iter().map(|ring| bounds(ring)).collect();
    // Those that are the same begin at about the same x.
    let mut order: Vec<usize> = (0..rings.len()).collect();
    order.sort_by(|&a, &b| boxes[a][0].x.total_cmp(&boxes[b][0].x).then(a.cmp(&b)));
    let mut is_doubled = vec![false; rings.len()];
    for (k, &one) in order.iter().enumerate() {
        let [low, high] = boxes[one];
        let most = SAME.sqrt() * (high - low).max_element();
        let is_near = |a: DVec2, b: DVec2| (a - b).abs().max_element() <= most;
        let mut similar = order[k + 1..].iter().copied().take_while(|&other| boxes[other][0].x - low.x <= most).filter(|&other| {
            let is_as_large = (areas[other] - areas[one]).abs() <= SAME * areas[other];
            is_as_large && is_near(boxes[other][0], low) && is_near(boxes[other][1], high)
        });
        if let Some(other) = similar.find(|&other| is_same(&rings[one], &rings[other])) {
            // The first stays.
            is_doubled[one.max(other)] = true;
        }
    }
    let mut numbers = is_doubled.iter();
    rings.retain(|_| !numbers.next().copied().unwrap_or_default());
    is_doubled.into_iter().filter(|&is| is).count()
}

/// The least and the greatest corner of the box around a ring.
fn bounds(ring: &[DVec2]) -> [DVec2; 2] {
    let low = ring.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    [low, ring.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max)]
}

/// Whether the places that lie in one ring and not in the other are few.
fn is_same(one: &[DVec2], other: &[DVec2]) -> bool {
    let differing = resolved([to_grid(one), to_grid(other)].into_iter(), FillRule::EvenOdd);
    area(&differing) <= SAME * 0.5 * twice_area(one).abs()
}

fn area(contours: &[Contour]) -> f64 {
    contours.iter().map(|contour| 0.5 * twice_area(&of_grid(contour))).sum()
}

fn to_grid(ring: &[DVec2]) -> Contour {
    ring.iter().map(|p| IntPoint::new((p.x / GRID) as i64, (p.y / GRID) as i64)).collect()
}

fn of_grid(contour: &Contour) -> Ring {
    contour.iter().map(|p| GRID * DVec2::new(p.x as f64, p.y as f64)).collect()
}
