# SPDX-License-Identifier: Apache-2.0
"""The groups of hard cases, in the order the table shows them."""

from __future__ import annotations

import importlib
from functools import cache

from carom.stress.case import Case

GROUPS: dict[str, tuple[str, tuple[str, ...]]] = {
    "rotation": (
        "free spin at its unstable, fast, thin and degenerate ends",
        ("rotation_drift", "rotation_fast", "rotation_exact"),
    ),
    "inertia": (
        "points, needles, plates, cavities, broken meshes",
        ("inertia_shapes", "inertia_meshes"),
    ),
    "time": ("steps, clocks and stiff forces", ("time_steps", "time_stiff")),
    "ccd": (
        "grazing, coplanar, scaled and spinning contacts in time",
        ("ccd_roots", "ccd_queries", "ccd_sweeps", "ccd_bodies", "broad_trees"),
    ),
    "contact": (
        "stacks, mass ratios, slopes, wedges, bounces",
        (
            "contact_towers",
            "contact_walls",
            "contact_slopes",
            "contact_slip",
            "contact_bounce",
            "contact_benchmarks",
            "contact_odd",
        ),
    ),
    "roundoff": (
        "far from the origin, denormal, signed zero, repeated bits",
        ("roundoff_sizes", "roundoff_bits"),
    ),
    "input": (
        "what cannot be used is refused and changes nothing",
        ("input_refused", "input_materials", "input_odd"),
    ),
}
"""Name of each group: what it is about, and its modules in this package."""


@cache
def cases_of(group: str) -> tuple[Case, ...]:
    """The cases of a group, in the order they are written."""
    modules = [importlib.import_module(f"carom.stress.{name}") for name in GROUPS[group][1]]
    return tuple(case for module in modules for case in module.cases)
