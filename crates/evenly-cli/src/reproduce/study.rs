//! A paper's reproduction: its parts, done one after the other, each kept as soon as it is done.

use std::time::Instant;

use evenly_io::Scraps;
use serde::Serialize;

use super::lab::{Interrupted, Lab};
use super::part::Part;
use crate::record;

/// A paper.
pub struct Study {
    /// The name on the command line.
    pub name: &'static str,
    pub title: &'static str,
    pub citation: &'static str,
    /// Its figures and tables, by the paper's names.
    pub parts: &'static [(&'static str, Work)],
}

/// How a part is done.
type Work = fn(&Lab) -> anyhow::Result<Part>;

/// A part that is done.
#[derive(Serialize)]
pub struct Done {
    pub name: &'static str,
    #[serde(flatten)]
    pub part: Part,
}

impl Study {
    /// Does what is not among the scraps of an earlier run; fewer than all parts after Ctrl-C.
    pub fn run(&self, lab: &Lab, scraps: &Scraps) -> anyhow::Result<Vec<Done>> {
        let mut done = Vec::new();
        for &(name, work) in self.parts {
            lab.bar.set_prefix(name);
            let key = format!("{}.json", name.to_lowercase().replace(' ', "-"));
            // What another version left is done again.
            let kept = scraps.get(&key).and_then(|text| serde_json::from_str::<(String, Part)>(&text).ok());
            let part = match kept.filter(|(version, _)| version == record::VERSION) {
                Some((_, part)) => part,
                None => {
                    let clock = Instant::now();
                    let mut part = match work(lab) {
                        Err(error) if error.is::<Interrupted>() => break,
                        part => part?,
                    };
                    part.seconds = clock.elapsed().as_secs_f64();
                    scraps.put(&key, &serde_json::to_string(&(record::VERSION, &part))?)?;
                    part
                }
            };
            done.push(Done { name, part });
            lab.bar.inc(1);
        }
        Ok(done)
    }
}
