# SPDX-License-Identifier: Apache-2.0
"""Questions to whole scenes, N at a time, against closed forms and against one at a time."""

import numpy as np
import pytest

import carom

# Casts end within 1e-10 of the surface (tolerance::cast_gap); coordinates here are a few metres.
CLOSE = 1e-9


@pytest.fixture(scope="module")
def simulation():
    scene = carom.Scene()
    scene.add(carom.Plane([0, 0, 1], 0), name="ground", static=True)
    scene.add(carom.Sphere(0.5), name="ball", position=[0, 0, 2], groups=2)
    scene.add(carom.Box([1, 1, 1]), name="box", position=[3, 0, 2], groups=4)
    return carom.Simulation(scene)


def test_rays_and_segments_give_a_row_for_each_row(simulation):
    origins = [[0.3, 0, 5], [3.2, 0, 5], [9, 0, 5], [9, 0, 5]]
    distance, row, normal = simulation.raycast(origins, [[0, 0, -2]] * 3 + [[0, 0, 1]])
    assert row.tolist() == [1, 2, 0, -1]
    assert distance[:3] == pytest.approx([5 - 2 - 0.4, 2.5, 5.0], abs=CLOSE)
    assert distance[3] == np.inf
    assert normal[:2] == pytest.approx(np.array([[0.6, 0, 0.8], [0, 0, 1]]), abs=CLOSE)
    fraction, row, _ = simulation.segments(origins[:3], [[0.3, 0, 0], [3.2, 0, 2.6], [9, 0, -5]])
    assert row.tolist() == [1, -1, 0]
    assert fraction[[0, 2]] == pytest.approx([2.6 / 5, 0.5], abs=CLOSE)
    assert simulation.raycast([0.3, 0, 5], [0, 0, -1])[1].tolist() == [1]  # (3,) is one of them
    assert simulation.raycast(np.zeros((0, 3)), np.zeros((0, 3)))[0].shape == (0,)


def test_groups_choose_whom_to_ask(simulation):
    down = [[0.3, 0, 5], [3.2, 0, 5]], [[0, 0, -1]] * 2
    assert simulation.raycast(*down, groups=4)[1].tolist() == [-1, 2]
    assert simulation.raycast(*down, groups=1)[1].tolist() == [0, 0]
    with pytest.raises(carom.InvalidInput, match="groups: -1, must be 32 bits"):
        simulation.raycast(*down, groups=-1)


def test_shape_casts_take_a_pose_each(simulation):
    quarter = [0, np.sqrt(0.5), 0, np.sqrt(0.5)]  # a capsule of 0.2 m + caps, upright or lying
    distance, row, normal = simulation.shape_cast(
        carom.Capsule(0.1, 0.2),
        [[3, 0, 5], [3, 0, 5]],
        [[0, 0, -1]] * 2,
        [[0, 0, 0, 1], quarter],
    )
    assert row.tolist() == [2, 2]
    assert distance == pytest.approx([5 - 2.5 - 0.2, 5 - 2.5 - 0.1], abs=CLOSE)
    assert (distance <= [2.3 + 1e-12, 2.4 + 1e-12]).all()  # never beyond the first contact
    assert normal[:, 2] == pytest.approx([1, 1])


def test_overlaps_are_lists_one_after_the_other(simulation):
    offsets, rows = simulation.overlaps(
        carom.Box([4, 0.1, 0.1]), [[1.5, 0, 2], [9, 0, 9], [0, 0, 0]]
    )
    assert offsets.tolist() == [0, 2, 2, 3]
    assert rows.tolist() == [1, 2, 0]


def test_closest_bodies_to_points_and_to_shapes(simulation):
    distance, row, point = simulation.closest([[0, 0, 2.9], [3, 0, 2.1], [8, 0, 1]])
    assert row.tolist() == [1, 2, 0]
    assert distance == pytest.approx([0.4, -0.4, 1.0], abs=CLOSE)
    assert point[0] == pytest.approx([0, 0, 2.5], abs=CLOSE)
    assert simulation.closest([[0, 0, 9]], reach=1)[1].tolist() == [-1]
    distance, row, on_body, on_shape = simulation.closest_to_shape(
        carom.Sphere(0.25), [[0, 2, 2], [0, 0, 2.6]]
    )
    assert row.tolist() == [1, 1]
    assert distance == pytest.approx([1.25, -0.15], abs=CLOSE)
    assert on_body[0] == pytest.approx([0, 0.5, 2], abs=CLOSE)
    assert on_shape[0] == pytest.approx([0, 1.75, 2], abs=CLOSE)


def test_the_contact_list_names_query_row_and_manifold(simulation):
    found = simulation.contacts_of(carom.Box([1, 1, 1]), [[9, 0, 9], [3, 0, 2.99]], margin=0.02)
    assert found["query"].tolist() == [1, 1, 1, 1]
    assert found["row"].tolist() == [2, 2, 2, 2]
    assert found["normal"] == pytest.approx(np.tile([0, 0, 1.0], (4, 1)), abs=CLOSE)
    assert found["separation"] == pytest.approx(np.full(4, -0.01), abs=CLOSE)
    assert len(set(found["feature"].tolist())) == 4


def test_two_shapes_collide_at_many_poses_as_one_by_one():
    random = np.random.default_rng(2)
    a, b = carom.Cylinder(0.3, 0.8), carom.Box([0.4, 0.6, 0.8])
    at_a, at_b = random.uniform(-0.3, 0.3, (2, 50, 3))
    turn = random.normal(size=(50, 4))
    turn /= np.linalg.norm(turn, axis=1, keepdims=True)
    together = carom.collide(a, b, at_a, at_b, turn, margin=0.02)
    for i in range(50):
        alone = carom.collide(a, b, at_a[i], at_b[i], turn[i], margin=0.02)
        mine = together[together["query"] == i]
        np.testing.assert_array_equal(alone["separation"], mine["separation"])
        np.testing.assert_array_equal(alone["position"], mine["position"])
    assert len(np.unique(together["query"])) > 25


@pytest.mark.parametrize(
    ("ask", "field"),
    [
        (lambda s: s.raycast([[0, 0, 0]], [[0, 0, 0]]), "direction"),
        (lambda s: s.raycast([[0, 0, 0]], [[0, 0, 1]] * 2), "directions: 2 rows"),
        (lambda s: s.segments([[0, 0, np.nan]], [[0, 0, 1]]), "start"),
        (lambda s: s.overlaps(carom.Sphere(1), [[0, 0, 0]] * 2, [[0, 0, 0, 1]]), "orientations"),
        (lambda s: s.overlaps(carom.Sphere(1), [[0, 0, 0]], [0, 0, 0, 0]), "orientations"),
        (lambda s: s.closest([[0, 0, 0]], reach=-1), "reach"),
        (lambda s: s.contacts_of(carom.Sphere(1), [[0, 0, 0]], margin=-1), "margin"),
        (lambda s: s.closest([[0, 0]]), "points"),
    ],
)
def test_nonsense_is_refused_by_name(simulation, ask, field):
    with pytest.raises(carom.InvalidInput, match=field):
        ask(simulation)
