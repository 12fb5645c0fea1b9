//! The command line of evenly as a library, so that other faces give the same answers to the same wishes.

mod args;
mod commands;
mod comparison;
mod files;
mod interrupt;
mod measured;
mod measuring_args;
mod memory;
mod mesh_args;
mod method;
mod page;
mod parse;
mod places;
mod record;
mod remesh_args;
mod reproduce;
mod session;
mod shared_args;
mod stipple;
mod stipple_args;
mod surface_measures;
mod table;
mod talk;
mod usage;
mod watch;
mod wording;

use std::ffi::OsString;

use clap::{CommandFactory as _, FromArgMatches as _};

use args::{Cli, Command};
use talk::say;

/// Bad usage or input.
const BAD_INPUT: u8 = 2;

/// Runs a command line, whose first word is the program, and returns its exit code.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = words.into_iter().collect();
    record::keep_command(&words);
    interrupt::listen();
    let parsed = Cli::command().try_get_matches_from(&words).and_then(|matches| Cli::from_arg_matches(&matches));
    let cli = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return usage::show(&error, &words),
    };
    memory::keep_within(cli.memory);
    let done = match &cli.command {
        Command::Generate(args) => commands::generate::run(args),
        Command::Optimize(args) => commands::optimize::run(args),
        Command::Analyze(args) => commands::analyze::run(args),
        Command::Stipple(args) => commands::stipple::run(args),
        Command::Mesh(args) => commands::mesh::run(args),
        Command::Remesh(args) => commands::remesh::run(args),
        Command::Sample(args) => commands::sample::run(args),
        Command::Compare(args) => commands::compare::run(args),
        Command::Zoneplate(args) => commands::zoneplate::run(args),
        Command::Bilateral(args) => commands::bilateral::run(args),
        Command::Methods(args) => commands::methods::run(args),
        Command::Reproduce(args) => commands::reproduce::run(args),
        Command::Completions { shell } => commands::shell::completions(*shell),
        Command::Man => commands::shell::man(),
    };
    done.unwrap_or_else(|error| {
        say(format_args!("error: {error:#}"));
        BAD_INPUT
    })
}
