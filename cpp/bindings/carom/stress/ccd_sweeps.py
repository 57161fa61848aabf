# SPDX-License-Identifier: Apache-2.0
"""Whole bodies that turn while they move: the first contact against closed forms."""

from __future__ import annotations

import math

import numpy as np

from carom import ccd
from carom.stress.case import Group, largest
from carom.stress.solids import box_mesh, grid_mesh

cases = Group("ccd")
SEPARATED, CONTACT = ccd.SweepStatus.separated, ccd.SweepStatus.contact


def _post(angle: float, radius: float) -> ccd.SweptBody:
    """A thin upright post."""
    x, y = radius * math.cos(angle), radius * math.sin(angle)
    return ccd.SweptBody([[x, y, -1.0], [x, y, 1.0]], edges=[[0, 1]])


def _rod(turn: float, inner: float = 0.0) -> ccd.SweptBody:
    """A thin rod along x that turns about z."""
    return ccd.SweptBody([[inner, 0, 0], [1.0, 0, 0]], edges=[[0, 1]], rotation=[0, 0, turn])


def _time_error(result: ccd.SweepResult, exact: float, slack: float) -> float:
    """0 where contact is found no later than it is and no earlier than by `slack`; else how far."""
    if result.status != CONTACT:
        return math.inf
    return largest(result.time - exact, exact - result.time - slack, 0.0)


@cases.case(
    "a rod at 100 rad/s sweeps past a post in 1/60 s; its ends' straight paths never meet it",
    "largest error of the time of contact at 60 posts, beyond what the 1 um gap allows",
    1e-12,
    "of the step",
)
def rod_sweeps_past_a_post(max_intervals: int = 4096) -> float:
    turn, worst = 100 / 60, 0.0
    for i in range(60):
        angle, radius = 0.02 + 1.6 * i / 59, 0.1 + 0.85 * ((7 * i) % 60) / 60
        result = ccd.sweep(_rod(turn), _post(angle, radius), max_intervals=max_intervals)
        # within 1e-6 m is a contact: that far before, by the angle whose sine is 1e-6 / radius
        early = math.asin(1e-6 / radius) / turn
        worst = largest(worst, _time_error(result, angle / turn, early + 1e-12))
    return worst


@cases.case(
    "half a turn and ten turns in one step: straight corner paths cross the centre, or nothing",
    "wrong answers on 24 posts inside and outside the swept ring",
    0,
    "answers",
)
def half_turn_and_ten_turns() -> float:
    wrong = 0
    for turn in (math.pi, 20 * math.pi):
        for i in range(6):
            angle = 0.1 + 0.5 * i
            for radius, meets in ((0.3, False), (0.49, False), (0.51, True), (0.99, True)):
                result = ccd.sweep(_rod(turn, inner=0.5), _post(angle, radius))
                if meets:
                    wrong += _time_error(result, angle / turn, 1e-5) > 1e-12
                else:
                    wrong += result.status != SEPARATED
    return wrong


@cases.case(
    "a 1 cm cube crosses a 0.1 mm plate at 1200 m per step: before and after it is far away",
    "error of the time of contact beyond what the 1 um gap allows, square on and with 8 spins",
    1e-12,
    "of the step",
)
def bullet_and_plate() -> float:
    cube, faces = box_mesh([0.01] * 3)
    plate = ccd.SweptBody(*box_mesh([1e-4, 20.0, 20.0]))
    exact, worst = (600 - 0.005 - 0.5e-4) / 1200, 0.0
    result = ccd.sweep(
        ccd.SweptBody(cube, faces, position=[-600, 0.1, 0.2], displacement=[1200, 0, 0]), plate
    )
    worst = _time_error(result, exact, 1.1e-6 / 1200)
    reach = math.sqrt(3) * 0.005
    for spin in range(1, 9):
        bullet = ccd.SweptBody(
            cube, faces, position=[-600, 0.1, 0.2], displacement=[1200, 0, 0],
            rotation=[0, 0.3 * spin, 0.2 * spin],
        )  # fmt: skip
        result = ccd.sweep(bullet, plate)
        # a corner is between half an edge and half a diagonal ahead of the centre
        first, last = (600 - reach - 0.5e-4 - 1e-6) / 1200, exact
        worst = largest(worst, first - result.time, result.time - last)
    return worst


@cases.case(
    "a sheet of no thickness has two sides and no inside: only the crossing itself can be seen",
    "of 40 spinning cubes through the sheet or beside its rim, wrong answers",
    0,
    "answers",
)
def sheet_of_no_thickness() -> float:
    rng, wrong = np.random.default_rng(45), 0
    cube, faces = box_mesh([0.02] * 3)
    sheet = ccd.SweptBody(*grid_mesh(1.0, 4))
    for i in range(40):
        through = i % 2 == 0
        # beside the rim: farther than half a diagonal, 0.0173 m
        x = rng.uniform(-0.4, 0.4) if through else 0.5 + rng.uniform(0.018, 0.1)
        moving = ccd.SweptBody(
            cube, faces, position=[x, 0.1, 0.5], displacement=[0, 0, -1.0],
            rotation=rng.uniform(-2, 2, 3),
        )  # fmt: skip
        result = ccd.sweep(moving, sheet)
        wrong += (result.status == CONTACT) != through
        wrong += through and not (0.5 - 0.01733 <= result.time <= 0.49)
    return wrong


@cases.case(
    "both move: two cubes meet head on at 2e4 m/s, each crossing the other's whole place",
    "error of the time of contact beyond what the 1 um gap allows",
    1e-12,
    "of the step",
)
def two_bodies_head_on() -> float:
    cube, faces = box_mesh([0.1] * 3)
    a = ccd.SweptBody(cube, faces, position=[-100, 0, 0], displacement=[200, 0, 0])
    b = ccd.SweptBody(cube, faces, position=[100, 0.01, 0.02], displacement=[-200, 0, 0])
    return _time_error(ccd.sweep(a, b), (200 - 0.1) / 400, 1.1e-6 / 400)


@cases.case(
    "touching at the start and moving apart: a hit at t = 0 must not hold them together for ever",
    "sweeps of 20 that do not end within their intervals, or report a time beyond the step",
    0,
    "sweeps",
)
def touching_and_leaving() -> float:
    wrong = 0
    cube, faces = box_mesh([0.1] * 3)
    still = ccd.SweptBody(cube, faces)
    for i in range(20):
        leaving = ccd.SweptBody(
            cube,
            faces,
            position=[0.1, 0, 0],
            displacement=[0.01 * i, 0, 0],
            rotation=[0.1 * i, 0, 0],
        )
        result = ccd.sweep(leaving, still)
        wrong += result.status != CONTACT or result.time != 0.0
        # a hair away (2 um, twice the gap) the same motion is free
        free = ccd.SweptBody(
            cube, faces, position=[0.1 + 2e-6, 0, 0], displacement=[0.01 * i, 0, 0],
            rotation=[0.1 * i, 0, 0],
        )  # fmt: skip
        wrong += ccd.sweep(free, still).status != SEPARATED
    return wrong
