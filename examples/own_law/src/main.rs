//! The program `asperity` with one law more: `cargo run --release -- run film.toml`.

use own_law as _; // without this line the law is not linked

fn main() -> std::process::ExitCode {
    asperity::cli::main()
}
