# SPDX-License-Identifier: Apache-2.0
"""What `report` and `carom run --json` say of contacts, recomputed from `contacts()`."""

import json

import numpy as np
import pytest

import carom
from carom.cli import main


def tower(height):
    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -9.81]))
    scene.add(carom.Plane([0, 0, 1], 0), static=True)
    for i in range(height):
        scene.add(carom.Box([0.5, 0.5, 0.5]), position=[0, 0, 0.25 + 0.5 * i])
    scene.add(carom.Box([0.5, 0.5, 0.5]), position=[3, 0, 0.25])
    return scene


@pytest.mark.parametrize("solver", ["direct", "small_steps"])
def test_points_overlap_and_load_are_those_of_the_contacts(solver):
    simulation = carom.Simulation(tower(4), contact_solver=solver)
    simulation.advance(2)
    report = simulation.advance(1 / 60)  # one step: its extremes are of this step
    contacts = simulation.contacts()
    assert report.contact.points == len(contacts) == 20
    assert report.contact.deepest_overlap == max(0.0, float(-contacts["separation"].min()))
    assert report.contact.islands == 2
    assert report.contact.direct_islands == (2 if solver == "direct" else 0)
    assert report.contact.gave_up == 0
    # What the ground bears: five boxes of 125 kg over a step. 1e-4: two seconds leave small steps
    # that much of their way to rest, the direct solver 1e-7 m/s.
    on_ground = contacts["impulse"][contacts["a"] == 0].sum(axis=0)
    assert on_ground[2] == pytest.approx(5 * 125 * 9.81 / 60, rel=1e-4)
    assert np.abs(on_ground[:2]).max() < 1e-3 * on_ground[2]


def test_run_prints_the_same_as_json(capsys):
    assert main(["run", "tower", "--seconds", "0.5", "--json"]) in (0, 1)
    contact = json.loads(capsys.readouterr().out)["contact"]
    assert set(contact) >= {
        "points", "deepest_overlap_m", "residual_m_per_s", "iterations", "gave_up", "islands",
        "direct_islands", "asleep",
    }  # fmt: skip
    assert contact["points"] > 0
    assert contact["islands"] >= 1
    assert 0 <= contact["direct_islands"] <= contact["islands"]
