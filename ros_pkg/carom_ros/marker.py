# SPDX-License-Identifier: Apache-2.0
"""visualization_msgs/Marker as a request. Sizes and frames as RViz draws them."""

from pathlib import Path

import numpy as np

from carom_ros import checks, limits, spawn_text
from carom_ros.mesh_file import read_mesh
from carom_ros.refusal import Refusal
from carom_ros.requests import Delete, DeleteAll, ShapeSpec, Spawn

ADD, DELETE, DELETEALL = 0, 2, 3
CUBE, SPHERE, CYLINDER, MESH_RESOURCE, TRIANGLE_LIST = 1, 2, 3, 10, 11
_TYPES = "1 CUBE, 2 SPHERE, 3 CYLINDER, 10 MESH_RESOURCE or 11 TRIANGLE_LIST"


def request_of(
    marker: object, source: str, *, world_frame: str = "world", mesh_dir: Path | None = None
) -> Spawn | Delete | DeleteAll:
    """The request a Marker makes. @throws Refusal naming the field that cannot be used"""
    if marker.action == DELETEALL:
        return DeleteAll(source, marker.ns)
    if marker.action == DELETE:
        return Delete(source, marker.ns, marker.id, spawn_text.parse(marker.text).get("name", ""))
    if marker.action != ADD:
        raise Refusal("action", marker.action, "must be 0 ADD, 2 DELETE or 3 DELETEALL")
    require_world(marker.header.frame_id, world_frame)
    shape = _shape(marker, mesh_dir)
    text = spawn_text.parse(marker.text)
    if {"mass", "density"} <= text.keys():
        raise Refusal("text.density", text["density"], "mass is given too", "give one of them")
    return Spawn(
        source=source,
        ns=marker.ns,
        id=marker.id,
        name=text.get("name") or default_name(marker.ns, marker.id),
        shape=shape,
        position=checks.vector(marker.pose.position, "pose.position", limits.COORDINATE_M, "m"),
        orientation=checks.orientation(marker.pose.orientation, "pose.orientation"),
        velocity=text.get("velocity", (0.0, 0.0, 0.0)),
        angular_velocity=text.get("angular_velocity", (0.0, 0.0, 0.0)),
        properties={
            key: text[key]
            for key in ("mass", "density", "friction", "restitution", "ccd")
            if key in text
        },
        static=text.get("static", False),
        frames=text.get("frames", {}),
        lifetime=_lifetime(marker.lifetime),
        colour=_colour(marker.color),
    )


def default_name(ns: str, id_: int) -> str:
    """<ns>_<id>; without a namespace marker_<id>. @throws Refusal where that is no name"""
    try:
        return checks.body_name(f"{ns or 'marker'}_{id_}", "name")
    except Refusal as refusal:
        example = f"text: '{spawn_text.EXAMPLE}'"
        raise Refusal("ns, id", refusal.value, refusal.rule, f"give a name: {example}") from None


def require_world(frame: str, world_frame: str) -> None:
    if frame not in ("", world_frame):
        raise Refusal(
            "header.frame_id", frame, f"must be {world_frame} or empty", "transform it first"
        )


def _shape(marker: object, mesh_dir: Path | None) -> ShapeSpec:
    if marker.type not in (CUBE, SPHERE, CYLINDER, MESH_RESOURCE, TRIANGLE_LIST):
        remedy = "type 0 is an arrow, and what a message says that says nothing"
        raise Refusal("type", marker.type, f"must be {_TYPES}", remedy if marker.type == 0 else "")
    x, y, z = (checks.size(getattr(marker.scale, axis), f"scale.{axis}") for axis in "xyz")
    if marker.type == CUBE:
        return ShapeSpec("box", (x, y, z))
    if marker.type == SPHERE:
        if not x == y == z:
            rule = "must be equal for a sphere"
            raise Refusal("scale", f"{x:.4g} {y:.4g} {z:.4g} m", rule, "send the diameter thrice")
        return ShapeSpec("sphere", (x / 2,))
    if marker.type == CYLINDER:
        if x != y:
            rule = "x and y must be equal for a cylinder"
            raise Refusal("scale", f"{x:.4g} {y:.4g} m", rule, "x and y are the diameter, z height")
        return ShapeSpec("cylinder", (x / 2, z))
    if marker.type == MESH_RESOURCE:
        vertices, faces = read_mesh(marker.mesh_resource, mesh_dir)
        return mesh_spec(vertices * (x, y, z), faces, "mesh_resource")
    return mesh_spec(*_triangles(marker.points, (x, y, z)), "points")


def _triangles(points: list, scale: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    if not points or len(points) % 3 or len(points) > limits.MESH_POINTS:
        rule = f"must be 3 to a triangle, 1 to {limits.MESH_POINTS // 3} triangles"
        raise Refusal("points", f"{len(points)} points", rule)
    flat = np.array([(p.x, p.y, p.z) for p in points]) * scale
    if not np.isfinite(flat).all():
        row = int(np.argmax(~np.isfinite(flat).all(axis=1)))
        raise Refusal(f"points[{row}]", str(flat[row]), "must be finite")
    # A list of triangles repeats each corner; a closed surface needs them to be the same vertex.
    # Adding 0.0 turns -0.0 into 0.0, which unique would otherwise still treat as equal but keep.
    vertices, index = np.unique(flat + 0.0, axis=0, return_inverse=True)
    return vertices, index.reshape(-1, 3)


def mesh_spec(vertices: np.ndarray, faces: np.ndarray, field: str) -> ShapeSpec:
    """A mesh as a value. Whether it is closed is the core's to judge, when the body is made."""
    if not np.isfinite(vertices).all() or np.abs(vertices).max(initial=0) > limits.SIZE_MAX_M:
        raise Refusal(field, "a vertex", f"must be finite and at most {limits.SIZE_MAX_M:g} m away")
    extent = float(np.ptp(vertices, axis=0).max(initial=0))
    if extent < limits.SIZE_MIN_M:
        raise Refusal(field, f"{extent:.4g} m wide", f"must be at least {limits.SIZE_MIN_M:g} m")
    return ShapeSpec("mesh", (), vertices.astype("<f8").tobytes(), faces.astype("<i4").tobytes())


def _lifetime(duration: object) -> float:
    seconds = duration.sec + 1e-9 * duration.nanosec
    if seconds < 0:
        raise Refusal("lifetime", f"{seconds:.4g} s", "must be >= 0", "0 is for ever")
    return seconds


def _colour(color: object) -> tuple[float, float, float, float]:
    return tuple(
        min(1.0, max(0.0, checks.number(getattr(color, part), f"color.{part}", 1e9, "")))
        for part in "rgba"
    )
