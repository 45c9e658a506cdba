"""Cases: the input of a run."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

from . import _native
from .errors import call
from .progress import Display

if TYPE_CHECKING:
    from .runs import FractureRun, Run


@dataclass(frozen=True)
class Check:
    """Result of `Case.check`."""

    kind: str
    """`flume`, `dry_test`, `fracture` or `sweep`."""
    warnings: list[str] = field(default_factory=list)
    """Values that are allowed but probably not intended."""
    particles: float | None = None
    """Number of particles of a flume case."""
    steps: float | None = None
    """Number of time steps of a flume case."""
    time_step_s: float | None = None
    memory_bytes: float | None = None


def as_json(value: Any) -> str:
    """Returns keys and values as JSON; numpy arrays become lists, paths become texts."""

    def plain(value: Any) -> Any:
        if hasattr(value, "tolist"):
            return value.tolist()
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        raise TypeError(f"{value!r} cannot be a value in a case")

    return json.dumps(value, default=plain, indent=2, ensure_ascii=False, allow_nan=False)


def _parts(key: str) -> list[str]:
    """Returns the parts of a path: `friction[1].coefficient` has `friction`, `1` and `coefficient`."""
    return key.replace("]", "").replace("[", ".").split(".")


def _entry(value: Any, part: str, key: str) -> Any:
    try:
        return value[int(part)] if isinstance(value, list) else value[part]
    except (KeyError, IndexError, TypeError, ValueError):
        raise KeyError(f"{key}: the case has no such key") from None


class Case:
    """A case file: nested keys, as in the file. Paths of keys are dotted: `case["friction[1].coefficient"]`.

    `path` is the file from which the case comes; the files that the case names (STL, mesh, reference) are relative to
    its folder.
    """

    def __init__(self, keys: Mapping[str, Any], path: str | os.PathLike[str] = "case.json") -> None:
        # Lists and objects are copied, so that a change of the case changes nothing else.
        self._keys: dict[str, Any] = json.loads(as_json(dict(keys)))
        self.path = Path(path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Case:
        """Reads a case file.

        Raises `CaseError` if the file cannot be read or is not JSON. `check` validates keys and values.
        """
        return cls(json.loads(call(_native.read, os.fspath(path))), path)

    def __getitem__(self, key: str) -> Any:
        value: Any = self._keys
        for part in _parts(key):
            value = _entry(value, part, key)
        return value

    def __setitem__(self, key: str, value: Any) -> None:
        try:
            text = as_json(value)
        except ValueError:
            raise ValueError(f"{key} = {value!r}: must be a finite number") from None
        self._keys = json.loads(call(_native.set_key, as_json(self._keys), key, text))

    def __delitem__(self, key: str) -> None:
        *parents, last = _parts(key)
        target: Any = self._keys
        for part in parents:
            target = _entry(target, part, key)
        _entry(target, last, key)
        del target[int(last) if isinstance(target, list) else last]

    def __contains__(self, key: str) -> bool:
        try:
            self[key]
        except KeyError:
            return False
        return True

    def __repr__(self) -> str:
        return f"Case({self._keys.get('title', 'without title')!r}, path={os.fspath(self.path)!r})"

    def copy(self) -> Case:
        """Returns a copy that can be changed on its own."""
        return Case(self._keys, self.path)

    def to_dict(self) -> dict[str, Any]:
        """Returns the keys as nested dictionaries and lists."""
        return json.loads(self.to_json())

    def to_json(self) -> str:
        """Returns the text of the case file."""
        return as_json(self._keys)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the case file. Paths in the case are not changed; they are relative to the folder of the file."""
        Path(path).write_text(self.to_json() + "\n", encoding="utf-8")

    def check(self) -> Check:
        """Validates the case and estimates its cost. Raises `CaseError` with all errors of the case."""
        return Check(**json.loads(call(_native.check, self.to_json(), os.fspath(self.path))))

    def run(
        self,
        out: str | os.PathLike[str],
        *,
        threads: int | None = None,
        device: str = "auto",
        overwrite: bool = False,
        progress: bool = True,
    ) -> Run | FractureRun:
        """Runs the case into the folder `out` and returns the results.

        `threads` is the number of threads (default: all cores; the results do not depend on it). `device` is `auto`,
        `cpu`, `gpu` or `gpu:N`. With `overwrite`, the results of an earlier run in the folder are deleted. Ctrl-C
        writes a checkpoint, from which `resume` continues, and raises `KeyboardInterrupt`.

        Raises `CaseError` if the case is not valid, `RunError` if the run fails, `FileExistsError` if the folder is
        not empty.
        """
        from .runs import open_run

        out = os.fspath(out)
        if os.path.isdir(out) and os.listdir(out) and not overwrite:
            raise FileExistsError(f"{out}: the folder is not empty; choose another one, or pass overwrite=True")
        with Display(progress) as display:
            call(_native.run, self.to_json(), os.fspath(self.path), out, overwrite, threads or 0, device, display.show)
        return open_run(out)
