# SPDX-License-Identifier: Apache-2.0
"""MESH_RESOURCE: files below one folder, whatever a message writes."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from carom_ros.mesh_file import locate, read_mesh
from carom_ros.refusal import Refusal

WEDGE = """v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "meshes" / "sub").mkdir(parents=True)
    (tmp_path / "meshes" / "wedge.obj").write_text(WEDGE)
    (tmp_path / "meshes" / "sub" / "a b.obj").write_text(WEDGE)
    (tmp_path / "meshes" / "notes.txt").write_text("no mesh")
    (tmp_path / "meshes" / "junk.stl").write_bytes(b"\xff" * 100)
    (tmp_path / "secret.obj").write_text(WEDGE)
    (tmp_path / "meshes" / "link.obj").symlink_to(tmp_path / "secret.obj")
    return tmp_path / "meshes"


@pytest.mark.parametrize("resource", ["wedge.obj", "sub/a%20b.obj", "sub/../wedge.obj"])
def test_a_file_below_the_folder_is_found(folder: Path, resource: str) -> None:
    assert locate(resource, folder).suffix == ".obj"
    assert locate(f"file://{folder}/wedge.obj", folder).name == "wedge.obj"


@pytest.mark.parametrize(
    "resource",
    [
        "../secret.obj",
        "%2e%2e/secret.obj",
        "/etc/passwd",
        "file:///etc/passwd",
        "file://host/wedge.obj",
        "http://localhost/wedge.obj",
        "package://carom_ros/wedge.obj",
        "link.obj",
        "notes.txt",
        "absent.obj",
        "sub",
        "",
        "a\0b.obj",
        "x" * 5000,
    ],
)
def test_nothing_else_is_read(folder: Path, resource: str) -> None:
    with pytest.raises(Refusal, match="mesh_resource"):
        locate(resource, folder)


def test_without_a_folder_there_are_no_files() -> None:
    with pytest.raises(Refusal, match="mesh_dir"):
        locate("wedge.obj", None)


def test_a_file_that_is_no_mesh_is_refused(folder: Path) -> None:
    with pytest.raises(Refusal, match=r"junk\.stl"):
        read_mesh("junk.stl", folder)


def test_a_marker_spawns_a_mesh_file_at_its_scale(make_bench: Callable, folder: Path) -> None:
    bench = make_bench(overrides={"mesh_dir": str(folder)})
    msg = Marker(type=Marker.MESH_RESOURCE, ns="m", id=1, mesh_resource="wedge.obj")
    msg.scale.x, msg.scale.y, msg.scale.z = 2.0, 1.0, 0.5
    msg.pose.position.z = 1.0
    bench.send("/carom/spawn", msg)
    assert bench.world.names == ["ground", "m_1"]
    assert np.ptp(bench.world.bodies["m_1"].shape.vertices, axis=0).tolist() == [2, 1, 0.5]
    mass = bench.world.simulation.scene.bodies[1].mass_properties.mass
    assert mass == pytest.approx(1000 * 2 * 1 * 0.5 / 6, rel=1e-12)
