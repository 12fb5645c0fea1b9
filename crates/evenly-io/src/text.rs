//! Points as text: `x y` a line.
//!
//! Read are spaces, tabs, commas and semicolons between numbers, blank lines, `#` comments, a first line with the count, and a first
//! line of names.

use std::borrow::Cow;
use std::fmt::Write as _;

use crate::Error;

/// Text in UTF-8 with a line feed after each line, of UTF-16 and of old Macs too.
pub(crate) fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    let units = |of: fn([u8; 2]) -> u16| bytes[2..].chunks_exact(2).map(|pair| of([pair[0], pair[1]])).collect::<Vec<u16>>();
    let mut text = match bytes {
        [0xff, 0xfe, ..] => Cow::Owned(String::from_utf16_lossy(&units(u16::from_le_bytes)).into_bytes()),
        [0xfe, 0xff, ..] => Cow::Owned(String::from_utf16_lossy(&units(u16::from_be_bytes)).into_bytes()),
        _ => Cow::Borrowed(bytes),
    };
    if text.contains(&b'\r') && !text.contains(&b'\n') {
        text.to_mut().iter_mut().filter(|c| **c == b'\r').for_each(|c| *c = b'\n');
    }
    text
}

/// Reads points from the text of file `name`.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Vec<[f64; 2]>, Error> {
    let bytes = plain(bytes);
    let no_text = |_| Error::content(name, "this is not text; points are read from .txt, .csv, .npy and .geojson");
    let text = std::str::from_utf8(&bytes).map_err(no_text)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut points = Vec::new();
    let mut count: Option<usize> = None;
    let mut is_first = true;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default();
        let mut fields = line.split(is_separator).filter(|field| !field.is_empty());
        let Some(first) = fields.next() else { continue };
        let at = || format!("{name}:{number}");
        let rest: Vec<&str> = fields.collect();
        let was_first = std::mem::take(&mut is_first);
        match (parse(first), rest.as_slice()) {
            (Ok(x), [second]) => {
                let y = parse(second).map_err(|problem| Error::content(at(), problem))?;
                points.push([x, y]);
            }
            (Ok(_), []) if was_first && first.bytes().all(|c| c.is_ascii_digit()) => {
                let problem = |_| Error::content(at(), format!("a count of {first} is too large"));
                count = Some(first.parse().map_err(problem)?);
            }
            (Ok(_), _) => {
                let n = rest.len() + 1;
                let plural = if n == 1 { "" } else { "s" };
                return Err(Error::content(at(), format!("{n} number{plural}, expected 2 (x y)")));
            }
            // A line of names.
            (Err(_), rest) if was_first && is_name(first) && rest.iter().all(|field| is_name(field)) => {}
            (Err(problem), _) => return Err(Error::content(at(), problem)),
        }
    }
    if let Some(expected) = count
        && points.len() != expected
    {
        return Err(Error::content(name, format!("its first line promises {expected} points, but there are {}", points.len())));
    }
    if points.is_empty() {
        return Err(Error::content(name, "there are no points in it"));
    }
    Ok(points)
}

/// The numbers on one line, if there is more than a comment; `place` says where the line stands.
pub(crate) fn read_line<const N: usize>(place: &str, line: &str) -> Result<Option<[f64; N]>, Error> {
    let line = line.split('#').next().unwrap_or_default();
    let fields: Vec<&str> = line.split(is_separator).filter(|field| !field.is_empty()).collect();
    if fields.is_empty() {
        return Ok(None);
    }
    if fields.len() != N {
        return Err(Error::content(place, format!("{} numbers, expected {N}", fields.len())));
    }
    let mut numbers = [0.0; N];
    for (number, field) in numbers.iter_mut().zip(fields) {
        *number = parse(field).map_err(|problem| Error::content(place, problem))?;
    }
    Ok(Some(numbers))
}

/// Reads so many numbers a line.
pub(crate) fn read_rows<const N: usize>(name: &str, bytes: &[u8]) -> Result<Vec<[f64; N]>, Error> {
    let bytes = plain(bytes);
    let text = std::str::from_utf8(&bytes).map_err(|_| Error::content(name, "this is not text"))?;
    let lines = (1..).zip(text.trim_start_matches('\u{feff}').lines());
    let rows = lines.filter_map(|(number, line)| read_line(&format!("{name}:{number}"), line).transpose());
    let rows: Vec<[f64; N]> = rows.collect::<Result<_, _>>()?;
    if rows.is_empty() { Err(Error::content(name, "there is nothing in it")) } else { Ok(rows) }
}

/// Reads the first three numbers of each line, after a first line of names if there is one.
pub(crate) fn read_xyz(name: &str, bytes: &[u8]) -> Result<Vec<[f64; 3]>, Error> {
    let bytes = plain(bytes);
    let text = std::str::from_utf8(&bytes).map_err(|_| Error::content(name, "this is neither text nor a mesh"))?;
    let lines = (1..).zip(text.trim_start_matches('\u{feff}').lines());
    let mut rows = Vec::new();
    let mut is_first = true;
    for (number, line) in lines {
        let line = line.split('#').next().unwrap_or_default();
        let fields: Vec<&str> = line.split(is_separator).filter(|field| !field.is_empty()).collect();
        let was_first = !fields.is_empty() && std::mem::take(&mut is_first);
        if fields.is_empty() || was_first && !fields.iter().any(|field| is_number(field)) {
            continue;
        }
        let at = |problem| Error::content(format!("{name}:{number}"), problem);
        let [x, y, z, ..] = fields[..] else { return Err(at(format!("{} numbers, expected x y z", fields.len()))) };
        let mut row = [0.0; 3];
        for (number, field) in row.iter_mut().zip([x, y, z]) {
            *number = parse(field).map_err(at)?;
        }
        rows.push(row);
    }
    Ok(rows)
}

fn is_separator(c: char) -> bool {
    c.is_whitespace() || matches!(c, ',' | ';' | '"')
}

/// Whether a word can be the name of a column: none that was meant to be a number.
pub(crate) fn is_name(field: &str) -> bool {
    !is_number(field) && !field.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
}

/// Whether a word stands for a number, finite or not.
fn is_number(field: &str) -> bool {
    field.parse::<f64>().is_ok()
}

/// A finite number.
pub(crate) fn parse(field: &str) -> Result<f64, String> {
    match field.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        Ok(_) => Err(format!("{field} is not a finite number")),
        Err(_) => {
            let shown: String = field.chars().take(20).flat_map(char::escape_debug).collect();
            Err(format!("'{shown}' is not a number"))
        }
    }
}

/// Writes `x y` a line, after the recipe as a comment; every number reads back to the same bits.
pub(crate) fn write_txt(points: &[[f64; 2]], recipe: &str) -> String {
    let mut text = String::with_capacity(40 * points.len() + 200);
    for line in recipe.lines() {
        let _ = writeln!(text, "# {line}");
    }
    write_lines(&mut text, points, ' ');
    text
}

/// Writes `x,y` a line, after these names. There is no room for a comment.
pub(crate) fn write_csv(points: &[[f64; 2]]) -> String {
    let mut text = String::with_capacity(40 * points.len() + 4);
    text.push_str("x,y\n");
    write_lines(&mut text, points, ',');
    text
}

fn write_lines(text: &mut String, points: &[[f64; 2]], separator: char) {
    for [x, y] in points {
        let _ = writeln!(text, "{}{separator}{}", Shortest(*x), Shortest(*y));
    }
}

/// Prints the shortest digits that read back to the same number; very large and small ones with an exponent.
pub(crate) struct Shortest(pub f64);

impl std::fmt::Display for Shortest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0 != 0.0 && !(1e-5..1e16).contains(&self.0.abs()) { write!(f, "{:e}", self.0) } else { write!(f, "{}", self.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn message(text: &str) -> String {
        read("p.txt", text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn all_kinds_of_text_are_read() {
        let expected = vec![[1.0, 2.0], [-3.5, 4e-3]];
        for text in [
            "1 2\n-3.5 0.004\n",
            "2\n1 2\n-3.5 4e-3",
            "# a comment\r\n\r\n1,2\r\n-3.5,0.004\r\n",
            "x,y\n1, 2\n-3.5, .004",
            "\u{feff}\"x\";\"y\"\n1;2\n-3.5;0.004",
            "\"1\",\"2\"\n\"-3.5\",\"0.004\"",
            "\t1\t2 # the first\n\n -3.5  +4E-3",
            "x y\r1 2\r-3.5 0.004\r",
        ] {
            assert_eq!(read("p.txt", text.as_bytes()).unwrap(), expected, "{text:?}");
            let wide: Vec<u8> = "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_be_bytes).collect();
            assert_eq!(read("p.txt", &wide).unwrap(), expected, "{text:?}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        assert_eq!(message("1 2\n1 2 3\n"), "p.txt:2: 3 numbers, expected 2 (x y)");
        assert_eq!(message("1 2\n7\n"), "p.txt:2: 1 number, expected 2 (x y)");
        assert_eq!(message("0 0\n1 NaN"), "p.txt:2: NaN is not a finite number");
        assert_eq!(message("inf 1"), "p.txt:1: inf is not a finite number");
        assert_eq!(message("1 1e999"), "p.txt:1: 1e999 is not a finite number");
        assert_eq!(message("1 2\nx 3"), "p.txt:2: 'x' is not a number");
        assert_eq!(message("N/A,0.5\n1,2"), "p.txt:1: 'N/A' is not a number");
        assert_eq!(message("O.5 0.5\n1 2"), "p.txt:1: 'O.5' is not a number");
        assert!(message("<svg>\n<g>\n1 2").starts_with("p.txt:2: '<g>' is not a number"));
        assert_eq!(message("1 x"), "p.txt:1: 'x' is not a number");
        assert_eq!(message("3\n1 2\n"), "p.txt: its first line promises 3 points, but there are 1");
        assert_eq!(message(""), "p.txt: there are no points in it");
        assert_eq!(message("# nothing\n"), "p.txt: there are no points in it");
        assert_eq!(message("1d-1 2d-1\n1 2\n"), "p.txt:1: '1d-1' is not a number");
        assert_eq!(message("0x1 0x2\n1 2\n"), "p.txt:1: '0x1' is not a number");
        assert!(read("p", &[0xff, 0, 0xfe]).unwrap_err().to_string().contains("not text"));
    }

    proptest! {
        #[test]
        fn what_is_written_reads_back_to_the_same_bits(x in proptest::num::f64::NORMAL, y in proptest::num::f64::NORMAL) {
            let points = vec![[x, y], [y, 0.0]];
            prop_assert_eq!(&read("p", write_txt(&points, "recipe").as_bytes()).unwrap(), &points);
            prop_assert_eq!(&read("p", write_csv(&points).as_bytes()).unwrap(), &points);
        }

        #[test]
        fn no_text_makes_it_panic(text in "\\PC*") {
            let _ = read("p", text.as_bytes());
        }
    }
}
