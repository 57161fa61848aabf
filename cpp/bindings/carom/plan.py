# SPDX-License-Identifier: Apache-2.0
"""Rows of `Simulation.plan()`."""

from __future__ import annotations

from typing import NamedTuple


class Stage(NamedTuple):
    """One thing a step does, why, on how many bodies, and the wall time it has taken so far, s."""

    stage: str
    reason: str
    bodies: int
    seconds: float
