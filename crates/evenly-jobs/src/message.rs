//! [`Message`]: what a job says. Parameters are named in it as each face names them: `--edge-length` on the command line, `edge_length` in Python.

use std::borrow::Cow;
use std::fmt;

use serde::{Serialize, Serializer};

/// How a face writes parameters.
pub trait Wording {
    /// A parameter's name.
    fn name(&self, parameter: &str) -> String;

    /// A parameter with a value.
    fn setting(&self, parameter: &str, value: &str) -> String;
}

/// Names as they are in requests.
pub struct Plain;

impl Wording for Plain {
    fn name(&self, parameter: &str) -> String {
        parameter.to_owned()
    }

    fn setting(&self, parameter: &str, value: &str) -> String {
        format!("{parameter} {value}")
    }
}

/// Words in which parameters are named as the face names them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Message(Vec<Part>);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Part {
    Text(Cow<'static, str>),
    Name(String),
    Setting(&'static str, String),
}

impl Message {
    /// Goes on with words.
    #[must_use]
    pub fn text(mut self, text: impl Into<Cow<'static, str>>) -> Self {
        self.0.push(Part::Text(text.into()));
        self
    }

    /// Goes on with a parameter's name.
    #[must_use]
    pub fn name(mut self, parameter: impl Into<String>) -> Self {
        self.0.push(Part::Name(parameter.into()));
        self
    }

    /// Goes on with a parameter and a value for it.
    #[must_use]
    pub fn setting(mut self, parameter: &'static str, value: impl fmt::Display) -> Self {
        self.0.push(Part::Setting(parameter, value.to_string()));
        self
    }

    /// The words that a face shows.
    pub fn shown(&self, wording: &dyn Wording) -> String {
        let part = |part: &Part| match part {
            Part::Text(text) => text.clone().into_owned(),
            Part::Name(parameter) => wording.name(parameter),
            Part::Setting(parameter, value) => wording.setting(parameter, value),
        };
        self.0.iter().map(part).collect()
    }
}

impl<T: Into<Cow<'static, str>>> From<T> for Message {
    fn from(text: T) -> Self {
        Self::default().text(text)
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.shown(&Plain))
    }
}

/// As its words.
impl Serialize for Message {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Flags;

    impl Wording for Flags {
        fn name(&self, parameter: &str) -> String {
            format!("--{}", parameter.replace('_', "-"))
        }

        fn setting(&self, parameter: &str, value: &str) -> String {
            format!("{} {value}", self.name(parameter))
        }
    }

    #[test]
    fn parameters_are_named_as_the_face_names_them() {
        let message = Message::from("too long: ").name("edge_length").text(" is 3; try ").setting("edge_length", 2.5);
        assert_eq!(message.to_string(), "too long: edge_length is 3; try edge_length 2.5");
        assert_eq!(message.shown(&Flags), "too long: --edge-length is 3; try --edge-length 2.5");
    }
}
