# SPDX-License-Identifier: Apache-2.0
"""What accuracy costs: each study measures error against time for one choice of methods.

A study is a module of its name with `run(progress=None) -> list of rows`; a row is a dict with the
keys study, case, method, steps (or samples, or queries), error, error_unit and seconds. References
are independent: closed forms or exact arithmetic, never a finer run of the same code. One that
draws more than lines per method has `plot(rows, path)`. `carom cost --study NAME` runs it; what
studies share is in carom.studies.common.
"""

STUDIES: dict[str, str] = {
    "rotation": "free rotation: angle and energy error against time, every integrator",
    "inertia": "mass properties by sampling, grid and mesh sums against closed forms",
    "trees": "ray and overlap queries: trees and grid, cell and leaf sizes",
    "contact": "towers and a pyramid: small steps and direct solves, error against time",
    "pairs": "every pair of shapes: depth against a reference, symmetry, continuity, time",
    "ccd": "continuous collision: wrong answers and time of every method",
}
"""Name of each study's module and what it shows."""
