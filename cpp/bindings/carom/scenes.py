# SPDX-License-Identifier: Apache-2.0
"""The scenes that come with carom, by name."""

from __future__ import annotations

from pathlib import Path

from carom.errors import InvalidInput, nearest

_PACKAGE = Path(__file__).parent
# Beside the package where it is installed, in cpp/scenes where it runs from a checkout.
_FOLDERS = (_PACKAGE / "scenes", _PACKAGE.parents[1] / "scenes")


def scene_names() -> list[str]:
    """Names of the shipped scenes, sorted."""
    return sorted({path.stem for folder in _FOLDERS for path in folder.glob("*.yaml")})


def scene_path(scene: str | Path) -> Path:
    """The file of a scene: a path as it is, or the name of a shipped scene.

    Raises InvalidInput, with the nearest name, when it is neither.
    """
    path = Path(scene)
    if path.exists():
        return path
    for folder in _FOLDERS:
        shipped = folder / f"{scene}.yaml"
        if path.name == str(scene) and shipped.is_file():
            return shipped
    remedy = nearest(path.stem, scene_names())
    raise InvalidInput("scene", str(scene), "must be a file or a shipped scene", remedy)
