# SPDX-License-Identifier: Apache-2.0
"""Our quickhull against qhull (through scipy), degenerate input above all."""

import numpy as np
import pytest

import carom

spatial = pytest.importorskip("scipy.spatial", reason="the second opinion is scipy's qhull")


def _clouds() -> dict[str, np.ndarray]:
    random = np.random.default_rng(11)
    cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    lattice = np.stack(np.meshgrid(*[np.arange(5.0)] * 3), -1).reshape(-1, 3)
    ball = random.normal(size=(300, 3))
    ball /= np.linalg.norm(ball, axis=1, keepdims=True)
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    ring = np.c_[np.cos(angle), np.sin(angle)]
    return {
        "random": random.uniform(-1, 1, (200, 3)),
        "ball": ball,
        "cube": cube,
        "cube_with_edge_and_face_points": np.vstack(
            [cube, 0.5 * (cube[:4] + cube[1:5]), [[0.5, 0.5, 1]]]
        ),
        "lattice": lattice,  # 27 points on every face, all coplanar
        "duplicates": np.repeat(cube, 20, axis=0),
        "near_duplicates": np.repeat(cube, 20, axis=0) + 1e-14 * random.normal(size=(160, 3)),
        "prism_of_60": np.vstack([np.c_[ring, np.zeros(60)], np.c_[ring, np.ones(60)]]),
        "tetrahedron": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]]),
        "needle": random.uniform(-1, 1, (100, 3)) * [1, 1e-3, 1e-3],
        "plate": random.uniform(-1, 1, (100, 3)) * [1, 1, 1e-5],
        "far": 1e6 * np.array([1, -1, 1]) + random.uniform(-1, 1, (100, 3)),
        "small": 1e-6 * random.uniform(-1, 1, (100, 3)),
        "large": 1e6 * random.uniform(-1, 1, (100, 3)),
        "gaussian": random.normal(size=(2000, 3)),
    }


CLOUDS = _clouds()


@pytest.mark.parametrize("name", CLOUDS)
def test_the_hull_is_qhulls(name):
    points = CLOUDS[name]
    ours = carom.ConvexHull(points)
    middle = points.mean(axis=0)
    theirs = spatial.ConvexHull(points - middle)
    vertices, faces = np.array(ours.vertices) - middle, np.array(ours.faces)
    corners = vertices[faces]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    size = np.ptp(points, axis=0).max()
    # Points within 1e-10 of the size of a face count as on it (tolerance::hull_plane), and far from
    # the origin the coordinates themselves are rounded: 1e6 * 2^-53.
    reach = 1e-10 * size + 4 * np.abs(points).max() * 2.0**-53
    assert volume == pytest.approx(theirs.volume, abs=4 * reach * theirs.area)
    # No point lies outside, by qhull's planes and by ours.
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    heights = (points - middle) @ normals.T - np.einsum("ij,ij->i", normals, corners[:, 0])
    thin = np.sqrt(np.ptp(points, axis=0).min() / size)  # a sliver's normal is that much worse
    assert heights.max() <= 4 * reach / thin
    # Closed: each edge is run once each way, and Euler's formula holds.
    edges = {(f[i], f[(i + 1) % 3]) for f in faces.tolist() for i in range(3)}
    assert len(edges) == 3 * len(faces)
    assert all((b, a) in edges for a, b in edges)
    assert len(vertices) - len(edges) // 2 + len(faces) == 2
    # Every corner we keep is one of the points, and one that qhull keeps or that lies on its hull.
    planes = theirs.equations
    on_hull = (vertices @ planes[:, :3].T + planes[:, 3]).max(axis=1)
    assert np.abs(on_hull).max() <= 4 * reach / thin
    assert (np.linalg.norm(ours.vertices[:, None] - points[None], axis=2).min(axis=1) == 0).all()


@pytest.mark.parametrize(
    "points",
    [
        np.zeros((5, 3)),
        np.linspace(0, 1, 9)[:, None] * [[1, 2, 3]],
        np.random.default_rng(5).uniform(-1, 1, (30, 3)) * [1, 1, 0],
        np.eye(3),
        np.full((6, 3), np.nan),
    ],
    ids=["one_place", "line", "plane", "three", "nan"],
)
def test_points_that_span_no_volume_are_refused(points):
    with pytest.raises(carom.InvalidInput):
        carom.ConvexHull(points)
