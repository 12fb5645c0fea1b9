//! Parameters: each is described once, beside the struct that holds it, and set by its name. The flags of the command line,
//! its help, Python's checks, the docs and the tables of the tests come from these descriptions.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// A value for a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Setting {
    /// A number.
    Number(f64),
    /// A count.
    Count(usize),
    /// A length in input units, for a parameter that counts spacings otherwise: `8u`.
    Length(f64),
    /// One of the parameter's choices, by its name.
    Choice(String),
    /// On, for a parameter that is off otherwise.
    On,
    /// Off, for a target.
    Off,
}

/// As a plain value; off is `null`.
impl Serialize for Setting {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Count(count) => serializer.serialize_u64(*count as u64),
            Self::Length(_) => serializer.collect_str(self),
            Self::Choice(name) => serializer.serialize_str(name),
            Self::On => serializer.serialize_bool(true),
            Self::Off => serializer.serialize_none(),
        }
    }
}

/// A number, or a length in input units, as `8u`.
impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let digits = text.trim_end_matches(|c: char| c.is_alphabetic());
        match (text.parse(), text.strip_suffix('u').and_then(|number| number.parse().ok()), digits.parse::<f64>()) {
            (Ok(number), ..) => Ok(Self::Number(number)),
            (_, Some(length), _) => Ok(Self::Length(length)),
            (.., Ok(number)) if digits.len() < text.len() => {
                Err(format!("inputs have no units; {digits}u is {number} in the input's own, a number alone counts spacings"))
            }
            _ => Err("it must be a number".into()),
        }
    }
}

/// As a plain value; `null`, `false` and `"off"` are off, and `"8u"` is a length in input units.
impl<'de> Deserialize<'de> for Setting {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Plain;

        impl Visitor<'_> for Plain {
            type Value = Setting;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, a name, true or false, or off")
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Setting, E> {
                Ok(Setting::Number(number))
            }

            fn visit_u64<E: de::Error>(self, count: u64) -> Result<Setting, E> {
                Ok(usize::try_from(count).map_or(Setting::Number(count as f64), Setting::Count))
            }

            fn visit_i64<E: de::Error>(self, number: i64) -> Result<Setting, E> {
                Ok(Setting::Number(number as f64))
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<Setting, E> {
                Ok(match name.parse() {
                    Ok(length @ Setting::Length(_)) => length,
                    _ if name == "off" => Setting::Off,
                    _ => Setting::Choice(name.to_owned()),
                })
            }

            fn visit_bool<E: de::Error>(self, is_on: bool) -> Result<Setting, E> {
                Ok(if is_on { Setting::On } else { Setting::Off })
            }

            fn visit_unit<E: de::Error>(self) -> Result<Setting, E> {
                Ok(Setting::Off)
            }
        }

        deserializer.deserialize_any(Plain)
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Count(count) => write!(f, "{count}"),
            Self::Length(length) => write!(f, "{length}u"),
            Self::Choice(name) => f.write_str(name),
            Self::On => f.write_str("on"),
            Self::Off => f.write_str("off"),
        }
    }
}

/// Values by the names of parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Settings(BTreeMap<String, Setting>);

impl Settings {
    /// Sets a parameter; the last value counts.
    pub fn set(&mut self, name: &str, value: Setting) {
        self.0.insert(name.to_owned(), value);
    }

    /// The same, in a row.
    #[must_use]
    pub fn with(mut self, name: &str, value: Setting) -> Self {
        self.set(name, value);
        self
    }

    /// These, and in their place what others say.
    #[must_use]
    pub fn overlaid(self, others: &Self) -> Self {
        others.0.iter().fold(self, |all, (name, value)| all.with(name, value.clone()))
    }

    /// What a parameter is set to.
    pub fn get(&self, name: &str) -> Option<&Setting> {
        self.0.get(name)
    }

    /// Whether nothing is set.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The names of all that is set.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }
}

/// What kind of value a parameter takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParameterKind {
    /// A number.
    Number,
    /// A number, or off.
    Target,
    /// A count, from 1 on.
    Count,
    /// On or off.
    Flag,
    /// One of these, by its name.
    Choice(&'static [Choice]),
}

/// One of several values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// Its name.
    pub name: &'static str,
    /// What it means.
    pub doc: &'static str,
}

/// What a parameter counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Nothing that has a length.
    None,
    /// Spacings: of the hexagonal lattice with as many points, or on meshes of the wanted edge length. A [`Setting::Length`] is one in input units.
    Spacings,
    /// Input units.
    Input,
}

/// What a parameter is for; help shows those of one group together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// What is to be reached.
    Targets,
    /// How it is gone for, and when a run ends.
    Steps,
    /// How points are made.
    Starts,
}

/// A parameter of a method, as people are told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct About {
    /// Its name, the same everywhere: `--min-distance`, `min_distance=`.
    pub name: &'static str,
    /// What kind of value it takes.
    pub kind: ParameterKind,
    /// What stands for the value in help.
    pub symbol: &'static str,
    /// What it counts.
    pub unit: Unit,
    /// What it is for.
    pub group: Group,
    /// Whether short help leaves it out.
    pub is_rare: bool,
    /// What it does, in a line, with unit and range.
    pub doc: &'static str,
    /// What else is good to know.
    pub details: &'static str,
    /// Its value where none is given, in words; empty where it is a single value, or none.
    pub default: &'static str,
}

/// Where a parameter is kept.
pub(crate) enum Field<P> {
    Number(fn(&mut P) -> &mut f64),
    /// `None` stands for what suits the other parameters.
    OwnNumber(fn(&mut P) -> &mut Option<f64>),
    /// `None` stands for off.
    Target(fn(&mut P) -> &mut Option<f64>),
    Count(fn(&mut P) -> &mut usize),
    OwnCount(fn(&mut P) -> &mut Option<usize>),
    Flag(fn(&mut P) -> &mut bool),
    /// Kept by its place among the choices.
    Choice(fn(&P) -> usize, fn(&mut P, usize)),
    /// What parameters begin with: read before any other.
    Beginning,
}

/// A parameter of methods whose parameters are `P`: what it is, and where it is kept.
pub(crate) struct Parameter<P: 'static> {
    pub about: About,
    field: Field<P>,
}

impl<P: Clone> Parameter<P> {
    const fn new(name: &'static str, symbol: &'static str, kind: ParameterKind, field: Field<P>, doc: &'static str) -> Self {
        let about = About { name, kind, symbol, unit: Unit::None, group: Group::Steps, is_rare: false, doc, details: "", default: "" };
        Self { about, field }
    }

    pub const fn number(name: &'static str, symbol: &'static str, field: fn(&mut P) -> &mut f64, doc: &'static str) -> Self {
        Self::new(name, symbol, ParameterKind::Number, Field::Number(field), doc)
    }

    /// A number that depends on other parameters unless it is given.
    pub const fn own_number(name: &'static str, symbol: &'static str, field: fn(&mut P) -> &mut Option<f64>, doc: &'static str) -> Self {
        Self::new(name, symbol, ParameterKind::Number, Field::OwnNumber(field), doc)
    }

    pub const fn target(name: &'static str, symbol: &'static str, field: fn(&mut P) -> &mut Option<f64>, doc: &'static str) -> Self {
        Self::new(name, symbol, ParameterKind::Target, Field::Target(field), doc).of(Group::Targets)
    }

    pub const fn count(name: &'static str, symbol: &'static str, field: fn(&mut P) -> &mut usize, doc: &'static str) -> Self {
        Self::new(name, symbol, ParameterKind::Count, Field::Count(field), doc)
    }

    pub const fn own_count(name: &'static str, symbol: &'static str, field: fn(&mut P) -> &mut Option<usize>, doc: &'static str) -> Self {
        Self::new(name, symbol, ParameterKind::Count, Field::OwnCount(field), doc)
    }

    pub const fn flag(name: &'static str, field: fn(&mut P) -> &mut bool, doc: &'static str) -> Self {
        Self::new(name, "", ParameterKind::Flag, Field::Flag(field), doc)
    }

    pub const fn choice(
        name: &'static str,
        choices: &'static [Choice],
        get: fn(&P) -> usize,
        set: fn(&mut P, usize),
        doc: &'static str,
    ) -> Self {
        Self::new(name, "", ParameterKind::Choice(choices), Field::Choice(get, set), doc)
    }

    /// A choice of what all parameters begin with.
    pub const fn beginning(name: &'static str, choices: &'static [Choice], doc: &'static str) -> Self {
        Self::new(name, "", ParameterKind::Choice(choices), Field::Beginning, doc).of(Group::Targets)
    }

    pub const fn of(mut self, group: Group) -> Self {
        self.about.group = group;
        self
    }

    pub const fn counting(mut self, unit: Unit) -> Self {
        self.about.unit = unit;
        self
    }

    pub const fn rare(mut self) -> Self {
        self.about.is_rare = true;
        self
    }

    pub const fn details(mut self, details: &'static str) -> Self {
        self.about.details = details;
        self
    }

    /// The default in words, where it is no single value.
    pub const fn by_default(mut self, words: &'static str) -> Self {
        self.about.default = words;
        self
    }

    /// Its value in these parameters; `None` for one that is found on the way.
    pub fn get(&self, params: &P) -> Option<Setting> {
        let mut params = params.clone();
        match &self.field {
            Field::Number(field) => Some(Setting::Number(*field(&mut params))),
            Field::OwnNumber(field) => field(&mut params).map(Setting::Number),
            Field::Target(field) => Some(field(&mut params).map_or(Setting::Off, Setting::Number)),
            Field::Count(field) => Some(Setting::Count(*field(&mut params))),
            Field::OwnCount(field) => field(&mut params).map(Setting::Count),
            Field::Flag(field) => Some(if *field(&mut params) { Setting::On } else { Setting::Off }),
            Field::Choice(get, _) => self.choices().get(get(&params)).map(|choice| Setting::Choice(choice.name.to_owned())),
            Field::Beginning => None,
        }
    }

    /// # Errors
    /// [`Error::InvalidParameter`] for a value of another kind.
    pub fn set(&self, params: &mut P, value: &Setting) -> Result<(), Error> {
        match (&self.field, value) {
            (Field::Number(field), Setting::Number(number)) => *field(params) = *number,
            (Field::OwnNumber(field) | Field::Target(field), Setting::Number(number)) => *field(params) = Some(*number),
            (Field::Target(field), Setting::Off) => *field(params) = None,
            (Field::Count(field), Setting::Count(count)) => *field(params) = *count,
            (Field::OwnCount(field), Setting::Count(count)) => *field(params) = Some(*count),
            (Field::Flag(field), Setting::On | Setting::Off) => *field(params) = *value == Setting::On,
            (Field::Choice(_, set), Setting::Choice(name)) => set(params, self.place_of(name)?),
            (Field::Beginning, Setting::Choice(name)) => drop(self.place_of(name)?),
            _ => return Err(self.invalid(value)),
        }
        Ok(())
    }

    fn choices(&self) -> &'static [Choice] {
        if let ParameterKind::Choice(choices) = self.about.kind { choices } else { &[] }
    }

    fn place_of(&self, name: &str) -> Result<usize, Error> {
        let place = self.choices().iter().position(|choice| choice.name == name);
        place.ok_or_else(|| self.invalid(&Setting::Choice(name.to_owned())))
    }

    fn invalid(&self, value: &Setting) -> Error {
        let expected = match self.about.kind {
            ParameterKind::Number => "a number",
            ParameterKind::Target => "a number, or off",
            ParameterKind::Count => "a count",
            ParameterKind::Flag => "on or off",
            ParameterKind::Choice(_) => "one of its choices",
        };
        Error::InvalidParameter { name: self.about.name, value: value.to_string(), expected }
    }
}

/// What is known of a method: what it is called, what it does, and what it can be told.
pub(crate) struct Entry<P: 'static> {
    pub name: &'static str,
    /// What it does, in a line.
    pub title: &'static str,
    /// Authors, year and doi; empty where there are none.
    pub paper: &'static str,
    /// Whether its points follow a density.
    pub knows_density: bool,
    /// The parameters to begin with, before others are set.
    pub begin: fn(&Settings) -> P,
    /// What its own chance depends on, if it has any.
    pub seed: Option<fn(&mut P) -> &mut u64>,
    pub parameters: &'static [Parameter<P>],
}

impl<P: Clone> Entry<P> {
    /// # Errors
    /// [`Error::UnknownParameter`] for one that it has not, [`Error::InvalidParameter`] for a value of another kind.
    pub fn params(&self, settings: &Settings, seed: u64) -> Result<P, Error> {
        let is_known = |name: &str| self.parameters.iter().any(|parameter| parameter.about.name == name);
        if let Some(name) = settings.names().find(|name| !is_known(name)) {
            return Err(Error::UnknownParameter { name: name.to_owned(), method: self.name });
        }
        // A whole number is a number too.
        let is_number = |parameter: &&Parameter<P>| matches!(parameter.about.kind, ParameterKind::Number | ParameterKind::Target);
        let settings = &self.parameters.iter().filter(is_number).fold(settings.clone(), |all, parameter| {
            let name = parameter.about.name;
            if let Some(&Setting::Count(count)) = all.get(name) { all.with(name, Setting::Number(count as f64)) } else { all }
        });
        let mut params = (self.begin)(settings);
        for parameter in self.parameters {
            if let Some(value) = settings.get(parameter.about.name) {
                parameter.set(&mut params, value)?;
            }
        }
        if let Some(field) = self.seed {
            *field(&mut params) = seed;
        }
        Ok(params)
    }

    /// The values of all parameters that these have.
    pub fn values(&self, params: &P) -> Vec<(&'static str, Setting)> {
        self.parameters.iter().filter_map(|parameter| Some((parameter.about.name, parameter.get(params)?))).collect()
    }

    pub fn seed_of(&self, params: &P) -> Option<u64> {
        self.seed.map(|field| *field(&mut params.clone()))
    }
}

/// An entry, whatever its parameters are.
pub(crate) trait AnyEntry: Sync {
    fn name(&self) -> &'static str;
    fn title(&self) -> &'static str;
    fn paper(&self) -> &'static str;
    fn knows_density(&self) -> bool;
    /// Its parameters, and their values where none are given.
    fn parameters(&self) -> Vec<(About, Option<Setting>)>;
}

impl<P: Clone> AnyEntry for Entry<P> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn title(&self) -> &'static str {
        self.title
    }

    fn paper(&self) -> &'static str {
        self.paper
    }

    fn knows_density(&self) -> bool {
        self.knows_density
    }

    fn parameters(&self) -> Vec<(About, Option<Setting>)> {
        let params = (self.begin)(&Settings::default());
        self.parameters.iter().map(|parameter| (parameter.about, parameter.get(&params))).collect()
    }
}
