# SPDX-License-Identifier: Apache-2.0
"""Nothing passes through anything: a slice of the full set, its judges, its summary."""

import json
from pathlib import Path

import numpy as np
import pytest

from carom import Scene, Simulation
from carom.studies import tunnel_picture, tunnel_truth
from carom.studies.tunnel_bodies import KINDS, make
from carom.studies.tunnel_judge import CavityJudge, PairJudge, WallJudge, rotation
from carom.studies.tunnel_scenes import AXES, make_run, sheet

SLICE, SEED = 150, 20261126


class Puppets:
    """Poses and velocities of bodies as a test sets them, in place of a simulation."""

    def __init__(self, *bodies):
        self.states = [np.array(b, float) for b in bodies]  # x y z, then velocity

    def poses(self):
        return np.array([[*s[:3], 0, 0, 0, 1] for s in self.states])

    def twists(self):
        return np.array([[*s[3:], 0, 0, 0] for s in self.states])


def ball(radius=0.1):
    mover = make("sphere", np.random.default_rng(0), radius)
    assert mover.outer == pytest.approx(radius)
    return mover


WALL = [0, 0, 0, 0, 0, 0]


@pytest.mark.parametrize(
    ("state", "crossed"),
    [
        ([0, 0, 0.2, 0, 0, -1], False),  # in front
        ([0, 0, 0.0995, 0, 0, 0], False),  # half a millimetre in
        ([0, 0, 0.09, 0, 0, 0], True),  # a centimetre through a sheet
        ([0, 0, -5, 0, 0, -100], True),  # straight through
        ([20, 0, -5, 200, 0, -50], True),  # slanted: through at x = 0
        ([20, 0, -5, 200, 0, -100], False),  # level with the sheet at x = 10: round its rim
        ([0, 0, -5, 0, 0, 0], True),  # behind it without a velocity: how else
    ],
)
def test_the_wall_judge_tells_through_from_round(state, crossed):
    judge = WallJudge(0, 1, ball(), 3.0, 0.0)
    assert judge.crossed(Puppets(WALL, state), 1.0) is crossed


def test_the_wall_judge_lets_a_body_into_a_thick_wall_but_not_out_behind():
    judge = WallJudge(0, 1, ball(), 3.0, 0.1)
    assert not judge.crossed(Puppets(WALL, [0, 0, 0.06, 0, 0, 0]), 1.0)
    assert judge.deepest == pytest.approx(0.09)
    assert judge.crossed(Puppets(WALL, [0, 0, 0.04, 0, 0, 0]), 1.0)


@pytest.mark.parametrize(
    ("place", "crossed"),
    [([0, 0, 0], False), ([0.95, 0, 0], True), ([0.9, 0.9, -0.9], False), ([0, -1.5, 0], True)],
)
def test_the_cup_judge_holds_centre_and_surface(place, crossed):
    judge = CavityJudge(None, [(0, ball())], AXES, [1.0] * 6, 0.0)
    assert judge.crossed(Puppets([*place, 0, 0, 0]), 1.0) is crossed


def test_what_leaves_by_the_mouth_has_not_crossed():
    judge = CavityJudge(None, [(0, ball())], AXES, [1.0] * 6, 0.0, mouth=4)
    assert AXES[4].tolist() == [0, 0, 1]
    assert not judge.crossed(Puppets([0, 0, 0.95, 0, 0, 1]), 1.0)
    assert not judge.crossed(Puppets([5, 0, 9, 0, 0, 1]), 1.0)


@pytest.mark.parametrize(
    ("a", "b", "crossed"),
    [
        ([-1, 0, 0, 1, 0, 0], [1, 0, 0, -1, 0, 0], False),  # on their way
        ([5, 0, 0, 9, 0, 0], [-5, 0, 0, -9, 0, 0], True),  # through each other
        ([5, 0, 0, 9, -9, 0], [-5, 8, 0, -9, 9, 0], False),  # beside each other after a hit
        ([5, 0, 0, 9, 0, 0], [-5, 0.19, 0, -9, 0, 0], True),  # 0.19 m aside: less than both radii
    ],
)
def test_the_pair_judge_tells_through_from_beside(a, b, crossed):
    judge = PairJudge(0, 1, [ball(), ball()], [1, 0, 0])
    assert judge.crossed(Puppets(a, b), 10.0) is crossed


@pytest.mark.parametrize("kind", KINDS)
def test_bodies_are_as_large_as_they_say(kind):
    """By the library's distances: the ball of `inner` is inside, no surface point is outside."""
    rng = np.random.default_rng(3)
    for _ in range(5):
        mover = make(kind, rng, 0.2)
        scene = Scene()
        scene.add(mover.shape, static=kind != "particles", mass=1)
        distance, _, _ = Simulation(scene).closest(
            np.concatenate([mover.surface, [[0, 0, 0]]]), 10.0
        )
        assert distance[-1] <= -mover.inner * (1 - 1e-6)
        # a point of a box's or particle's own grid may lie inside; none may lie outside
        assert distance[:-1].max() <= 1e-6
        assert np.linalg.norm(mover.surface, axis=1).max() == pytest.approx(mover.outer)


def test_the_picture_shows_what_it_says():
    assert len(tunnel_picture.passed(tunnel_picture.run("never"))) == 7
    assert tunnel_picture.passed(tunnel_picture.run("auto")) == []


def test_runs_are_the_same_for_the_same_seed():
    for index in range(20):
        a, b = make_run(1, index), make_run(1, index)
        assert (a.family, a.kinds, a.dt, a.steps) == (b.family, b.kinds, b.dt, b.steps)
        assert Simulation(a.scene).state_hash() == Simulation(b.scene).state_hash()


def test_a_sheet_is_flat_and_covers_its_square():
    mesh = sheet(3.0, 5)
    corners = np.array(mesh.vertices)[np.array(mesh.faces)]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(36)
    assert rotation(np.array([0, 0, 0, 1.0])).tolist() == np.eye(3).tolist()


def test_with_continuous_collision_off_they_tunnel():
    rows, _ = tunnel_truth.run_all(SLICE, SEED, "never")
    assert rows["total"]["crossed"] >= tunnel_truth.CONTROL_SHARE * SLICE


def test_what_is_hit_again_after_it_passed_is_looked_at_twice():
    """Run 1356: an ellipsoid glances off a dumb-bell, is level with it 32 mm beside its centre,
    where 24 mm are needed, and hits it again in the same step. Through is through all the same."""
    counts = tunnel_truth.fly(make_run(SEED, 1356))
    assert (counts["crossed"], counts["seen_twice"]) == (0, 1)
    pairs = [i for i in range(SLICE) if make_run(SEED, i).family == "pair"]
    flown = [tunnel_truth.fly(make_run(SEED, i, "never")) for i in pairs]
    assert sum(counts["crossed"] for counts in flown) >= 5
    assert sum(counts["seen_twice"] for counts in flown) == 0


@pytest.mark.parametrize(
    ("seed", "index"),
    [
        (SEED, 293),  # a slow turn brought a corner down that the contacts did not know
        (SEED, 524),  # the rest of a way was dropped once another part had a hit
        (SEED, 1872),  # an end of a capsule in a corner was held by one face of it
        (SEED, 3197),
        (SEED, 5255),  # a hit within the step threw it through a thin wall it rested on
        (SEED, 5475),  # behind a crease one contact let a hull slide through either face
        (SEED, 8656),  # a rim rolled 1.3 mm into a sheet within one step
        (7, 2130),  # past a crease the plane of the next face was not seen
        (7, 8046),
    ],
)
def test_what_crossed_once_does_not_again(seed, index):
    counts = tunnel_truth.fly(make_run(seed, index))
    assert counts["crossed"] == counts["not_finite"] == 0


def test_with_it_nothing_passes_through_anything():
    rows, bad = tunnel_truth.run_all(SLICE, SEED, "auto")
    assert bad == [], f"seed {SEED}"
    assert rows["total"]["runs"] == SLICE
    assert rows["total"]["frozen"] == 0


def test_the_committed_summary_is_of_the_full_set():
    summary = json.loads((Path(__file__).parent / "tunnel_truth.json").read_text())
    assert summary["total"]["runs"] >= 10_000
    assert summary["total"]["crossed"] == summary["total"]["not_finite"] == 0
    assert summary["bad_runs"] == []
    assert summary["control"]["tunnelled_share"] >= tunnel_truth.CONTROL_SHARE
    families = {"wall", "sheet", "cup", "funnel", "pair", "shaken_cup"}
    assert families == {n.removeprefix("family/") for n in summary["rows"] if "family/" in n}
    assert set(KINDS) == {n.removeprefix("kind/") for n in summary["rows"] if "kind/" in n}
