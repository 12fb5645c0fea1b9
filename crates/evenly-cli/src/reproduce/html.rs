//! A reproduction as a page of HTML that needs nothing else.

use std::fmt::Write as _;

use super::part::{Cell, Part, Table};
use super::study::{Done, Study};
use crate::page::{document, escaped};
use crate::record;

pub fn html(study: &Study, done: &[Done], is_quick: bool) -> String {
    let mut body = format!("<h1>{}</h1>\n<p>{}</p>\n<p>", escaped(study.title), escaped(study.citation));
    let n_missing = study.parts.len() - done.len();
    let _ = write!(
        body,
        "Every table and figure that concerns flat domains, recomputed; printed numbers stand in italics below ours. Lengths are in \
         hexagonal spacings unless something else is said. Made by <code>{}</code>, evenly {}{}.",
        escaped(&record::command()),
        record::VERSION,
        if is_quick { ", with <code>--quick</code>: fewer points and sets, so that numbers scatter more" } else { "" }
    );
    if n_missing > 0 {
        let _ = write!(body, " <strong>Not whole yet: {n_missing} of {} parts are missing.</strong>", study.parts.len());
    }
    body.push_str("</p>\n");
    for Done { name, part } in done {
        section(&mut body, name, part);
    }
    document(study.title, &body)
}

fn section(body: &mut String, name: &str, part: &Part) {
    let _ = writeln!(body, "<section><h2>{}</h2>\n<p>{}</p>", escaped(name), escaped(&part.about));
    for table in &part.tables {
        write_table(body, table);
    }
    body.push_str("<div class=\"figures\">\n");
    for figure in &part.figures {
        let svg = figure.svg.find("<svg").map_or("", |start| &figure.svg[start..]);
        let class = if is_row_of_panels(svg) { " class=\"panels\"" } else { "" };
        let _ = writeln!(body, "<figure{class}>{svg}<figcaption>{}</figcaption></figure>", escaped(&figure.caption));
    }
    body.push_str("</div>\n");
    if !part.remarks.is_empty() {
        body.push_str("<p>What differs, and why:</p>\n<ul>\n");
        for remark in &part.remarks {
            let _ = writeln!(body, "<li>{}</li>", escaped(remark));
        }
        body.push_str("</ul>\n");
    }
    let _ = writeln!(body, "<p><small>{:.1} s</small></p></section>", part.seconds);
}

/// Whether a drawing is several times as wide as high.
fn is_row_of_panels(svg: &str) -> bool {
    let length = |name: &str| -> Option<f64> { svg.split_once(name)?.1.split('"').next()?.parse().ok() };
    length(" width=\"").zip(length(" height=\"")).is_some_and(|(width, height)| width > 2.5 * height)
}

fn write_table(body: &mut String, table: &Table) {
    body.push_str("<div class=\"wide\"><table>\n<tr><th></th>");
    for column in &table.columns {
        let _ = write!(body, "<th>{}</th>", escaped(column));
    }
    body.push_str("</tr>\n");
    for row in &table.rows {
        let _ = write!(body, "<tr><th>{}</th>", escaped(&row.name));
        for cell in &row.cells {
            let _ = write!(body, "<td>{}</td>", shown(cell));
        }
        body.push_str("</tr>\n");
    }
    body.push_str("</table></div>\n");
}

fn shown(cell: &Cell) -> String {
    let ours = cell.ours.map_or_else(|| "\u{2013}".into(), number);
    let paper = cell.paper.map_or_else(String::new, |paper| format!("<br><i>{}</i>", number(paper)));
    ours + &paper
}

/// Four digits or so.
fn number(value: f64) -> String {
    match value.abs() {
        size if size >= 1000.0 || value.fract() == 0.0 => format!("{value:.0}"),
        size if size >= 100.0 => format!("{value:.1}"),
        size if size >= 10.0 => format!("{value:.2}"),
        size if size >= 0.01 => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}
