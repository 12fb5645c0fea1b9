//! Panels side by side: maps, charts, and a table of measures.

use std::borrow::Cow;

use evenly::{
    Measures, PointSet, PowerSpectrum, RadialSpectrum, differential_spectrum, local_spacings, measure, power_spectrum, radial_spectrum,
};

use super::curves;
use super::draw::Draw;
use super::map::{Tessellated, map};
use super::svg::{Anchor, inset, text};
use super::waves::waves;
use crate::Error;

/// A panel's side, and the room between panels, above them, and around all.
const SIDE: f64 = 360.0;
const GAP: f64 = 24.0;
const HEAD: f64 = 40.0;
const MARGIN: f64 = 24.0;
/// The room for a page's title.
const TITLE: f64 = 40.0;
/// Panels in a row.
const COLUMNS: usize = 3;
/// The points in a report's map.
const MOST: usize = 1000;

/// What a figure is of.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The sets: maps and angles are of the first, spectra the mean of all.
    pub sets: &'a [PointSet],
    /// The title of a report.
    pub name: &'a str,
    /// Whether the density varies, so that distances are taken in the spacing of their place, and there is no power spectrum.
    pub is_local: bool,
    /// Of more points than that, maps show a corner; `None` for all points, but a report then shows a thousand.
    pub most_points: Option<usize>,
    /// The spectra, where they are known; else they are computed where they are drawn.
    pub radial: Option<&'a RadialSpectrum>,
    /// As above.
    pub power: Option<&'a PowerSpectrum>,
}

impl<'a> From<&'a PointSet> for Subject<'a> {
    fn from(points: &'a PointSet) -> Self {
        Self { sets: std::slice::from_ref(points), name: "", is_local: false, most_points: None, radial: None, power: None }
    }
}

impl Subject<'_> {
    fn first(&self) -> Result<&PointSet, Error> {
        self.sets.first().ok_or_else(|| evenly::Error::Degenerate("there are no points".into()).into())
    }

    pub(super) fn radial(&self) -> Result<Cow<'_, RadialSpectrum>, Error> {
        Ok(match self.radial {
            Some(known) => Cow::Borrowed(known),
            None if self.is_local => Cow::Owned(differential_spectrum(self.first()?, &local_spacings(self.first()?)?)?),
            None => Cow::Owned(radial_spectrum(self.sets)?),
        })
    }

    pub(super) fn power(&self) -> Result<Cow<'_, PowerSpectrum>, Error> {
        if self.is_local {
            let varies = "a power spectrum means nothing where the density varies; its radial mean and the pair correlation do";
            return Err(evenly::Error::Degenerate(varies.into()).into());
        }
        Ok(match self.power {
            Some(known) => Cow::Borrowed(known),
            None => Cow::Owned(power_spectrum(self.sets, PowerSpectrum::MAX_FREQUENCY)?),
        })
    }
}

/// A drawing of panels, filled row by row.
pub(super) struct Page {
    body: String,
    title: String,
    n_panels: usize,
    n_columns: usize,
    tessellated: Tessellated,
}

impl Page {
    pub fn of(subject: &Subject, parts: &[Draw]) -> Result<Self, Error> {
        if parts.contains(&Draw::Report) {
            return Self::report(subject);
        }
        let (layers, charts): (Vec<Draw>, Vec<Draw>) = parts.iter().partition(|part| part.is_layer());
        let n_panels = charts.len() + usize::from(!layers.is_empty());
        let n_columns = if n_panels == 4 { 2 } else { n_panels.min(COLUMNS) };
        let mut page = Self { body: String::new(), title: String::new(), n_panels: 0, n_columns, tessellated: Tessellated::default() };
        if !layers.is_empty() {
            page.map(subject, &layers, subject.most_points.unwrap_or(usize::MAX))?;
        }
        for chart in charts {
            page.chart(subject, chart)?;
        }
        Ok(page)
    }

    /// All there is; what there is not is said in its panel.
    fn report(subject: &Subject) -> Result<Self, Error> {
        let points = subject.first()?;
        let kind = points.space().kind();
        let many = if subject.sets.len() > 1 { format!(", the first of {} sets", subject.sets.len()) } else { String::new() };
        let name = if subject.name.is_empty() { String::new() } else { format!("{}: ", subject.name) };
        let heading = format!("{name}{} points, {kind} {}{many}", points.n_points(), points.space());
        let mut page = Self { body: String::new(), title: heading, n_panels: 0, n_columns: COLUMNS, tessellated: Tessellated::default() };
        for layers in [[Draw::Points], [Draw::Valence], [Draw::Capacity]] {
            page.attempt(layers[0].title(), |page| page.map(subject, &layers, subject.most_points.unwrap_or(MOST)));
        }
        let charts: &[Draw] = match subject.is_local {
            true => &[Draw::RadialPower, Draw::PairCorrelation, Draw::Angles],
            false => &[Draw::PowerSpectrum, Draw::RadialPower, Draw::Anisotropy, Draw::PairCorrelation, Draw::Angles],
        };
        for &chart in charts {
            page.attempt(chart.title(), |page| page.chart(subject, chart));
        }
        page.attempt("Measures", |page| page.table(&measure(points)?));
        Ok(page)
    }

    fn attempt(&mut self, title: &str, draw: impl FnOnce(&mut Self) -> Result<(), Error>) {
        if let Err(error) = draw(self) {
            let [x, y] = self.panel(title, "");
            for (line, words) in broken(&error.to_string(), 50).iter().enumerate() {
                text(&mut self.body, [x + 8.0, y + 24.0 + 16.0 * line as f64], 12.0, Anchor::Start, words);
            }
        }
    }

    /// Begins a panel: where it lies.
    fn panel(&mut self, title: &str, caption: &str) -> [f64; 2] {
        let (row, column) = (self.n_panels / self.n_columns, self.n_panels % self.n_columns);
        self.n_panels += 1;
        let x = MARGIN + column as f64 * (SIDE + GAP);
        let y = self.top() + row as f64 * (SIDE + GAP + HEAD) + HEAD;
        text(&mut self.body, [x, y - 22.0], 14.0, Anchor::Start, title);
        text(&mut self.body, [x, y - 7.0], 10.5, Anchor::Start, caption);
        [x, y]
    }

    fn top(&self) -> f64 {
        if self.title.is_empty() { 0.0 } else { TITLE }
    }

    fn map(&mut self, subject: &Subject, layers: &[Draw], most: usize) -> Result<(), Error> {
        let points = subject.first()?;
        let (body, size) = map(points, layers, most, &self.tessellated)?;
        let mut title = layers.iter().map(|&layer| layer.title()).collect::<Vec<_>>().join(", ");
        if subject.sets.len() > 1 {
            title += " (the first set)";
        }
        let meaning: String = layers.iter().map(|&layer| layer.caption()).collect();
        let caption = match (points.n_points() > most, meaning.is_empty()) {
            (true, true) => format!("a corner with some {most} of them"),
            (true, false) => format!("a corner; {meaning}"),
            (false, _) => meaning,
        };
        let place = self.panel(&title, &caption);
        let scale = SIDE / size[0].max(size[1]);
        self.body.push_str(&inset(place, size.map(|side| side * scale), size, &body));
        Ok(())
    }

    fn chart(&mut self, subject: &Subject, chart: Draw) -> Result<(), Error> {
        let size = [SIDE, SIDE];
        let caption =
            if subject.is_local && chart == Draw::RadialPower { "each distance in the spacing of its place" } else { chart.caption() };
        let place = |page: &mut Self| page.panel(chart.title(), caption);
        match chart {
            Draw::PowerSpectrum => {
                let power = subject.power()?;
                let place = place(self);
                self.body.push_str(&waves(&power, place, size));
            }
            Draw::RadialPower => {
                let power = if subject.is_local { None } else { Some(subject.power()?) };
                let chart = curves::radial_power(size, &*subject.radial()?, power.as_deref());
                let place = place(self);
                chart.finish(&mut self.body, place);
            }
            Draw::Anisotropy => {
                let chart = curves::anisotropy(size, &*subject.power()?);
                let place = place(self);
                chart.finish(&mut self.body, place);
            }
            Draw::PairCorrelation => {
                let chart = curves::pair_correlation(size, &*subject.radial()?);
                let place = place(self);
                chart.finish(&mut self.body, place);
            }
            _ => {
                let chart = curves::angles(size, self.tessellated.of(subject.first()?)?);
                let place = place(self);
                chart.finish(&mut self.body, place);
            }
        }
        Ok(())
    }

    fn table(&mut self, m: &Measures) -> Result<(), Error> {
        let [x, y] = self.panel("Measures", "lengths in hexagonal spacings, areas in mean areas");
        let shares: usize = m.valence.values().sum();
        let share = |n: usize| 100.0 * m.valence.get(&n).copied().unwrap_or_default() as f64 / shares.max(1) as f64;
        let rows = [
            ("min distance", format!("{:.4}", m.min_distance)),
            ("mean distance", format!("{:.4}", m.mean_distance)),
            ("coverage radius", format!("{:.4}", m.coverage_radius)),
            ("beta", format!("{:.4}", m.beta)),
            ("capacity, standard deviation", format!("{:.4}", m.capacity_sd)),
            ("bond order (psi6)", format!("{:.4}", m.bond_order)),
            ("bond order (psa)", format!("{:.4}", m.bond_order_psa)),
            ("angles", format!("{:.1}\u{b0} to {:.1}\u{b0}", m.min_angle_deg, m.max_angle_deg)),
            ("angles, rms from 60\u{b0}", format!("{:.2}\u{b0}", m.angle_rms_deg)),
            ("triangle quality", format!("{:.4}", m.triangle_quality)),
            ("obtuse triangles", format!("{:.2} %", 100.0 * m.obtuse_fraction)),
            ("five, six, seven neighbours", format!("{:.1}, {:.1}, {:.1} %", share(5), share(6), share(7))),
            ("CVT energy", format!("{:.5}", m.cvt_energy)),
        ];
        for (row, (name, value)) in rows.iter().enumerate() {
            let y = y + 18.0 + 24.0 * row as f64;
            text(&mut self.body, [x, y], 13.0, Anchor::Start, name);
            text(&mut self.body, [x + SIDE, y], 13.0, Anchor::End, &value.replace('-', "\u{2212}"));
        }
        Ok(())
    }

    /// The body of a drawing, and its size.
    pub fn finish(mut self) -> (String, [f64; 2]) {
        let (top, title) = (self.top(), std::mem::take(&mut self.title));
        text(&mut self.body, [MARGIN, 30.0], 17.0, Anchor::Start, &title);
        let n_rows = self.n_panels.div_ceil(self.n_columns.max(1));
        let long = |n: usize, extra: f64| n as f64 * (SIDE + GAP + extra) - GAP + 2.0 * MARGIN;
        (self.body, [long(self.n_columns, 0.0), top + long(n_rows, HEAD) - MARGIN])
    }
}

/// Lines of some so many letters.
fn broken(words: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + word.len() < width => *line = format!("{line} {word}"),
            _ => lines.push(word.into()),
        }
    }
    lines
}
