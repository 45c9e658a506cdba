"""Progress of a run, as one line that is written again and again; in a notebook, too."""

from __future__ import annotations

import sys
import time


class Display:
    """Shows the simulated time and the time left on standard error. Use it in a `with` statement."""

    INTERVAL_S = 0.5

    def __init__(self, is_shown: bool) -> None:
        self.is_shown = is_shown
        self.begun = time.monotonic()
        self.begun_at: float | None = None
        self.last = 0.0
        self.width = 0

    def __enter__(self) -> Display:
        return self

    def __exit__(self, *_: object) -> None:
        if self.width:
            print(file=sys.stderr)

    def show(self, simulated_s: float, end_s: float) -> None:
        """Shows the progress; called often, writes at most twice a second."""
        now = time.monotonic()
        if self.begun_at is None:
            self.begun_at = simulated_s
        if not self.is_shown or now - self.last < self.INTERVAL_S:
            return
        self.last = now
        speed = (simulated_s - self.begun_at) / max(now - self.begun, 1e-9)
        left = f", {duration((end_s - simulated_s) / speed)} left" if speed > 0.0 else ""
        percent = 100.0 * simulated_s / end_s if end_s > 0.0 else 100.0
        line = f"{percent:3.0f} %  {simulated_s:.4g} of {end_s:.4g} s simulated{left}"
        print(f"\r{line:<{self.width}}", end="", file=sys.stderr, flush=True)
        self.width = max(self.width, len(line))


def duration(seconds: float) -> str:
    """Formats a duration in seconds, minutes or hours."""
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    if seconds < 5400.0:
        return f"{seconds / 60.0:.0f} min"
    return f"{seconds / 3600.0:.1f} h"
