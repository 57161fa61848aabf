# SPDX-License-Identifier: Apache-2.0
"""A hard case, how it is declared and how it is judged."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any, NamedTuple


class Case(NamedTuple):
    name: str
    group: str
    why: str
    """What makes it hard, one line."""
    measures: str
    """What the number is."""
    limit: float
    unit: str
    run: Callable[..., float]
    """Gives the number; takes `scale` (1, or 10 with --long) where `has_long`."""
    has_long: bool = False
    note: str = ""
    """Where the limit comes from, if not from the case itself."""


class Outcome(NamedTuple):
    case: Case
    value: float
    """In the case's unit; NaN where it broke."""
    passed: bool
    seconds: float
    problem: str = ""
    """What was raised, if anything."""


class Group(list[Case]):
    """The cases of one group, filled by `@group.case(...)`."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name

    def case(
        self,
        why: str,
        measures: str,
        limit: float,
        unit: str,
        *,
        has_long: bool = False,
        note: str = "",
    ) -> Callable[[Callable[..., float]], Callable[..., float]]:
        """Declares the decorated function as the case of its name."""

        def declare(run: Callable[..., float]) -> Callable[..., float]:
            name = run.__name__
            self.append(Case(name, self.name, why, measures, limit, unit, run, has_long, note))
            return run

        return declare


def largest(*values: Any) -> float:
    """Of numbers or of one iterable of them; infinite where any is NaN, which max would lose."""
    found = list(values[0]) if len(values) == 1 else values
    return math.inf if any(value != value for value in found) else max(found)


def run_case(case: Case, long: bool = False) -> Outcome:
    """Runs and judges one case; what it raises is a failure, not an end of the table."""
    started = time.perf_counter()
    problem = ""
    try:
        value = float(case.run(scale=10) if long and case.has_long else case.run()) + 0.0  # no -0
    except Exception as error:  # a case may break in any way; the table goes on
        value = math.nan
        problem = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
    passed = math.isfinite(value) and value <= case.limit
    return Outcome(case, value, passed, time.perf_counter() - started, problem)
