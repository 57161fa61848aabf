# SPDX-License-Identifier: Apache-2.0
"""Mesh files named by a message: only below one folder, of bounded size."""

import warnings
from pathlib import Path
from urllib.parse import unquote, urlparse

import numpy as np

import carom
from carom_ros import limits
from carom_ros.refusal import Refusal, refusal_of

KINDS = (".obj", ".stl", ".ply", ".off")


def read_mesh(resource: str, mesh_dir: Path | None) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) m and faces (F, 3) of a file below `mesh_dir`. @throws Refusal"""
    path = locate(resource, mesh_dir)
    try:
        with warnings.catch_warnings():  # what it warns of, an open surface, is refused later
            warnings.simplefilter("ignore")
            mesh = carom.Mesh.load(path)
    except Exception as error:  # InvalidInput, a missing trimesh, or what its readers let through
        refusal = refusal_of(error, "mesh_resource")
        reason = refusal.rule if isinstance(error, ValueError) else str(error)
        raise Refusal("mesh_resource", path.name, reason, refusal.remedy) from None
    return np.array(mesh.vertices), np.array(mesh.faces)


def locate(resource: str, mesh_dir: Path | None) -> Path:
    """The file a resource means. Links are followed before the folder is compared."""
    if mesh_dir is None:
        remedy = "start the node with parameter mesh_dir, or send a TRIANGLE_LIST"
        raise Refusal("mesh_resource", resource, "no folder of meshes is set", remedy)
    parsed = urlparse(resource)
    if parsed.scheme not in ("", "file") or parsed.netloc or "\0" in resource or not resource:
        remedy = "a path below mesh_dir, or file:// with one"
        raise Refusal("mesh_resource", resource, "must be a file", remedy)
    root = mesh_dir.resolve()
    try:
        path = (root / unquote(parsed.path)).resolve()
        inside = path.is_relative_to(root) and path.is_file()
        length = path.stat().st_size if inside else 0
    except (OSError, ValueError):
        inside, length = False, 0
    if not inside:
        raise Refusal("mesh_resource", resource, "must be a file below mesh_dir", str(root))
    if path.suffix.lower() not in KINDS:
        raise Refusal("mesh_resource", path.name, f"must end in one of {' '.join(KINDS)}")
    if length > limits.MESH_FILE_BYTES:
        rule = f"must have at most {limits.MESH_FILE_BYTES} bytes"
        raise Refusal("mesh_resource", f"{path.name}: {length} bytes", rule)
    return path
