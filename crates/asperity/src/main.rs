//! The asperity command line.

fn main() -> std::process::ExitCode {
    asperity::cli::main()
}
