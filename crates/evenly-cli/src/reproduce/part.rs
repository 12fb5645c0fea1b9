//! What a reproduction is made of: parts, each a figure or a table of a paper.

use evenly_io::{Axis, Curve, chart};
use serde::{Deserialize, Serialize};

/// A figure or a table of a paper, recomputed.
#[derive(Serialize, Deserialize)]
pub struct Part {
    /// What the paper shows, and how it was done here.
    pub about: String,
    pub tables: Vec<Table>,
    pub figures: Vec<Figure>,
    /// What differs, and why.
    pub remarks: Vec<String>,
    pub seconds: f64,
}

#[derive(Serialize, Deserialize)]
pub struct Table {
    pub columns: Vec<String>,
    pub rows: Vec<Row>,
}

#[derive(Serialize, Deserialize)]
pub struct Row {
    pub name: String,
    pub cells: Vec<Cell>,
}

/// A number of ours, and the printed one; either may be missing.
#[derive(Serialize, Deserialize, Clone, Copy)]
pub struct Cell {
    pub ours: Option<f64>,
    pub paper: Option<f64>,
}

#[derive(Serialize, Deserialize)]
pub struct Figure {
    pub caption: String,
    pub svg: String,
}

impl Part {
    pub fn new(about: &str) -> Self {
        Self { about: about.into(), tables: Vec::new(), figures: Vec::new(), remarks: Vec::new(), seconds: 0.0 }
    }

    pub fn table(&mut self, columns: &[&str]) -> &mut Table {
        self.tables.push(Table { columns: columns.iter().map(|&column| column.into()).collect(), rows: Vec::new() });
        let last = self.tables.len() - 1;
        &mut self.tables[last]
    }

    pub fn figure(&mut self, caption: impl Into<String>, svg: String) {
        self.figures.push(Figure { caption: caption.into(), svg });
    }

    pub fn chart(&mut self, caption: &str, x: Axis, y: Axis, curves: &[Curve]) {
        self.figure(caption, chart(x, y, curves, caption));
    }

    pub fn remark(&mut self, words: &str) {
        self.remarks.push(words.into());
    }
}

impl Table {
    /// A row of what was measured beside what was printed; as many as there are columns, missing ones at the end.
    pub fn row(&mut self, name: impl Into<String>, ours: &[f64], paper: &[f64]) {
        let known = |numbers: &[f64], at: usize| numbers.get(at).copied().filter(|number| number.is_finite());
        let cells = (0..self.columns.len()).map(|at| Cell { ours: known(ours, at), paper: known(paper, at) }).collect();
        self.rows.push(Row { name: name.into(), cells });
    }
}
