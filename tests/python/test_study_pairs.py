# SPDX-License-Identifier: Apache-2.0
"""The table of all pairs of shapes, at few poses: each within its tolerance of its reference."""

import numpy as np
import pytest

import carom
from carom.studies import pairs, pairs_references, pairs_shapes


@pytest.fixture(scope="module")
def rows():
    return {row["case"]: row for row in pairs.run(trials=3, seed=7)}


def test_every_pair_is_there(rows):
    names = [twin.name for twin in pairs_shapes.twins()]
    assert len(names) == 13
    static = {"plane", "height_field"}  # two of them never meet
    every = {frozenset((a, b)) for a in names for b in names if not {a, b} <= static}
    assert {frozenset(case.split()) for case in rows} == every


def test_the_table_names_every_pair(rows):
    text = pairs.as_text(list(rows.values()))
    assert all(case in text for case in rows)


def test_depth_is_that_of_the_reference(rows):
    # What the pairs promise: 1e-9 m, 1e-6 m of the distance grid.
    wrong = {case: row["error"] for case, row in rows.items() if not row["error"] <= row["allowed"]}
    assert wrong == {}


def test_normals_are_those_of_the_reference(rows):
    # Of the closed forms. Slopes of a grid's splines are off by sqrt(3)/216 h^3 |d4 phi|, of a ball
    # of 0.4 m at an overlap of 0.1 m, where |d4 phi| <= 9 / 0.3^3, by 2.7e-6 along an axis.
    for case, row in rows.items():
        if row["normal"] is not None:
            assert row["normal"] <= (5e-6 if "sdf" in case else 1e-9), case


def test_the_pair_asked_the_other_way_and_carried_along_is_the_same(rows):
    # The level of a grid has bumps of the size of its error, h^4/384 |d4 phi| = 9e-9 m at most, and
    # rounding decides in which of them the search between two grids ends.
    for case, row in rows.items():
        limit = 9e-9 if case == "sdf sdf" else 1e-9
        assert row["swapped"] <= limit, case
        assert row["moved"] <= limit, case


def test_a_micrometre_changes_the_depth_by_no_more(rows):
    # The depth is a distance: it follows the motion one to one (the grid's is a cubic that may be
    # steeper by its own error over a cell).
    for case, row in rows.items():
        assert row["jump"] <= (1e-8 if "sdf" in case else 1e-9), case


def test_coal_agrees(rows):
    pytest.importorskip("coal", reason="the second opinion needs coal: pip install 'carom[test]'")
    seen = [row for row in rows.values() if row["coal_m"] is not None]
    assert len(seen) == 21  # six shapes that both have
    for row in seen:
        assert row["coal_m"] <= 1e-5, row["case"]  # coal's own tolerance is 1e-6, relative


def test_the_references_know_closed_forms():
    random = np.random.default_rng(1)
    turn = np.array([0.5, 0.5, 0.5, 0.5])
    box, ball = pairs_shapes._box([2, 4, 6]), pairs_shapes._ball(0.5)
    at = [
        pairs_references.Placed(box, np.zeros(3), turn),  # extents along x y z: 6 2 4
        pairs_references.Placed(ball, np.array([5.0, 0, 0]), turn),
    ]
    assert pairs_references.largest_gap(*at, random) == pytest.approx(1.5, abs=1e-10)
    block = next(twin for twin in pairs_shapes.twins() if twin.name == "mesh")
    assert pairs_references.signed_distance(block, np.array([-0.5, -0.5, 0.9])) == pytest.approx(
        -0.1
    )
    assert pairs_references.signed_distance(block, np.array([0.3, 0.4, 0.5])) == pytest.approx(0.3)
    assert carom.diagnose_mesh(block.shape.vertices, block.shape.faces).findings == []
