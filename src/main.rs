//! The `breakwater` program; everything happens in [`breakwater::cli`].

fn main() -> std::process::ExitCode {
    end_quietly_when_nobody_reads();
    breakwater::cli::main()
}

/// `breakwater check case.json | head` closes the pipe early; Rust ignores the signal and `println!` would panic.
#[cfg(unix)]
fn end_quietly_when_nobody_reads() {
    // SAFETY: the default action is no handler of ours, and no other thread runs yet.
    unsafe { libc::signal(libc::SIGPIPE, libc::SIG_DFL) };
}

#[cfg(not(unix))]
fn end_quietly_when_nobody_reads() {}
