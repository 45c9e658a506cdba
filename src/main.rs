//! The `breakwater` program; everything happens in [`breakwater::cli`].

fn main() -> std::process::ExitCode {
    breakwater::cli::main()
}
