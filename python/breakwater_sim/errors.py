"""Exceptions of the package."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Callable

from . import _native


@dataclass(frozen=True)
class Problem:
    """One error in a case."""

    message: str
    """The whole message: file, key, value, what is allowed, and what to do."""
    file: str
    key: str | None = None
    """Path of the key, as in `friction[1].coefficient`."""
    value: str | None = None
    """The value, or a value derived from it."""
    allowed: str | None = None
    """What is allowed, or what is wrong."""
    advice: str | None = None
    line: int | None = None
    column: int | None = None


class CaseError(ValueError):
    """A case is not valid. `problems` lists all of its errors; the other attributes are those of the first one."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(problem.message for problem in problems))
        self.problems = problems

    @property
    def key(self) -> str | None:
        return self.problems[0].key

    @property
    def value(self) -> str | None:
        return self.problems[0].value

    @property
    def allowed(self) -> str | None:
        return self.problems[0].allowed

    @property
    def advice(self) -> str | None:
        return self.problems[0].advice


class RunError(RuntimeError):
    """A run failed. The message says why, and which file keeps its state."""


def call(function: Callable[..., Any], *arguments: Any) -> Any:
    """Calls a native function and raises its errors as exceptions of this package."""
    try:
        return function(*arguments)
    except _native.CaseProblems as error:
        raise CaseError([Problem(**problem) for problem in json.loads(str(error))]) from None
    except _native.RunProblem as error:
        raise RunError(str(error)) from None
