//! [`Error`]: what is wrong with a request, as data. A face shows its [`Message`], with its own names of parameters.

use std::fmt;

use evenly::Method;

use crate::message::{Message, Plain};

/// What is wrong with a request.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// What the library says of a parameter, by the request's name of it.
    Library(evenly::Error),
    /// What the library says of data.
    Data {
        /// What the data are called.
        name: String,
        /// What is wrong with them.
        error: evenly::Error,
    },
    /// Data that the face cannot find or read.
    Resource(String),
    /// A parameter that the method does not have.
    NotTaken {
        /// The parameter.
        parameter: String,
        /// The methods that have it.
        methods: Vec<Method>,
    },
    /// A method that the job cannot do with.
    NotOffered {
        /// The parameter that names the method.
        parameter: &'static str,
        /// The method.
        method: Method,
        /// What the job offers.
        offered: Vec<Method>,
    },
    /// A surface that could be repaired.
    Repairable {
        /// What it is called.
        name: String,
        /// What is wrong with it.
        error: evenly::Error,
    },
    /// Anything else.
    Said(Message),
}

impl Error {
    /// A value outside its range.
    pub fn invalid(name: &'static str, value: impl fmt::Display, expected: &'static str) -> Self {
        Self::Library(evenly::Error::InvalidParameter { name, value: value.to_string(), expected })
    }

    /// The library's error about data of some name, or about a parameter that has another name in the request.
    pub fn of(error: evenly::Error, data: &str, names: &[(&'static str, &'static str)]) -> Self {
        match renamed(error, names) {
            error @ evenly::Error::InvalidParameter { .. } => Self::Library(error),
            error => Self::Data { name: data.to_owned(), error },
        }
    }

    /// What it says.
    pub fn message(&self) -> Message {
        match self {
            Self::Library(error) => of_library(error),
            Self::Data { name, error } => Message::from(format!("{name}: {error}")),
            Self::Resource(text) => text.clone().into(),
            Self::NotTaken { parameter, methods } => {
                Message::default().name(parameter.as_str()).text(" is for ").name("method").text(format!(" {}", names(methods)))
            }
            Self::NotOffered { parameter, method, offered } => {
                Message::default().name(*parameter).text(format!(" is {method}; it must be one of {}", names(offered)))
            }
            Self::Repairable { name, error } => Message::from(format!("{name}: {error} (")).name("repair").text(")"),
            Self::Said(message) => message.clone(),
        }
    }
}

fn of_library(error: &evenly::Error) -> Message {
    let message = Message::default();
    match error {
        evenly::Error::InvalidParameter { name, value, expected } => {
            message.name(*name).text(format!(" is {value}; it must be {expected}"))
        }
        evenly::Error::Missing { names, question } => {
            let or = |message: Message, (k, name): (usize, &&'static str)| if k == 0 { message } else { message.text(" or ") }.name(*name);
            names.iter().enumerate().fold(message, or).text(format!(" is missing: {question}"))
        }
        evenly::Error::Excluded { names: [one, other], why } => {
            message.name(*one).text(" and ").name(*other).text(format!(" exclude each other: {why}"))
        }
        other => other.to_string().into(),
    }
}

/// The same error, with the request's names of parameters.
pub fn renamed(error: evenly::Error, names: &[(&'static str, &'static str)]) -> evenly::Error {
    /// What limits the length of a run has many names in the library.
    const LIMITS: [&str; 3] = ["max_passes", "max_iterations", "max_sweeps"];
    let request = |name: &'static str| match names.iter().find(|(own, _)| *own == name) {
        Some(&(_, request)) => request,
        None if LIMITS.contains(&name) => "iterations",
        None => name,
    };
    match error {
        evenly::Error::InvalidParameter { name, value, expected } => {
            evenly::Error::InvalidParameter { name: request(name), value, expected }
        }
        other => other,
    }
}

/// Names for a sentence.
pub fn names(methods: &[Method]) -> String {
    match methods {
        [all @ .., last] if !all.is_empty() => {
            let all: Vec<&str> = all.iter().map(Method::name).collect();
            format!("{} or {last}", all.join(", "))
        }
        [one] => one.name().to_owned(),
        _ => String::new(),
    }
}

impl From<evenly::Error> for Error {
    fn from(error: evenly::Error) -> Self {
        Self::Library(renamed(error, &[]))
    }
}

impl From<evenly_io::Error> for Error {
    fn from(error: evenly_io::Error) -> Self {
        Self::Resource(error.to_string())
    }
}

impl From<Message> for Error {
    fn from(message: Message) -> Self {
        Self::Said(message)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.message().shown(&Plain))
    }
}

impl std::error::Error for Error {}
