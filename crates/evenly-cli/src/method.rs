//! The registry on the command line: methods as values, and their parameters as flags, whichever methods have them.

use std::marker::PhantomData;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use evenly::{About, Group, Method, ParameterKind, Setting, Settings, Unit};
use evenly_jobs::{Compared, Job, names};

use crate::wording::told;

/// Methods among which a flag or a command chooses.
pub trait Offered {
    const JOB: Job;

    fn methods() -> Vec<Method> {
        Self::JOB.methods()
    }
}

/// Every method.
pub struct Any;
/// Those that improve points.
pub struct Optimizers;
/// Those that make points.
pub struct Starts;
/// Those that follow a density.
pub struct ByDensity;
/// Of these, those that improve points.
pub struct OptimizersByDensity;
/// Those that move the vertices of meshes.
pub struct OnMeshes;
/// Those that spread points over surfaces.
pub struct OnSurfaces;

impl Offered for Any {
    const JOB: Job = Job::Generate;
}

impl Offered for Optimizers {
    const JOB: Job = Job::Optimize;
}

impl Offered for Starts {
    const JOB: Job = Job::Start;
}

impl Offered for ByDensity {
    const JOB: Job = Job::Stipple;
}

impl Offered for OptimizersByDensity {
    const JOB: Job = Job::Stipple;

    fn methods() -> Vec<Method> {
        Self::JOB.methods().into_iter().filter(Method::is_optimizer).collect()
    }
}

impl Offered for OnMeshes {
    const JOB: Job = Job::Mesh;
}

impl Offered for OnSurfaces {
    const JOB: Job = Job::Sample;
}

/// Reads the name of a method that is offered.
pub fn parser<O: Offered>() -> impl TypedValueParser<Value = Method> {
    let offered = O::methods().into_iter().map(|method| PossibleValue::new(method.name()).help(method.title()));
    PossibleValuesParser::new(offered).try_map(|name| Method::named(&name).ok_or("there is no such method"))
}

/// What methods are told: a flag for each parameter that one of those offered has.
pub struct MethodArgs<O> {
    settings: Settings,
    offered: PhantomData<O>,
}

impl<O> MethodArgs<O> {
    /// All that is given.
    pub fn settings(&self) -> Settings {
        self.settings.clone()
    }
}

impl<O: Offered> FromArgMatches for MethodArgs<O> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut settings = Settings::default();
        for (about, _) in parameters::<O>() {
            let is_given = matches.value_source(about.name) == Some(ValueSource::CommandLine);
            let value = if about.kind == ParameterKind::Flag { Some(&Setting::On) } else { matches.get_one::<Setting>(about.name) };
            if let Some(value) = value.filter(|_| is_given) {
                settings.set(about.name, value.clone());
            }
        }
        Ok(Self { settings, offered: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<O: Offered> Args for MethodArgs<O> {
    fn augment_args(command: Command) -> Command {
        command.args(parameters::<O>().into_iter().map(|(about, takers)| argument(about, &help::<O>(&takers))))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// A parameter's flag.
fn argument(about: About, help: &Help) -> Arg {
    let heading = match about.group {
        Group::Targets => "Targets",
        Group::Steps => "Steps",
        Group::Starts => "Starts",
    };
    let arg = Arg::new(about.name).long(flag(about.name)).help(help.short.clone()).help_heading(heading);
    let arg = arg.long_help(help.long.clone()).hide_short_help(about.is_rare);
    // The one that is given most.
    let arg = if about.name == "iterations" { arg.short('i') } else { arg };
    match about.kind {
        ParameterKind::Flag => arg.action(ArgAction::SetTrue),
        ParameterKind::Choice(choices) => {
            let values = choices.iter().map(|choice| PossibleValue::new(choice.name).help(choice.doc));
            arg.value_name(about.name.to_uppercase()).value_parser(PossibleValuesParser::new(values).map(Setting::Choice))
        }
        ParameterKind::Number => with_value(arg, about, ValueParser::new(number)),
        ParameterKind::Target => with_value(arg, about, ValueParser::new(target)),
        ParameterKind::Count => with_value(arg, about, ValueParser::new(count)),
    }
}

fn with_value(arg: Arg, about: About, parser: ValueParser) -> Arg {
    arg.value_name(about.symbol).value_parser(parser).allow_negative_numbers(true)
}

/// Reads a method and what it alone is told, as `push-pull:min-distance=0.8,coverage-radius=0.65`.
pub fn parse_compared(text: &str) -> Result<Compared, String> {
    let (name, words) = text.split_once(':').unwrap_or((text, ""));
    let method = Method::named(name).ok_or_else(|| format!("there is no method {name:?}; evenly methods lists them"))?;
    let mut settings = Settings::default();
    for word in words.split(',').filter(|word| !word.is_empty()) {
        let (flag, value) = word.split_once('=').unwrap_or((word, "on"));
        let name = flag.replace('-', "_");
        let known = method.parameters().into_iter().find(|(about, _)| about.name == name);
        let (about, _) = known.ok_or_else(|| format!("{method} has no {flag}; evenly methods {method} lists what it has"))?;
        let value = match about.kind {
            ParameterKind::Number => number(value),
            ParameterKind::Target => target(value),
            ParameterKind::Count => count(value),
            ParameterKind::Flag if value == "on" => Ok(Setting::On),
            ParameterKind::Flag => Err("it takes no value".into()),
            ParameterKind::Choice(_) => Ok(Setting::Choice(value.into())),
        };
        settings.set(about.name, value.map_err(|why| format!("{word}: {why}"))?);
    }
    Job::Generate.check(method, &settings).map_err(|error| told(error).to_string())?;
    Ok(Compared { label: text.into(), method, parameters: settings })
}

fn number(text: &str) -> Result<Setting, String> {
    text.parse()
}

fn target(text: &str) -> Result<Setting, String> {
    if text == "off" { Ok(Setting::Off) } else { number(text).map_err(|why| format!("{why}, or off")) }
}

fn count(text: &str) -> Result<Setting, String> {
    text.parse().map(Setting::Count).map_err(|_| "it must be a count".into())
}

/// What help says of a parameter.
struct Help {
    /// In a line or two.
    short: String,
    /// All of it.
    long: String,
}

/// A parameter as one method has it.
type Taker = (Method, About, Option<Setting>);

/// The parameters of all methods that are offered, in their order, with those that have them.
fn parameters<O: Offered>() -> Vec<(About, Vec<Taker>)> {
    let mut found: Vec<(About, Vec<Taker>)> = Vec::new();
    for method in O::methods() {
        for (about, default) in method.parameters() {
            match found.iter_mut().find(|(known, _)| known.name == about.name) {
                Some((_, takers)) => takers.push((method, about, default)),
                None => found.push((about, vec![(method, about, default)])),
            }
        }
    }
    found
}

/// The methods' words on a parameter, each once.
fn help<O: Offered>(takers: &[Taker]) -> Help {
    let n_with_any = O::methods().iter().filter(|method| !method.parameters().is_empty()).count();
    let docs = grouped(takers, |(_, about, _)| about.doc.to_owned());
    let mut short = match &docs[..] {
        [(doc, _)] if takers.len() == n_with_any => doc.clone(),
        docs => docs.iter().map(|(doc, methods)| format!("{}: {doc}", names(methods))).collect::<Vec<_>>().join("; "),
    };
    if takers.iter().all(|(_, about, _)| about.kind == ParameterKind::Target) {
        short += "; or off";
    }
    if takers.iter().any(|(_, about, _)| about.unit == Unit::Spacings) {
        short += "; 8u is 8 input units";
    }
    let defaults = grouped(takers, |(_, about, default)| match default {
        _ if !about.default.is_empty() => about.default.to_owned(),
        Some(value) if about.kind != ParameterKind::Flag => value.to_string(),
        _ => String::new(),
    });
    let mut long = short.clone();
    match &defaults[..] {
        [(value, _)] if value.is_empty() => {}
        [(value, _)] => {
            short += &format!(" [default: {value}]");
            long = short.clone();
        }
        several => {
            let told = several.iter().filter(|(value, _)| !value.is_empty()).map(|(value, methods)| format!("{}: {value}", names(methods)));
            short += " [default: by the method]";
            long += &format!(" [default: {}]", told.collect::<Vec<_>>().join("; "));
        }
    }
    let details = takers.iter().filter(|(_, about, _)| !about.details.is_empty());
    details.for_each(|(method, about, _)| long += &format!("\n\n{method}: {}", about.details));
    Help { short, long }
}

/// What is said of methods, each once, and of which it is.
fn grouped(takers: &[Taker], say: impl Fn(&Taker) -> String) -> Vec<(String, Vec<Method>)> {
    let mut groups: Vec<(String, Vec<Method>)> = Vec::new();
    for taker in takers {
        let said = say(taker);
        match groups.iter_mut().find(|(known, _)| *known == said) {
            Some((_, methods)) => methods.push(taker.0),
            None => groups.push((said, vec![taker.0])),
        }
    }
    groups
}

fn flag(name: &str) -> String {
    name.replace('_', "-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_of_the_registry_is_a_flag_with_its_methods_and_default_in_the_help() {
        let mut generate = <crate::args::Cli as clap::CommandFactory>::command()
            .get_subcommands()
            .find(|verb| verb.get_name() == "generate")
            .cloned()
            .unwrap_or_default();
        let help = generate.render_long_help().to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        for method in Method::all() {
            assert!(help.contains(method.title()), "{method}");
            for (about, _) in method.parameters() {
                let arg = generate.get_arguments().find(|arg| arg.get_id() == about.name);
                let told = arg.and_then(Arg::get_long_help).map(ToString::to_string).unwrap_or_default();
                assert!(told.contains(about.doc) && told.contains(about.default), "{method} {}", about.name);
            }
        }
    }

    #[test]
    fn a_method_can_be_told_by_itself() {
        let told = parse_compared("push-pull:min-distance=0.8,capacity-tolerance=off,schedule=summed")
            .map(|told| (told.method.name(), told.parameters));
        let wanted = Settings::default().with("min_distance", Setting::Number(0.8)).with("capacity_tolerance", Setting::Off);
        assert_eq!(told, Ok(("push-pull", wanted.with("schedule", Setting::Choice("summed".into())))));
        assert!(parse_compared("farthest-point:local").is_ok());
        for wrong in ["", "x", "lloyd:beta=1", "lloyd:iterations=0", "lloyd:iterations", "push-pull:preset=x", "farthest-point:local=2"] {
            assert!(parse_compared(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn values_are_read_by_their_kind() {
        let read = |words: &[&str]| {
            let command = MethodArgs::<Any>::augment_args(Command::new("words").no_binary_name(true));
            command.try_get_matches_from(words).and_then(|matches| MethodArgs::<Any>::from_arg_matches(&matches)).map(|args| args.settings)
        };
        let settings = read(&["--min-distance=off", "--side=2", "--iterations=3", "--mode=paper", "--local"]).unwrap_or_default();
        let wanted = [
            ("iterations", Setting::Count(3)),
            ("local", Setting::On),
            ("min_distance", Setting::Off),
            ("mode", Setting::Choice("paper".into())),
            ("side", Setting::Number(2.0)),
        ];
        assert_eq!(settings, wanted.into_iter().fold(Settings::default(), |all, (name, value)| all.with(name, value)));
        for wrong in ["--min-distance=on", "--side=a", "--iterations=1.5", "--iterations=off", "--mode=slow", "--local=yes"] {
            assert!(read(&[wrong]).is_err(), "{wrong}");
        }
    }
}
