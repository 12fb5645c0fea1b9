//! Messages as they may stand on a terminal or in a log, whatever they quote.

/// Longer quotations are cut, in characters.
const LONGEST_QUOTE: usize = 60;

/// The message with its control characters but line feeds escaped, and what stands between quotation marks cut to 60 characters.
pub fn presentable(message: &str) -> String {
    let escaped: Vec<char> =
        message.chars().flat_map(|c| if c.is_control() && c != '\n' { c.escape_default().collect() } else { vec![c] }).collect();
    let mut told = String::with_capacity(escaped.len());
    let mut rest = escaped.as_slice();
    let mut is_word = false;
    while let Some((&c, after)) = rest.split_first() {
        told.push(c);
        rest = after;
        // An apostrophe within a word quotes nothing.
        let quoted = if !is_word && matches!(c, '\'' | '"' | '`') { after.iter().position(|&end| end == c) } else { None };
        is_word = c.is_alphanumeric();
        if let Some(length) = quoted {
            told.extend(after[..length].iter().take(LONGEST_QUOTE));
            if length > LONGEST_QUOTE {
                told.push('…');
            }
            told.push(c);
            rest = &after[length + 1..];
        }
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_quotations_are_cut_and_controls_escaped() {
        let long = "z".repeat(100);
        assert_eq!(presentable(&format!("file's `{long}`, expected 'x'")), format!("file's `{}…`, expected 'x'", "z".repeat(60)));
        assert_eq!(presentable("a\rb\u{1b}[31m\nnext 'é'"), "a\\rb\\u{1b}[31m\nnext 'é'");
        assert_eq!(presentable("one ' alone"), "one ' alone");
        let path = format!("/{long}/{long}.txt: it's not there");
        assert_eq!(presentable(&path), path);
    }
}
