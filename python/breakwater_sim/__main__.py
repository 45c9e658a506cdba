"""The command line: `breakwater ...` or `python -m breakwater_sim ...`."""

import signal
import sys

from ._native import command_line


def main() -> None:
    # The program has its own handling of Ctrl-C: a run writes a checkpoint.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    started_by = [sys.executable, "-m", "breakwater_sim"]
    sys.exit(command_line(started_by, ["breakwater", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
