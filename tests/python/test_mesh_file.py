# SPDX-License-Identifier: Apache-2.0
"""Meshes from files, among them a robot's: the hand of Franka Emika's Panda.

That file comes with the PyPI package example-robot-data, which only the tests use: folder
robots/panda_description, from franka_ros, Copyright Franka Emika GmbH, licence Apache-2.0.
"""

import importlib.metadata

import numpy as np
import pytest

import carom

trimesh = pytest.importorskip("trimesh", reason="reading mesh files needs carom[mesh]")

HAND = "panda_description/meshes/collision/hand.stl"


@pytest.fixture(scope="module")
def hand_file():
    try:
        files = importlib.metadata.files("example-robot-data")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("the robot's mesh needs example-robot-data: pip install 'carom[test]'")
    return next(file.locate() for file in files if str(file).endswith(HAND))


def test_a_robots_hand_from_its_file_lands_on_the_plane(hand_file):
    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -9.81]))
    scene.add(carom.Plane([0, 0, 1], 0), name="ground", static=True)
    mesh = carom.Mesh.load(hand_file)
    scene.add(mesh, name="hand", density=1000, position=[0, 0, 0.3], orientation=[0.6, 0, 0, 0.8])
    simulation = carom.Simulation(scene, dt=1 / 480)
    report = simulation.advance(3.0)
    assert report.frozen == []
    x, y, z, w = simulation.poses()[1, 3:]
    turn = trimesh.transformations.quaternion_matrix([w, x, y, z])[:3, :3]
    heights = mesh.vertices @ turn[2] + simulation.poses()[1, 2]
    # It lies on the plane: its lowest corner is there, no deeper than the report says, and no
    # higher than it can fall between two steps from rest.
    assert -report.contact.deepest_overlap - 1e-12 <= heights.min() <= 9.81 / 480**2
    assert simulation.contacts()["impulse"][:, 2].sum() > 0
    # At rest: slower than gravity makes it in ten steps, from three metres per second at landing.
    assert np.abs(simulation.twists()[1, :3]).max() < 10 * 9.81 / 480


def test_its_mass_is_the_volume_that_another_library_finds(hand_file):
    scene = carom.Scene()
    scene.add(carom.Mesh.load(hand_file), density=1000)
    other = trimesh.load(hand_file, force="mesh")
    properties = scene.bodies[0].mass_properties
    # Two sums over 200 faces, each of a few roundings of terms not larger than the whole box.
    scale = float(np.prod(np.ptp(other.vertices, axis=0))) * 1000
    assert properties.mass == pytest.approx(other.volume * 1000, abs=200 * 8 * 2.0**-53 * scale)
    # Single-precision coordinates of the file are the same in both.
    np.testing.assert_allclose(properties.com, other.center_mass, rtol=0, atol=1e-13)


@pytest.mark.parametrize("form", ["stl", "ply", "obj", "off"])
def test_each_format_gives_the_same_closed_mesh(tmp_path, form):
    path = tmp_path / f"ball.{form}"
    ball = trimesh.creation.icosphere(subdivisions=1)
    ball.export(path)
    mesh = carom.Mesh.load(path, scale=0.5)
    assert mesh.vertices.shape == ball.vertices.shape  # corners that coincide are one vertex
    assert mesh.faces.shape == ball.faces.shape
    # Files hold 6 decimals at the least; OBJ and OFF write 8.
    assert np.linalg.norm(mesh.vertices, axis=1) == pytest.approx(np.full(42, 0.5), abs=1e-6)
    scene = carom.Scene()
    scene.add(mesh, density=1000)
    assert scene.bodies[0].mass_properties.mass == pytest.approx(125 * ball.volume, rel=1e-5)


def test_a_mesh_in_millimetres_is_suspected(tmp_path):
    path = tmp_path / "part.stl"
    trimesh.creation.box([300, 200, 100]).export(path)
    with pytest.warns(UserWarning, match=r"part.stl is 300 m wide; is the mesh in millimetres\?"):
        carom.Mesh.load(path)
    assert np.ptp(carom.Mesh.load(path, scale=0.001).vertices, axis=0).max() == pytest.approx(0.3)


def test_an_open_mesh_is_warned_of(tmp_path):
    path = tmp_path / "open.ply"
    box = trimesh.creation.box([1, 1, 1])
    trimesh.Trimesh(box.vertices, box.faces[:-1]).export(path)
    with pytest.warns(UserWarning, match=r"open.ply is not closed"):
        carom.Mesh.load(path)


@pytest.mark.parametrize(
    ("name", "content", "rule"),
    [
        ("none.stl", None, "must be a file that exists"),
        ("bad.stl", b"not a mesh", "cannot be read as a mesh|at least one triangle"),
        ("cut.ply", b"ply\nformat ascii 1.0\nelement vertex 3\n", "cannot be read as a mesh"),
        ("points.obj", b"v 0 0 0\nv 1 0 0\n", "at least one triangle|cannot be read"),
        ("what.xyz1", b"0 0 0\n", "cannot be read as a mesh"),
    ],
)
def test_a_file_that_is_no_mesh_is_refused(tmp_path, name, content, rule):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(carom.InvalidInput, match=rule):
        carom.Mesh.load(tmp_path / name)


def test_a_scale_that_is_none_is_refused(tmp_path):
    with pytest.raises(carom.InvalidInput, match="scale: 0 m per unit, must be finite and > 0"):
        carom.Mesh.load(tmp_path / "any.stl", scale=0)


def test_a_scene_file_finds_its_meshes_beside_it_and_shares_them(tmp_path):
    (tmp_path / "parts").mkdir()
    trimesh.creation.icosphere(subdivisions=1).export(tmp_path / "parts" / "ball.stl")
    shape = "shape: {Mesh: {path: parts/ball.stl, scale: 0.1}}"
    (tmp_path / "scene.yaml").write_text(f"bodies:\n  - {{{shape}}}\n  - {{{shape}}}\n")
    first, second = carom.Scene.load(tmp_path / "scene.yaml").bodies
    assert np.shares_memory(first.shape.vertices, second.shape.vertices)
    (tmp_path / "bad.yaml").write_text("bodies:\n  - {shape: {Mesh: {path: no.stl}}}\n")
    with pytest.raises(
        carom.InvalidInput, match=r"bad.yaml:2 bodies\[0\].shape.Mesh.path: .*no.stl"
    ):
        carom.Scene.load(tmp_path / "bad.yaml")


def _with_fault(fault: str):
    """A closed box with one fault, and what is said of it."""
    box = trimesh.creation.box([1, 2, 3])
    vertices, faces = np.array(box.vertices), np.array(box.faces)
    if fault == "inside out":
        return vertices, faces[:, ::-1], "1 part was inside out and turned"
    if fault == "one face turned":
        faces[0] = faces[0, ::-1]
        return vertices, faces, "mixed winding at 3 edges"
    if fault == "duplicate":
        return vertices, np.vstack([faces, faces[:1]]), "1 duplicate face was left out"
    # Two boxes that share one edge, which then has four faces.
    shift = np.array([1.0, 2.0, 0.0])
    return (
        np.vstack([vertices, vertices + shift]),
        np.vstack([faces, faces + len(vertices)]),
        "1 edge is shared by four or more faces",
    )


@pytest.mark.parametrize("fault", ["inside out", "one face turned", "duplicate", "non-manifold"])
@pytest.mark.parametrize("form", ["stl", "ply", "obj"])
def test_a_fault_is_told_and_what_has_one_answer_is_mended(tmp_path, fault, form):
    vertices, faces, said = _with_fault(fault)
    path = tmp_path / f"part.{form}"
    trimesh.Trimesh(vertices, faces, process=False).export(path)
    with pytest.warns(UserWarning, match=said):
        mesh = carom.Mesh.load(path)
    volume = 12.0 if fault == "non-manifold" else 6.0
    # Coordinates are whole numbers: a sum of 24 small volumes is exact to rounding.
    assert trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).volume == pytest.approx(
        volume, abs=1e-12
    )
    # Solid, and its outside outside: a ball 0.1 m over the top face is 0.1 m away.
    distance, *_ = carom.closest_points(mesh, carom.Sphere(0.5), [[0, 0, 0]], [[0.1, 0.2, 2.1]])
    assert distance[0] == pytest.approx(0.1, abs=1e-12)


def test_an_open_mesh_from_a_file_holds_a_ball_on_either_side(tmp_path):
    path = tmp_path / "sheet.stl"
    flat = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    trimesh.Trimesh(flat, [[0, 1, 2], [0, 2, 3]], process=False).export(path)
    with pytest.warns(UserWarning, match="sheet.stl is not closed"):
        sheet = carom.Mesh.load(path)
    for side in (1, -1):
        scene = carom.Scene()
        scene.effects.append(carom.UniformGravity([0, 0, -9.81 * side]))
        scene.add(sheet, static=True)
        scene.add(carom.Sphere(0.1), position=[0.2, 0.1, side * 0.5])
        simulation = carom.Simulation(scene)
        simulation.advance(2)
        # The solver lets a soft contact sink by 0.4 mm at most (tolerance::soft_sink).
        assert simulation.poses()[1, 2] == pytest.approx(side * 0.1, abs=5e-4)
