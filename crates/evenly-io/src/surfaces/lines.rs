//! Lines of text files and the words in them, as bytes, since names may be in any encoding.

use crate::Error;
use crate::text::parse;

/// What is left of a text.
pub(super) struct Text<'a> {
    name: &'a str,
    /// What has not been read.
    pub rest: &'a [u8],
    n_lines: usize,
    is_continued: bool,
}

/// A line, without its comment.
pub(super) struct Line<'a> {
    name: &'a str,
    /// Counted from 1.
    pub number: usize,
    rest: &'a [u8],
}

impl<'a> Text<'a> {
    /// The text of file `name`.
    pub fn new(name: &'a str, bytes: &'a [u8]) -> Self {
        Self { name, rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), n_lines: 0, is_continued: false }
    }

    /// With lines that go on after a backslash at their end.
    pub fn continued(self) -> Self {
        Self { is_continued: true, ..self }
    }

    /// The next line that has words.
    pub fn next_line(&mut self) -> Option<Line<'a>> {
        while !self.rest.is_empty() {
            let number = self.n_lines + 1;
            let whole = self.take();
            let line = whole.iter().position(|&c| c == b'#').map_or(whole, |end| &whole[..end]);
            if !line.iter().all(|&c| is_blank(c)) {
                return Some(Line { name: self.name, number, rest: line });
            }
        }
        None
    }

    /// Takes a line, with those that it goes on in.
    fn take(&mut self) -> &'a [u8] {
        let mut length = 0;
        loop {
            let left = &self.rest[length..];
            let end = left.iter().position(|&c| c == b'\n').map_or(left.len(), |end| end + 1);
            length += end;
            self.n_lines += 1;
            let is_over = !self.is_continued || length == self.rest.len() || !left[..end].trim_ascii_end().ends_with(b"\\");
            if is_over {
                let (line, rest) = self.rest.split_at(length);
                self.rest = rest;
                return line;
            }
        }
    }

    /// The next line that has words, where there should be one.
    pub fn expect_line(&mut self, expected: impl FnOnce() -> String) -> Result<Line<'a>, Error> {
        self.next_line().ok_or_else(|| self.cut_short(&expected()))
    }

    /// That the text ends too early, after its last line.
    pub fn cut_short(&self, expected: &str) -> Error {
        Error::content(format!("{}:{}", self.name, self.n_lines), format!("the file ends here, but there should be {expected}"))
    }
}

impl<'a> Line<'a> {
    /// The next word.
    pub fn word(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|&c| !is_blank(c))?;
        let rest = &self.rest[start..];
        let (word, rest) = rest.split_at(rest.iter().position(|&c| is_blank(c)).unwrap_or(rest.len()));
        self.rest = rest;
        Some(word)
    }

    /// The next word as a number.
    fn number(&mut self, what: &str) -> Result<f64, Error> {
        let word = String::from_utf8_lossy(self.expect(what)?);
        match word.parse::<f64>() {
            Ok(x) if !x.is_finite() => Ok(x),
            _ => parse(&word).map_err(|problem| self.problem(problem)),
        }
    }

    /// Three numbers, which may be no finite ones: some writers have such for vertices of no face.
    pub fn position(&mut self) -> Result<[f64; 3], Error> {
        Ok([self.number("x")?, self.number("y")?, self.number("z")?])
    }

    /// Three finite numbers.
    pub fn finite_position(&mut self) -> Result<[f64; 3], Error> {
        let position = self.position()?;
        match position.iter().find(|x| !x.is_finite()) {
            Some(x) => Err(self.problem(format!("{x} is not a finite number"))),
            None => Ok(position),
        }
    }

    /// The next word as a whole number from 0.
    pub fn count(&mut self, what: &str) -> Result<usize, Error> {
        let word = String::from_utf8_lossy(self.expect(what)?);
        word.parse().map_err(|_| self.problem(format!("{what} is '{}', expected a whole number from 0", shown(word.as_bytes()))))
    }

    /// The next word.
    pub fn expect(&mut self, what: &str) -> Result<&'a [u8], Error> {
        self.word().ok_or_else(|| self.problem(format!("the line ends where there should be {what}")))
    }

    /// The file's name and the line's number.
    pub fn place(&self) -> String {
        format!("{}:{}", self.name, self.number)
    }

    /// That something is wrong in this line.
    pub fn problem(&self, problem: impl Into<String>) -> Error {
        Error::content(self.place(), problem)
    }
}

/// A word for messages.
pub(super) fn shown(word: &[u8]) -> String {
    String::from_utf8_lossy(word).chars().take(20).flat_map(char::escape_debug).collect()
}

/// A backslash stands only where a line goes on.
fn is_blank(c: u8) -> bool {
    c.is_ascii_whitespace() || c == b'\\'
}
