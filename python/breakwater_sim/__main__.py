"""The command line: `breakwater ...` or `python -m breakwater_sim ...`."""

import os
import signal
import sys

from ._native import command_line


def main() -> None:
    # The program has its own handling of Ctrl-C: a run writes a checkpoint.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # End silently if the reader of the output closes the pipe, as `head` does.
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    # A layer of Mesa would reorder the graphics cards; see src/main.rs.
    os.environ.setdefault("NODEVICE_SELECT", "1")
    started_by = [sys.executable, "-m", "breakwater_sim"]
    sys.exit(command_line(started_by, ["breakwater", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
