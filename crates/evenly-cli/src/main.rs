//! The command line of evenly: stdout is data, stderr is talk.
//!
//! Exit codes: 0 done; 1 done, but what was asked for was not reached (the state reached is written, and said); 2 bad usage or input;
//! 130 interrupted, the state reached written.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(evenly_cli::run(std::env::args_os()))
}
