//! How long an XML document becomes when its own entities are put in.

use std::collections::HashMap;

/// Entities in entities go no deeper than this, as of the parser.
const DEEPEST: usize = 10;

/// The length of a document, in bytes, with all of its own entities put in.
pub(super) fn expanded_length(text: &str) -> u64 {
    if !text.contains("<!ENTITY") {
        return text.len() as u64;
    }
    let values: HashMap<&str, &str> = declared(text).collect();
    length(text, &values, DEEPEST)
}

/// Names of entities and what they stand for.
fn declared(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split("<!ENTITY").skip(1).filter_map(|rest| {
        let rest = rest.trim_start();
        let (name, rest) = rest.split_at(rest.find(char::is_whitespace)?);
        let rest = rest.trim_start();
        let quote = rest.chars().next().filter(|c| ['"', '\''].contains(c))?;
        Some((name, &rest[1..1 + rest[1..].find(quote)?]))
    })
}

fn length(text: &str, values: &HashMap<&str, &str>, depth: usize) -> u64 {
    // What is used often is measured once.
    let mut uses: HashMap<&str, u64> = HashMap::new();
    for rest in text.split('&').skip(1) {
        if let Some((name, _)) = rest.split_once(';')
            && values.contains_key(name)
        {
            *uses.entry(name).or_default() += 1;
        }
    }
    let of = |(name, n): (&str, u64)| if depth > 0 { n.saturating_mul(length(values[name], values, depth - 1)) } else { 0 };
    uses.into_iter().map(of).fold(text.len() as u64, u64::saturating_add)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entities_count_as_often_as_they_are_used() {
        let head = "<!DOCTYPE svg [<!ENTITY a \"12345\"> <!ENTITY b '&a;&a;'>]>";
        let text = format!("{head}<svg>&b;&b;&amp;</svg>");
        // Of the declarations themselves too: that of b uses a twice.
        assert_eq!(expanded_length(&text), text.len() as u64 + 2 * (6 + 10) + 10);
        assert_eq!(expanded_length("<svg>&amp;</svg>"), 16);
    }

    #[test]
    fn entities_that_use_themselves_have_some_length() {
        assert!(expanded_length("<!ENTITY a '&a;&a;'><svg>&a;</svg>") > 0);
    }
}
