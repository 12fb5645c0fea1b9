//! Charts: curves and bars over axes.

use std::fmt::Write as _;

use super::svg::{Anchor, Short, inset, text};

/// Room for the numbers and names of axes, in the drawing's units: left, bottom, right, top.
const MARGINS: [f64; 4] = [46.0, 40.0, 10.0, 8.0];
const SMALL: f64 = 11.0;

/// What one axis shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis<'a> {
    /// Its name, with the unit.
    pub name: &'a str,
    /// Its ends.
    pub range: [f64; 2],
    /// Whether equal lengths are equal ratios; the range is positive then.
    pub is_log: bool,
}

impl<'a> Axis<'a> {
    /// An even axis.
    pub fn new(name: &'a str, range: [f64; 2]) -> Self {
        Self { name, range, is_log: false }
    }

    /// An axis of ratios.
    pub fn log(name: &'a str, range: [f64; 2]) -> Self {
        Self { name, range, is_log: true }
    }

    /// Where a value lies, from 0 at the axis' begin to 1 at its end.
    fn share(&self, value: f64) -> f64 {
        let scale = |value: f64| if self.is_log { value.max(1e-300).ln() } else { value };
        let [low, high] = self.range.map(scale);
        (scale(value) - low) / (high - low)
    }

    /// Round numbers along it, as they are written.
    fn ticks(&self) -> Vec<(f64, String)> {
        if !self.is_log {
            return ticks(self.range);
        }
        let [low, high] = self.range.map(f64::log10);
        let powers = (low - 1e-9).ceil() as i32..=(high + 1e-9).floor() as i32;
        let written = |power: i32| match power {
            0..=3 => format!("{}", 10f64.powi(power)),
            -2..=-1 => format!("{:.*}", -power as usize, 10f64.powi(power)),
            _ => format!("1e{power}").replace('-', "\u{2212}"),
        };
        powers.map(|power| (10f64.powi(power), written(power))).collect()
    }
}

/// A chart in the making.
pub(super) struct Chart<'a> {
    x: Axis<'a>,
    y: Axis<'a>,
    /// Of the area within the axes.
    size: [f64; 2],
    /// What is drawn within the axes.
    body: String,
}

impl<'a> Chart<'a> {
    /// An empty chart of this size, axes and their numbers included.
    pub fn new(size: [f64; 2], x: Axis<'a>, y: Axis<'a>) -> Self {
        let [left, bottom, right, top] = MARGINS;
        Self { x, y, size: [size[0] - left - right, size[1] - bottom - top], body: String::new() }
    }

    fn place(&self, x: f64, y: f64) -> [f64; 2] {
        // Far outside is as good as farther, and some programs lose count of large numbers.
        let [x, y] = [self.x.share(x), 1.0 - self.y.share(y)].map(|share| share.clamp(-10.0, 10.0));
        [x * self.size[0], y * self.size[1]]
    }

    /// A curve through points from left to right; it has gaps where a value is not a number.
    pub fn curve(&mut self, points: impl Iterator<Item = (f64, f64)>, colour: &str, width: f64, dashes: &str) {
        let mut path = String::new();
        let mut is_broken = true;
        for (x, y) in points {
            if !y.is_finite() {
                is_broken = true;
                continue;
            }
            let [x, y] = self.place(x, y);
            let _ = write!(path, "{}{} {}", if is_broken { 'M' } else { 'L' }, Short(x), Short(y));
            is_broken = false;
        }
        let _ = writeln!(
            self.body,
            "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-dasharray=\"{dashes}\" stroke-linejoin=\"round\" d=\"{path}\"/>"
        );
    }

    /// Bars from the axis up: where each begins, and how high it is; all as wide.
    pub fn bars(&mut self, width: f64, bars: impl Iterator<Item = (f64, f64)>, colour: &str) {
        let mut path = String::new();
        for (x, y) in bars {
            let ([left, top], [right, bottom]) = (self.place(x, y), self.place(x + width, 0.0));
            let _ = write!(path, "M{} {}V{}H{}V{}z", Short(left), Short(bottom), Short(top), Short(right), Short(bottom));
        }
        let _ = writeln!(self.body, "<path fill=\"{colour}\" stroke=\"#ffffff\" stroke-width=\"0.5\" d=\"{path}\"/>");
    }

    /// A dashed line across the chart at a height.
    pub fn level(&mut self, y: f64) {
        let [left, right] = self.x.range;
        self.curve([(left, y), (right, y)].into_iter(), "#777777", 0.8, "4 3");
    }

    /// A dashed line from bottom to top.
    pub fn upright(&mut self, x: f64) {
        let [low, high] = self.y.range;
        self.curve([(x, low), (x, high)].into_iter(), "#777777", 0.8, "1.5 2.5");
    }

    /// A line of words in the upper right corner, below those before.
    pub fn note(&mut self, line: usize, words: &str) {
        let place = [self.size[0] - 6.0, 16.0 + 15.0 * line as f64];
        text(&mut self.body, place, SMALL, Anchor::End, words);
    }

    /// The whole chart at a place.
    pub fn finish(self, svg: &mut String, place: [f64; 2]) {
        let [left, _, _, top] = MARGINS;
        let [x, y] = [place[0] + left, place[1] + top];
        let [width, height] = self.size;
        svg.push_str(&inset([x, y], self.size, self.size, &self.body));
        let _ = writeln!(
            svg,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#222222\" stroke-width=\"0.8\"/>",
            Short(x),
            Short(y),
            Short(width),
            Short(height)
        );
        let mut marks = String::new();
        for (at, name) in self.x.ticks() {
            let [tick, _] = self.place(at, self.y.range[0]);
            let _ = write!(marks, "M{} {}v4", Short(x + tick), Short(y + height));
            text(svg, [x + tick, y + height + 16.0], SMALL, Anchor::Middle, &name);
        }
        for (at, name) in self.y.ticks() {
            let [_, tick] = self.place(self.x.range[0], at);
            let _ = write!(marks, "M{} {}h-4", Short(x), Short(y + tick));
            text(svg, [x - 7.0, y + tick + 4.0], SMALL, Anchor::End, &name);
        }
        let _ = writeln!(svg, "<path fill=\"none\" stroke=\"#222222\" stroke-width=\"0.8\" d=\"{marks}\"/>");
        text(svg, [x + 0.5 * width, y + height + 32.0], SMALL, Anchor::Middle, self.x.name);
        let _ = writeln!(svg, "<g transform=\"rotate(-90 {} {})\">", Short(place[0] + 11.0), Short(y + 0.5 * height));
        text(svg, [place[0] + 11.0, y + 0.5 * height], SMALL, Anchor::Middle, self.y.name);
        svg.push_str("</g>\n");
    }
}

/// A range's round numbers, some five of them, as they are written.
fn ticks([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let rough = (high - low) / 5.0;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|step| *step >= 0.999 * rough).unwrap_or(rough);
    let digits = (-step.log10().floor()).max(0.0) as usize;
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last).map(|k| (k as f64 * step, format!("{:.digits$}", k as f64 * step).replace('-', "\u{2212}"))).collect()
}

/// The least round number from a value on.
pub(super) fn round_up(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|round| *round >= 0.999 * value)
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_their_range() {
        let names = |range| ticks(range).into_iter().map(|(_, name)| name).collect::<Vec<_>>().join(" ");
        assert_eq!(names([0.0, 4.0]), "0 1 2 3 4");
        assert_eq!(names([-12.0, 12.0]), "\u{2212}10 \u{2212}5 0 5 10");
        assert_eq!(names([0.0, 0.031]), "0.00 0.01 0.02 0.03");
        assert_eq!(names([0.0, 180.0]), "0 50 100 150");
        assert!(round_up(2.3) == 2.5 && round_up(1.0) == 1.0 && round_up(0.0123) == 0.015 && round_up(810.0) == 1000.0);
    }
}
