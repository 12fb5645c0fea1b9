//! Points in a table: columns x and y by name, and what stands in the others.

use std::borrow::Cow;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::text::{is_name, parse, plain};
use crate::{Error, Extent};

/// How the columns of positions may be called.
const NAMES: [[&str; 2]; 4] = [["x", "y"], ["lon", "lat"], ["longitude", "latitude"], ["easting", "northing"]];

/// Points, and the columns of their file that are no coordinates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// The points.
    pub positions: Vec<[f64; 2]>,
    /// What else is said of them.
    pub columns: Columns,
    /// Their domain, where the file carries it.
    pub extent: Option<Extent>,
}

/// Columns of words, a row a point.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    /// The columns' names.
    pub names: Vec<String>,
    /// A word for each name.
    pub rows: Vec<Vec<String>>,
}

/// Reads a table whose first line names more than two columns, or x and y in another order; `None` for all else.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Option<Table>, Error> {
    let bytes = plain(bytes);
    let text = match std::str::from_utf8(&bytes) {
        Ok(text) => Cow::Borrowed(text),
        // Names of another encoding are no reason to refuse numbers.
        Err(_) if is_printable(&bytes) => String::from_utf8_lossy(&bytes),
        Err(_) => return Ok(None),
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let Some(first) = text.lines().find(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#')) else { return Ok(None) };
    let separator = [b',', b';', b'\t'].into_iter().find(|&separator| first.as_bytes().contains(&separator));
    let spaced;
    let text = match separator {
        Some(_) => text,
        None => {
            let words = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
            spaced = words.collect::<Vec<_>>().join("\n");
            &spaced
        }
    };
    let mut reader = ReaderBuilder::new()
        .delimiter(separator.unwrap_or(b' '))
        .comment(Some(b'#'))
        .trim(Trim::All)
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let wrong = |e: csv::Error| {
        let line = e.position().map_or(0, csv::Position::line);
        Error::content(format!("{name}:{line}"), "this line is no line of a table")
    };
    let mut record = StringRecord::new();
    if !reader.read_record(&mut record).map_err(wrong)? || !record.iter().all(is_name) {
        return Ok(None);
    }
    let names: Vec<String> = record.iter().map(str::to_owned).collect();
    let Some(axes) = axes(&names) else {
        if names.len() > 2 && separator.is_some() {
            let shown: String = names.join(", ").chars().take(60).flat_map(char::escape_debug).collect();
            return Err(Error::content(name, format!("its columns are {shown}; none are called x and y")));
        }
        return Ok(None);
    };
    let others: Vec<usize> = (0..names.len()).filter(|k| !axes.contains(k)).collect();
    let mut table =
        Table { columns: Columns { names: others.iter().map(|&k| names[k].clone()).collect(), rows: Vec::new() }, ..Table::default() };
    while reader.read_record(&mut record).map_err(wrong)? {
        let at = |problem: String| {
            let line = record.position().map_or(0, csv::Position::line);
            Error::content(format!("{name}:{line}"), problem)
        };
        let word = |k: usize| record.get(k).unwrap_or_default();
        if axes.iter().any(|&axis| word(axis).is_empty()) {
            let n = record.len();
            return Err(at(format!("{n} column{}, and x or y is missing", if n == 1 { "" } else { "s" })));
        }
        let mut position = [0.0; 2];
        for (number, &axis) in position.iter_mut().zip(&axes) {
            *number = parse(word(axis)).map_err(at)?;
        }
        table.positions.push(position);
        if !others.is_empty() {
            table.columns.rows.push(others.iter().map(|&k| word(k).to_owned()).collect());
        }
    }
    if table.positions.is_empty() { Err(Error::content(name, "there are no points in it")) } else { Ok(Some(table)) }
}

/// The columns of x and y; a unit may stand after a name.
fn axes(names: &[String]) -> Option<[usize; 2]> {
    let place = |wanted: &str| {
        let is_it = |name: &String| name.split([' ', '[', '(']).next().is_some_and(|word| word.eq_ignore_ascii_case(wanted));
        names.iter().position(is_it)
    };
    NAMES.iter().find_map(|[x, y]| Some([place(x)?, place(y)?]))
}

fn is_printable(bytes: &[u8]) -> bool {
    bytes.iter().all(|&c| c >= b' ' || c.is_ascii_whitespace())
}

impl Columns {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Lines of `x,y` and the other columns.
    pub(crate) fn csv(&self, positions: &[[f64; 2]]) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let numbers = |[x, y]: [f64; 2]| [crate::text::Shortest(x).to_string(), crate::text::Shortest(y).to_string()];
        let head = ["x", "y"].map(str::to_owned).into_iter().chain(self.names.iter().cloned());
        let rows = positions.iter().zip(&self.rows).map(|(&p, row)| numbers(p).into_iter().chain(row.iter().cloned()).collect::<Vec<_>>());
        for row in std::iter::once(head.collect::<Vec<_>>()).chain(rows) {
            // A buffer takes all.
            let _ = writer.write_record(&row);
        }
        writer.into_inner().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        read("p.csv", text.as_bytes()).unwrap().unwrap()
    }

    #[test]
    fn columns_are_found_by_name_and_others_kept() {
        let expected = vec![[1.0, 2.0], [3.0, -4.5]];
        for text in [
            "id,x,y,name\n7,1,2,a\n8,3,-4.5,\"b, c\"\n",
            "id;X;name;Y\r\n7;1;a;2\r\n8;3;\"b, c\";-4.5",
            "\u{feff}id\tname\ty [m]\tx (m)\n7\ta\t2\t1\n8\tb, c\t-4.5\t3\n",
            "# made by hand\nid lat name lon\n7  2 a   1\n\n8 -4.5 \"b, c\" 3\n",
            "id,x,y,name\r7,1,2,a\r8,3,-4.5,\"b, c\"\r",
        ] {
            let Table { positions, columns, .. } = table(text);
            assert_eq!(positions, expected, "{text:?}");
            assert_eq!(
                (columns.names, columns.rows),
                (vec!["id".into(), "name".into()], vec![vec!["7".into(), "a".into()], vec!["8".into(), "b, c".into()]])
            );
        }
        assert_eq!(table("y,x\n2,1\n").positions, [[1.0, 2.0]]);
    }

    #[test]
    fn a_table_that_is_written_reads_back() {
        let Table { positions, columns, .. } = table("x,y,what\n0.1,1e-300,\"a \"\"b\"\", c\"\n-5,7,\n");
        let again = read("q.csv", &columns.csv(&positions)).unwrap().unwrap();
        assert_eq!(again, Table { positions, columns, extent: None });
    }

    #[test]
    fn what_is_no_table_is_left_to_others_or_named() {
        for text in ["1 2\n3 4\n", "x,y\n1,2\n", "", "# x y\n", "0x1 0x2 0x3\n1 2 3\n"] {
            assert!(read("p", text.as_bytes()).unwrap().is_none_or(|table| table.columns.is_empty()), "{text:?}");
        }
        let message = |text: &str| read("p.csv", text.as_bytes()).unwrap_err().to_string();
        assert_eq!(message("id,x,y\n1,2\n"), "p.csv:2: 2 columns, and x or y is missing");
        assert_eq!(message("id,x,y\n1,2,nan\n"), "p.csv:2: nan is not a finite number");
        assert_eq!(message("a,b,c\n1,2,3\n"), "p.csv: its columns are a, b, c; none are called x and y");
        assert_eq!(message("id,x,y\n"), "p.csv: there are no points in it");
    }
}
