"""Sweeps: many runs of one case in which the values of some keys vary."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any, Mapping

import pandas as pd

from . import _native
from .cases import as_json
from .errors import RunError, call
from .runs import FractureRun, Run, open_run


class Sweep:
    """The folder of a sweep."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        if not (self.path / "sweep.csv").exists():
            raise RunError(f"{self.path}: is not the folder of a finished sweep, because sweep.csv is missing")

    @property
    def table(self) -> pd.DataFrame:
        """One row per run: values of the keys, damage ratio, displacements."""
        return pd.read_csv(self.path / "sweep.csv")

    @property
    def runs(self) -> list[Run | FractureRun]:
        """The finished runs, in the order of the table."""
        table = self.table
        return [open_run(self.path / name) for name in table["run"][table["state"] == "finished"]]

    def __repr__(self) -> str:
        return f"Sweep({os.fspath(self.path)!r})"


def sweep(
    source: str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str],
    *,
    threads: int = 1,
    jobs: int | None = None,
    device: str = "auto",
    progress: bool = True,
) -> Sweep:
    """Makes the runs of a sweep into the folder `out`, each in a process of its own, and returns the results.

    `source` is a sweep file, or its keys: `{"title": ..., "case": path, "vary": [{"key": ..., "values": [...]}]}`.
    `jobs` is the number of runs at the same time, each with `threads` threads. Finished runs are kept: after an
    interruption, the same call continues.

    Raises `CaseError` if the sweep file is not valid, `RunError` if a run of it is not valid or fails. Ctrl-C stops the
    runs with a checkpoint.
    """
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    if isinstance(source, Mapping):
        keys = dict(source)
        if "case" in keys:
            keys["case"] = os.path.abspath(keys["case"])
        file = out / "sweep.json"
        file.write_text(as_json(keys) + "\n", encoding="utf-8")
    else:
        file = Path(source)
    call(_native.check, file.read_text(encoding="utf-8"), os.fspath(file))
    command = [sys.executable, "-m", "breakwater_sim", "sweep", os.fspath(file), "--out", os.fspath(out)]
    command += ["--threads", str(threads), "--device", device, *(["--jobs", str(jobs)] if jobs else [])]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    # A group of its own, so that a signal reaches the runs, too.
    with subprocess.Popen(command, start_new_session=True, **pipes) as process:
        lines = []
        try:
            for line in process.stdout:
                lines.append(line)
                if progress:
                    print(line, end="", file=sys.stderr)
        except KeyboardInterrupt:
            os.killpg(process.pid, signal.SIGINT)
            raise
    if process.returncode != 0:
        raise RunError("".join(lines[-20:]).strip())
    return Sweep(out)
