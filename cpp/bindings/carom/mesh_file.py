# SPDX-License-Identifier: Apache-2.0
"""Triangle meshes from files: OBJ, STL, PLY and what else trimesh reads."""

from __future__ import annotations

import math
import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from carom._core import Mesh
from carom.errors import InvalidInput, MissingDependency

IMPLAUSIBLE_M = 100.0
"""Choice: a part wider than this is rarer than one drawn in millimetres and read as metres."""


def load(path: str | os.PathLike[str], scale: float = 1.0) -> Mesh:
    """Reads a mesh file. scale: m per unit of the file, > 0.

    Corners that coincide are one vertex afterwards (STL stores each three to six times), and a file
    of several parts becomes one mesh. Holes are left as they are and warned of: the inside of an
    open mesh is not defined. Raises InvalidInput when the file is not there, cannot be read or
    holds no triangle; MissingDependency without trimesh.
    """
    path = Path(path)
    if not (scale > 0 and math.isfinite(scale)):
        raise InvalidInput("scale", f"{scale:g} m per unit", "must be finite and > 0")
    if not path.is_file():
        raise InvalidInput("path", str(path), "must be a file that exists")
    mesh = _read(path)
    vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64) * scale
    faces = np.ascontiguousarray(mesh.faces, dtype=np.int32)
    for remark in _remarks(path.name, vertices, faces, bool(mesh.is_watertight)):
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


def _remarks(name: str, vertices: np.ndarray, faces: np.ndarray, closed: bool) -> list[str]:
    used = vertices[np.unique(faces)]
    width = float(np.ptp(used, axis=0).max())
    remarks = []
    if width > IMPLAUSIBLE_M:
        remarks.append(f"{name} is {width:.4g} m wide; is the mesh in millimetres? try scale=0.001")
    if not closed:
        remarks.append(f"{name} is not closed: its inside, and so its mass, is not well defined")
    return remarks
