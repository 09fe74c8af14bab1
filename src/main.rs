//! The program `asperity`; see `asperity --help`.

fn main() -> std::process::ExitCode {
    asperity::cli::main()
}
