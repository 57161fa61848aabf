# SPDX-License-Identifier: Apache-2.0
"""Triangle meshes from files: OBJ, STL, PLY and what else trimesh reads."""

from __future__ import annotations

import math
import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from carom._core import Mesh, MeshDiagnosis, mend_mesh
from carom.errors import InvalidInput, MissingDependency

IMPLAUSIBLE_M = 100.0
"""Choice: a part wider than this is rarer than one drawn in millimetres and read as metres."""


def load(path: str | os.PathLike[str], scale: float = 1.0) -> Mesh:
    """Reads a mesh file. scale: m per unit of the file, > 0.

    Corners that coincide are one vertex afterwards (STL stores each three to six times), and a file
    of several parts becomes one mesh. What else is done to a faulty mesh, each warned of:

    - open: left as it is, a sheet. As a static body it holds others on either side; it has no mass;
    - parts inside out, faces wound against their neighbours: turned, where the mesh is closed;
    - duplicate faces and faces that use a corner twice: left out;
    - edges of four and more faces, parts within parts, surfaces that cross: left as they are.

    Raises InvalidInput when the file is not there, cannot be read or holds no triangle;
    MissingDependency without trimesh.
    """
    path = Path(path)
    if not (scale > 0 and math.isfinite(scale)):
        raise InvalidInput("scale", f"{scale:g} m per unit", "must be finite and > 0")
    if not path.is_file():
        raise InvalidInput("path", str(path), "must be a file that exists")
    mesh = _read(path)
    vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64) * scale
    faces = np.ascontiguousarray(mesh.faces, dtype=np.int32)
    mended, mended_faces, found = mend_mesh(vertices, faces)
    if found.findings and found.closed:
        vertices, faces = mended, mended_faces
    for remark in _remarks(path.name, vertices, faces, found):
        warnings.warn(remark, stacklevel=2)
    return Mesh(vertices, faces)


def _read(path: Path) -> Any:
    try:
        import trimesh
    except ImportError as error:
        raise MissingDependency("reading mesh files", "trimesh", "mesh") from error
    try:
        mesh = trimesh.load(path, force="mesh", process=True, merge_norm=True, merge_tex=True)
    except Exception as error:  # each format's reader raises its own kinds
        reason = str(error) or type(error).__name__
        raise InvalidInput("path", str(path), f"cannot be read as a mesh ({reason})") from error
    if len(mesh.faces) == 0:
        raise InvalidInput("path", str(path), "must hold at least one triangle")
    return mesh


def _remarks(name: str, vertices: np.ndarray, faces: np.ndarray, found: MeshDiagnosis) -> list[str]:
    used = vertices[np.unique(faces)]
    width = float(np.ptp(used, axis=0).max())
    remarks = []
    if width > IMPLAUSIBLE_M:
        remarks.append(f"{name} is {width:.4g} m wide; is the mesh in millimetres? try scale=0.001")
    if not found.closed:
        remarks.append(f"{name} is not closed: its inside, and so its mass, is not well defined")
    told = ("the mesh is open", "the mesh has")  # above; and a cavity is no fault
    remarks += [f"{name}: {each}" for each in found.findings if not each.startswith(told)]
    return remarks
