# SPDX-License-Identifier: Apache-2.0
"""Trees of every volume and the grid agree with a loop over all faces on meshes from real files.

The files come with the PyPI package example-robot-data, which only the tests use: collision meshes
of the Panda arm, folder robots/panda_description, from franka_ros, Copyright Franka Emika GmbH,
licence Apache-2.0.
"""

import importlib.metadata

import numpy as np
import pytest

import carom
from carom import broad

SQUARE = (
    np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]),
    np.array([[0, 1, 2], [0, 2, 3]]),
)


def _files():
    try:
        files = importlib.metadata.files("example-robot-data") or []
    except importlib.metadata.PackageNotFoundError:
        return []
    wanted = ("collision/hand.stl", "collision/link0.stl", "collision/link5.stl")
    return sorted(str(f.locate()) for f in files if str(f).endswith(wanted) and "panda" in str(f))


@pytest.fixture(scope="module", params=range(3))
def mesh(request):
    trimesh = pytest.importorskip("trimesh", reason="reading mesh files needs carom[mesh]")
    files = _files()
    if request.param >= len(files):
        pytest.skip("the robot's meshes need example-robot-data: pip install 'carom[test]'")
    loaded = trimesh.load(files[request.param], force="mesh")
    return np.asarray(loaded.vertices, float), np.asarray(loaded.faces)


def _all_answers(index, vertices):
    rng = np.random.default_rng(20261122)
    low, high = vertices.min(0), vertices.max(0)
    size = high - low
    starts = low - 0.2 * size + 1.4 * size * rng.random((150, 3))
    ends = np.where(rng.random((150, 1)) < 0.5, vertices[rng.integers(len(vertices), size=150)], 0)
    ends = np.where(ends == 0, low + size * rng.random((150, 3)), ends)
    corner = low + size * rng.random((60, 3))
    return [
        *index.raycast(starts, ends - starts),
        *index.raycast(starts, ends - starts, max_distance=0.5 * np.linalg.norm(size)),
        index.any_hit(starts, ends - starts),
        *index.segments(starts, ends),
        index.blocked(starts, ends),
        *index.overlaps(corner, corner + 0.1 * size),
        *index.closest(starts),
        index.self_pairs(),
    ]


@pytest.mark.parametrize(
    "method", ["box low", "box medium", "box high", "sphere medium", "oriented_box medium", "grid"]
)
def test_every_index_gives_the_answers_of_all_faces(mesh, method):
    truth = _all_answers(broad.AllFaces(*mesh), mesh[0])
    if method == "grid":
        index = carom.HashGrid(*mesh)
    else:
        volume, quality = method.split()
        index = carom.Bvh(*mesh, volume=volume, quality=quality)
    assert (truth[1] >= 0).any(), "some rays must hit for the comparison to mean anything"
    for ours, theirs in zip(_all_answers(index, mesh[0]), truth, strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_refit_follows_a_turned_mesh(mesh):
    vertices, faces = mesh
    index = carom.Bvh(vertices, faces)
    turned = vertices[:, [1, 2, 0]] * [1, 1, -2] + [3, 0, 0]
    index.refit(turned)
    truth = broad.AllFaces(turned, faces)
    for ours, theirs in zip(_all_answers(index, turned), _all_answers(truth, turned), strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_answers_have_the_shapes_and_units_of_the_contract():
    tree = carom.Bvh(*SQUARE)
    distance, face = tree.raycast([[0.7, 0.2, 3], [5, 5, 5]], [[0, 0, -2], [0, 0, 1]])
    assert distance.tolist() == [3, np.inf]
    assert face.tolist() == [0, -1]
    assert tree.any_hit([[0.7, 0.2, 3]], [[0, 0, -1]], max_distance=2.5).tolist() == [False]
    fraction, face = tree.segments([[0.7, 0.2, 3], [5, 5, 5]], [[0.7, 0.2, -1], [5, 5, 4]])
    assert fraction.tolist() == [0.75, 1]
    assert face.tolist() == [0, -1]
    offsets, faces = tree.overlaps([[-1, -1, -1], [4, 4, 4]], [[2, 2, 2], [5, 5, 5]])
    assert offsets.tolist() == [0, 2, 2]
    assert faces.tolist() == [0, 1]
    distance, face, point = tree.closest([[0.25, 0.5, -2]])
    assert distance == pytest.approx([2])
    assert face.tolist() == [1]
    np.testing.assert_allclose(point, [[0.25, 0.5, 0]], atol=1e-16)
    assert tree.self_pairs().tolist() == [[0, 1]]
    assert tree.face_count == 2
    assert tree.memory_bytes > 0


def test_a_mesh_without_faces_finds_nothing():
    for index in (carom.Bvh, carom.HashGrid, broad.AllFaces):
        nothing = index(np.zeros((0, 3)), np.zeros((0, 3), int))
        assert nothing.raycast([[0, 0, 0]], [[1, 0, 0]])[1].tolist() == [-1]
        assert nothing.self_pairs().shape == (0, 2)


@pytest.mark.parametrize(
    ("call", "names"),
    [
        (lambda: carom.Bvh(SQUARE[0], SQUARE[1] + 2), "faces"),
        (lambda: carom.Bvh(SQUARE[0] * np.nan, SQUARE[1]), "vertices"),
        (lambda: carom.Bvh(*SQUARE, volume="ball"), "volume"),
        (lambda: carom.Bvh(*SQUARE, quality="best"), "quality"),
        (lambda: carom.Bvh(SQUARE[0], SQUARE[1] * 1.0), "faces"),
        (lambda: carom.Bvh(SQUARE[0], SQUARE[1] + 2**40), "faces"),
        (lambda: carom.HashGrid(*SQUARE, cell_size=-1), "cell_size"),
        (lambda: carom.Bvh(*SQUARE).raycast([[0, 0, 0]], [[0, 0, 0]]), "directions"),
        (lambda: carom.Bvh(*SQUARE).closest([0, 0, 0]), "points"),
        (lambda: carom.Bvh(*SQUARE).refit(SQUARE[0][:3]), "vertices"),
        (lambda: broad.BoxTree().update([[0, 0, 0]], [[0, np.nan, 0]]), "boxes"),
        (lambda: broad.BoxTree().update([[0, 0, 0]], [[1, 1, 1]], [True, False]), "moves"),
    ],
)
def test_bad_input_is_refused_by_name(call, names):
    with pytest.raises(ValueError, match=names):
        call()


def test_box_tree_pairs_are_those_of_all_pairs_and_statics_rest():
    rng = np.random.default_rng(7)
    centre, half = rng.random((200, 3)) * 8, 0.2 + 0.5 * rng.random((200, 3))
    moves = rng.random(200) < 0.7
    low, high = centre - half, centre + half
    low[0], high[0] = -np.inf, [np.inf, np.inf, 1]
    tree = broad.BoxTree()
    for _ in range(15):
        pairs = tree.update(low, high, moves)
        meet = ((low[:, None] <= high) & (low <= high[:, None])).all(-1)
        meet &= moves[:, None] | moves
        expected = np.argwhere(np.triu(meet, 1))
        np.testing.assert_array_equal(pairs, expected)
        step = rng.normal(0, 0.03, (200, 3)) * moves[:, None]
        low, high = low + step, high + step
    assert len(tree) == 200
    tree.update(low, high, moves)
    inside = np.flatnonzero(((low <= 3) & (high >= 2)).all(1))
    np.testing.assert_array_equal(tree.overlaps([2, 2, 2], [3, 3, 3]), inside)
    assert 0 in tree.crossed([0, 0, 5], [0, 0, 0])


def test_the_study_counts_the_build_where_it_names_the_winner():
    from carom.studies import trees

    def row(method, build, rate, cell=None):
        return {
            "case": "even",
            "query": "short",
            "method": method,
            "cell_size": cell,
            "build_s": build,
            "queries_per_s": rate,
        }

    rows = [row("bvh box low", 2.0, 1e3), row("grid automatic", 1.0, 500.0, 0.1)]
    rows += [{**r, "query": q} for r in rows for q in trees.QUERIES[1:]]
    # Grid: 1 s + n / 500; tree: 2 s + n / 1000: equal at n = 1000, which is not sooner.
    wins = trees.grid_wins(rows)[0]
    assert not wins["grid_wins"]
    assert wins["ratio"] == 0.5
    assert wins["sooner_up_to"] == 100


def test_the_study_shows_every_method_right_and_the_trade_off(tmp_path):
    from carom.studies import trees

    lines = []
    rows = trees.run(lines.append, faces=600, count=60)
    assert len(lines) == len({(r["case"], r["method"]) for r in rows})
    assert all(r["wrong"] == 0 for r in rows)
    grid = [r for r in rows if r["case"] == "even" and r["query"] == "long" and r["cell_size"]]
    # Smaller cells list a face more often: memory falls as cells grow.
    memory = [r["memory_bytes"] for r in grid]
    assert memory[0] > memory[2] > memory[-1]
    assert {w["case"] for w in trees.grid_wins(rows)} == set(trees.CASES)
    assert "rays walk spheres and oriented boxes one by one" in trees.as_text(rows)
    pytest.importorskip("matplotlib")
    trees.plot(rows, tmp_path / "trees.png")
    assert (tmp_path / "trees.png").stat().st_size > 10000
