# SPDX-License-Identifier: Apache-2.0
"""The shipped scene with one of each shape on hills from a real map."""

import json
import subprocess
import sys

import numpy as np
import pytest

import carom
from carom.scenes import scene_path

pytest.importorskip("trimesh", reason="reading mesh files needs carom[mesh]")


def test_one_of_each_shape_lands_on_the_hills_and_none_sinks_in():
    done = subprocess.run(
        [sys.executable, "-m", "carom", "run", "landing", "--seconds", "2", "--json"],
        capture_output=True,
        text=True,
        check=True,
    )
    result = json.loads(done.stdout)
    scene = carom.Scene.load(scene_path("landing"))
    kinds = {type(body.shape).__name__ for body in scene.bodies}
    assert len(kinds) == 13
    assert result["frozen"] == []
    terrain = scene.bodies[0].shape
    moving = [(b, r) for b, r in zip(scene.bodies, result["bodies"], strict=True) if not b.static]
    assert len(moving) == 11
    positions = np.array([r["position_m"] for _, r in moving])
    # Asked of the hills themselves: the middle of each body is outside, none has passed through.
    distance, *_ = carom.closest_points(
        terrain, carom.Sphere(1e-6), np.zeros_like(positions), positions
    )
    # The knot's and the grid's middle may lie in a bend of theirs, near the ground, not below it.
    assert (distance > 0.02).all()
    # They have landed: a metre of fall takes 0.45 s, and what still moves rolls down a hill.
    assert positions[:, 2].max() < 0.9
    # Deepest overlap in all steps: none is missed until it is deeper than contacts look ahead.
    assert result["contact"]["deepest_overlap_m"] < 0.02
    assert result["sweep"]["gave_up"] == 0


def test_all_come_to_rest():
    # The cylinder rocks in a hollow for 5 s, the ball rolls over the plane below for 6 s. A contact
    # that comes and goes, under a tip or beside a support, would rock its body for ever.
    simulation = carom.Simulation(carom.Scene.load(scene_path("landing")), dt=1 / 60)
    simulation.advance(10)
    assert np.linalg.norm(simulation.twists()[:, :3], axis=1).max() < 1e-3
