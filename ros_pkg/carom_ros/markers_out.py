# SPDX-License-Identifier: Apache-2.0
"""Bodies as markers, for RViz and Foxglove with no TF."""

import json
import math
import zlib

import numpy as np
from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker, MarkerArray

import carom
from carom_ros.draw import SHEET_M, draw
from carom_ros.rotate import rotated, stamp
from carom_ros.world import Known, World


class BodyMarkers:
    """Keeps one Marker per body and renews only what moved."""

    def __init__(self, frame_id: str) -> None:
        self._frame_id = frame_id
        self._generation = -1
        self._markers: dict[str, Marker] = {}

    def array(self, world: World) -> MarkerArray:
        array = MarkerArray()
        if world.generation != self._generation:
            self._generation = world.generation
            array.markers.append(self._clear())
            self._markers = {name: self._marker(name, world.bodies[name]) for name in world.names}
        sec, nanosec = stamp(world.time)
        poses = world.simulation.poses().tolist()
        for name, pose in zip(world.names, poses, strict=True):
            marker = self._markers[name]
            marker.header.stamp.sec, marker.header.stamp.nanosec = sec, nanosec
            place(marker, world.bodies[name].shape, pose)
            array.markers.append(marker)
        return array

    def _clear(self) -> Marker:
        marker = Marker(action=Marker.DELETEALL)
        marker.header.frame_id = self._frame_id
        return marker

    def _marker(self, name: str, known: Known) -> Marker:
        marker = Marker(ns=name, id=0, action=Marker.ADD)
        marker.header.frame_id = self._frame_id
        draw(marker, known.shape)
        colour = known.spawn.colour if known.spawn is not None else (0.0,) * 4
        if colour[3] == 0:
            colour = _colour(name, known.static)
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = colour
        return marker


def place(marker: Marker, shape: object, pose: list[float]) -> None:
    if isinstance(shape, carom.Plane):
        pose = plane_pose(shape, np.array(pose)).tolist()
    position, orientation = marker.pose.position, marker.pose.orientation
    position.x, position.y, position.z = pose[:3]
    orientation.x, orientation.y, orientation.z, orientation.w = pose[3:]


def plane_pose(plane: object, pose: np.ndarray) -> np.ndarray:
    """Pose of a thin slab just below a plane, z along its normal."""
    normal = np.asarray(plane.normal, dtype=float)
    length = np.linalg.norm(normal)
    normal = rotated(pose[3:], normal / length)
    # plane.offset is along the unit normal, from the body frame's origin
    centre = pose[:3] + normal * (plane.offset - SHEET_M / 2)
    return np.concatenate([centre, _from_z(normal)])


def _from_z(direction: np.ndarray) -> np.ndarray:
    """The shortest rotation that takes z to a unit vector."""
    w = 1.0 + direction[2]
    if w < 1e-9:
        return np.array([1.0, 0.0, 0.0, 0.0])
    q = np.array([-direction[1], direction[0], 0.0, w])
    return q / np.linalg.norm(q)


def contact_markers(world: World, frame_id: str) -> MarkerArray:
    """An arrow per contact point along the force on body b, 1 cm per newton up to 1 m; `text` says
    who touches, as JSON."""
    array = MarkerArray()
    clear = Marker(action=Marker.DELETEALL)
    clear.header.frame_id = frame_id
    array.markers.append(clear)
    sec, nanosec = stamp(world.time)
    for number, contact in enumerate(world.simulation.contacts()):
        force = contact["impulse"] / world.dt
        size = float(np.linalg.norm(force))
        arrow = force * (min(0.01 * size, 1.0) / size) if size > 0 else contact["normal"] * 0.01
        marker = Marker(ns="contacts", id=number, type=Marker.ARROW, action=Marker.ADD)
        marker.header.frame_id = frame_id
        marker.header.stamp.sec, marker.header.stamp.nanosec = sec, nanosec
        ends = (contact["position"], contact["position"] + arrow)
        marker.points = [Point(x=x, y=y, z=z) for x, y, z in (end.tolist() for end in ends)]
        marker.scale.x, marker.scale.y, marker.scale.z = 0.01, 0.02, 0.02
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = 1.0, 0.3, 0.1, 1.0
        names = [world.names[contact[side]] for side in ("a", "b")]
        vectors = {"normal": contact["normal"].tolist(), "force_n": force.tolist()}
        marker.text = json.dumps(
            {"a": names[0], "b": names[1], **vectors, "gap_m": float(contact["separation"])}
        )
        array.markers.append(marker)
    return array


def _colour(name: str, static: bool) -> tuple[float, float, float, float]:
    """Grey for what never moves; else a hue that a name keeps from run to run."""
    if static:
        return (0.55, 0.57, 0.6, 1.0)
    hue = zlib.crc32(name.encode()) / 2**32
    thirds = (hue, hue + 1 / 3, hue + 2 / 3)
    red, green, blue = (0.55 + 0.35 * math.cos(2 * math.pi * third) for third in thirds)
    return (red, green, blue, 1.0)
