//! How a command ends: exit codes, and messages on stderr.

use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use crate::scene::SceneError;

/// Exit codes; part of the surface of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Everything asked for was done.
    Done = 0,
    /// The program is at fault, or the machine.
    Internal = 1,
    /// The input cannot be used.
    BadInput = 2,
    /// A step did not converge; results up to there are kept.
    NotConverged = 3,
    /// Every step converged, but the result breaks a property it must have; it is kept.
    AuditFailed = 4,
    /// Stopped by the user; results up to there and a checkpoint are kept.
    Interrupted = 5,
}

/// Why a command could not do its work.
#[derive(Debug)]
pub struct Failure {
    exit: Exit,
    message: String,
}

impl Failure {
    /// The input cannot be used.
    pub fn input(message: impl Display) -> Self {
        Self { exit: Exit::BadInput, message: format!("error: {message}") }
    }

    /// The computation came to an end before its time.
    pub fn not_converged(message: impl Display) -> Self {
        Self { exit: Exit::NotConverged, message: format!("error: {message}") }
    }

    /// The computation is complete, but must not be trusted.
    pub fn audit(message: impl Display) -> Self {
        Self { exit: Exit::AuditFailed, message: format!("error: {message}") }
    }

    /// The program or the machine is at fault.
    pub fn internal(message: impl Display) -> Self {
        Self { exit: Exit::Internal, message: format!("error: {message}") }
    }

    /// Exit code of the command.
    pub fn exit(&self) -> Exit {
        self.exit
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self { exit: Exit::BadInput, message: error.to_string() }
    }
}

/// Prints a failure and gives the exit code.
pub fn report(outcome: Result<Exit, Failure>) -> ExitCode {
    let exit = outcome.unwrap_or_else(|failure| {
        // nobody is left to be told if stderr is closed
        let _ = writeln!(std::io::stderr(), "{failure}");
        failure.exit()
    });
    ExitCode::from(exit as u8)
}

/// Prints a note to stderr. A closed stderr must not stop a computation.
pub fn note(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Prints a warning to stderr. A closed stderr must not stop a computation.
pub fn warn(warning: impl Display) {
    let _ = writeln!(std::io::stderr(), "warning: {warning}");
}

/// Writes to stdout. A reader that has seen enough (`asperity laws | head`) is no error.
pub fn say(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::internal(format!("stdout: {error}"))),
        _ => Ok(()),
    }
}
