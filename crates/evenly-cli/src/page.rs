//! Pages of HTML that need nothing else; a comparison as one.

use std::fmt::Write as _;

use crate::comparison::{Comparison, shown, spread};

const STYLE: &str = "\
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 90rem; padding: 0 1rem; color: #222; background: #fff }
h1 { font-size: 1.4rem } code { font-size: .9em }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(14rem, 1fr)); gap: 1rem }
figure { margin: 0 } figure svg { width: 100%; height: auto; border: 1px solid #ccc; background: #fff }
figcaption { text-align: center } ul { padding-left: 1.2rem } i { color: #666 }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); gap: 1rem }
@media (min-width: 50rem) { .figures .panels { grid-column: span 2 } }
.wide { overflow-x: auto; margin: 1rem 0 } section { border-top: 1px solid #ccc; margin-top: 2rem } table { border-collapse: collapse; font-variant-numeric: tabular-nums }
th, td { padding: .2rem .7rem; text-align: right; white-space: nowrap; border-bottom: 1px solid #ddd }
th:first-child { text-align: left; position: sticky; left: 0; background: #fff } tr:hover td { background: #f2f6fa }";

/// A whole page.
pub fn document(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{}</title>\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<style>\n{STYLE}\n</style></head>\n<body>\n{body}</body>\n</html>\n",
        escaped(title)
    )
}

pub fn page(comparison: &Comparison) -> String {
    let mut text = format!(
        "<h1>Methods side by side</h1>\n<p>{}. Lengths are in hexagonal spacings. Made by <code>{}</code>, evenly {}.</p>\n",
        escaped(&comparison.title()),
        escaped(&comparison.command),
        comparison.version
    );
    text.push_str("<div class=\"pictures\">\n");
    for (column, picture) in comparison.columns.iter().zip(&comparison.pictures) {
        // An SVG within a page has no declaration.
        let picture = picture.as_deref().unwrap_or_default();
        let picture = picture.find("<svg").map_or("", |start| &picture[start..]);
        let _ = writeln!(text, "<figure>{picture}<figcaption>{}</figcaption></figure>", escaped(&column.method));
    }
    text.push_str("</div>\n<div class=\"wide\"><table>\n<tr><th></th>");
    for column in &comparison.columns {
        let _ = write!(text, "<th>{}</th>", escaped(&column.method));
    }
    text.push_str("</tr>\n");
    for name in comparison.names() {
        let _ = write!(text, "<tr><th>{}</th>", escaped(&name));
        for column in &comparison.columns {
            let _ = write!(text, "<td>{}</td>", shown(spread(column, &name)));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</table></div>\n");
    document("evenly compare", &text)
}

pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
