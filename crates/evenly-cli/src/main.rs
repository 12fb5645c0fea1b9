//! The command line of evenly: stdout is data, stderr is talk.
//!
//! Exit codes: 0 done; 1 done, but what was asked for was not reached (the state reached is written, and said); 2 bad usage or input;
//! 130 interrupted, the state reached written.

mod args;
mod commands;
mod comparison;
mod input;
mod interrupt;
mod measured;
mod measuring_args;
mod mesh_args;
mod method;
mod method_args;
mod optimizer;
mod page;
mod parse;
mod record;
mod reproduce;
mod session;
mod shared_args;
mod sizes;
mod stipple;
mod stipple_args;
mod table;
mod talk;
mod unmet;

use std::process::ExitCode;

use clap::FromArgMatches as _;
use clap::error::ErrorKind;

use args::{Cli, Command};
use talk::say;

/// Bad usage or input.
const BAD_INPUT: u8 = 2;

fn main() -> ExitCode {
    let parsed = args::command().try_get_matches().and_then(|matches| Ok((Cli::from_arg_matches(&matches)?, matches)));
    let (cli, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return usage(&error),
    };
    let flags = matches.subcommand().map(|(_, flags)| flags).unwrap_or(&matches);
    let done = match &cli.command {
        Command::Generate(args) => commands::generate::run(args, flags),
        Command::Optimize(args) => commands::optimize::run(args, flags),
        Command::Analyze(args) => commands::analyze::run(args),
        Command::Stipple(args) => commands::stipple::run(args),
        Command::Mesh(args) => commands::mesh::run(args),
        Command::Compare(args) => commands::compare::run(args, flags),
        Command::Zoneplate(args) => commands::zoneplate::run(args),
        Command::Bilateral(args) => commands::bilateral::run(args),
        Command::Reproduce(args) => commands::reproduce::run(args),
        Command::Completions { shell } => commands::shell::completions(*shell),
        Command::Man => commands::shell::man(),
    };
    done.unwrap_or_else(|error| {
        say(format_args!("error: {error:#}"));
        ExitCode::from(BAD_INPUT)
    })
}

/// Help goes out as it is; an error becomes one line.
fn usage(error: &clap::Error) -> ExitCode {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        return if error.print().is_ok() { ExitCode::SUCCESS } else { ExitCode::from(BAD_INPUT) };
    }
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        say(error.to_string().trim_end());
        return ExitCode::from(BAD_INPUT);
    }
    let text = error.to_string();
    let what: Vec<&str> = text.lines().take_while(|line| !line.trim().is_empty()).map(str::trim).collect();
    say(format_args!("{}; see --help", what.join(" ")));
    ExitCode::from(BAD_INPUT)
}
