# SPDX-License-Identifier: Apache-2.0
"""Contact: what small steps, their number and the direct solver cost, and what they hold.

The truth is a scene that stands: every box of a tower, and the top of the pyramid, belongs where it
was put. `error` is how far the worst box strays from there, m; a tower that fell says so by it.
"""

import time
from collections.abc import Callable

import numpy as np

import carom

Row = dict[str, object]

DT = 1 / 60
SECONDS = 3.0
SETTINGS: tuple[tuple[str, dict[str, object]], ...] = (
    *(
        (f"small_steps_{n}", {"contact_solver": "small_steps", "substeps": n})
        for n in (4, 8, 16, 32)
    ),
    ("direct", {"contact_solver": "direct"}),
    ("automatic", {}),
)
DIRECT_TOO = ("stack_20", "ten_under_1000", "ten_under_1e6")


def _ground() -> carom.Scene:
    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -9.81]))
    scene.add(carom.Plane([0, 0, 1], 0), name="ground", static=True)
    return scene


def _tower(count: int, top_density: float) -> carom.Scene:
    scene = _ground()
    for i in range(count):
        density = top_density if i == count - 1 else 1000.0
        scene.add(carom.Box([0.5, 0.5, 0.5]), position=[0, 0, 0.25 + 0.5 * i], density=density)
    return scene


def _pyramid(layers: int) -> carom.Scene:
    """Boxes of 1 m at 1.02 m, as the peers' driver places them."""
    scene = _ground()
    for layer in range(layers):
        for i in range(layers - layer):
            x = 1.02 * (i - 0.5 * (layers - layer - 1))
            scene.add(carom.Box([1, 1, 1]), position=[x, 0, 0.5 + layer])
    return scene


CASES: dict[str, Callable[[], carom.Scene]] = {
    "stack_20": lambda: _tower(20, 1e3),
    "ten_under_1000": lambda: _tower(10, 1e6),
    "ten_under_1e6": lambda: _tower(10, 1e9),
    "pyramid_10": lambda: _pyramid(10),
}


def _measure(case: str, method: str, settings: dict[str, object]) -> Row:
    simulation = carom.Simulation(CASES[case](), dt=DT, **settings)
    start = np.array(simulation.centres())
    before = simulation.energy()
    clock = time.perf_counter()
    report = simulation.advance(SECONDS)
    seconds = time.perf_counter() - clock
    after = simulation.energy()
    contact = report.contact
    gain = (after.kinetic + after.potential) - (before.kinetic + before.potential)
    return {
        "study": "contact",
        "case": case,
        "method": method,
        "steps": report.steps,
        "error": float(np.linalg.norm(simulation.centres() - start, axis=1).max()),
        "error_unit": "m",
        "seconds": seconds / report.steps,
        "residual_m_s": contact.residual,
        "deepest_overlap_m": contact.deepest_overlap,
        "energy_gain_j": gain,
        "iterations_per_step": contact.iterations / report.steps,
        "gave_up": contact.gave_up,
    }


def run(progress: Callable[[int, int], None] | None = None) -> list[Row]:
    """Measures every case and setting for three simulated seconds; ten seconds of work or so.

    progress: called with (rows done, rows in all) after each row. `seconds` are per step.
    """
    plan = [
        (case, method, settings)
        for case in CASES
        for method, settings in SETTINGS
        if method != "direct" or case in DIRECT_TOO  # a wall of boxes is not what it is for
    ]
    rows = []
    for done, (case, method, settings) in enumerate(plan, 1):
        rows.append(_measure(case, method, settings))
        if progress:
            progress(done, len(plan))
    return rows
