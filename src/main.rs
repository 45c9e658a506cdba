//! The `breakwater` program; the command line is in [`breakwater::cli`].

fn main() -> std::process::ExitCode {
    restore_default_sigpipe();
    silence_device_selection();
    breakwater::cli::run_command(std::env::args_os())
}

/// Ends the process silently if the reader of its output closes the pipe, as `head` does in
/// `breakwater check case.json | head`. By default, Rust ignores the signal SIGPIPE, and `println!` panics.
#[cfg(unix)]
fn restore_default_sigpipe() {
    // SAFETY: SIG_DFL installs no handler function, and no other thread runs yet.
    unsafe { libc::signal(libc::SIGPIPE, libc::SIG_DFL) };
}

#[cfg(not(unix))]
fn restore_default_sigpipe() {}

/// Switches off a Vulkan layer of Mesa that reorders the graphics cards. It prints an error about XDG_RUNTIME_DIR on
/// machines without a screen, and the option --device chooses the card anyway.
fn silence_device_selection() {
    if std::env::var_os("MESA_VK_DEVICE_SELECT").is_none() {
        // SAFETY: no other thread runs yet.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
