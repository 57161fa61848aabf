# SPDX-License-Identifier: Apache-2.0
"""A scene at one moment as a picture: sun, sky, soft shadows, a floor that fades far away."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from carom._core import Plane, Scene
from carom.errors import InvalidInput, MissingDependency, writable
from carom.render.light import SUN, lit_by, sky_directions, sun_directions
from carom.render.raster import gradients, raster
from carom.render.surfaces import Surfaces, surfaces_of
from carom.render.views import View, camera

SUPERSAMPLING = 2
AZIMUTH, ELEVATION = -1.05, 0.30  # rad, of the eye as seen from the scene

# sRGB; everything below is linear light, so that averages and products mean what they say.
_PALETTE = [[222, 92, 58], [240, 174, 70], [64, 124, 166], [116, 168, 116], [236, 221, 196],
            [134, 96, 148], [58, 78, 112], [204, 138, 128]]  # fmt: skip
PALETTE = (np.array(_PALETTE) / 255) ** 2.2
STATIC = np.full(3, 0.30)
FLOOR = np.array([0.80, 0.80, 0.81])
HORIZON = np.array([0.82, 0.86, 0.91])
ZENITH = np.array([0.45, 0.60, 0.80])
SUNLIGHT = 1.00 * np.array([1.0, 0.95, 0.87])
SKYLIGHT = 0.72 * np.array([0.86, 0.93, 1.0])
BOUNCE = 0.13 * np.array([1.0, 0.97, 0.93])


class Seen(NamedTuple):
    """What the pixels see that see anything."""

    index: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    light_from: np.ndarray
    """which of them to take the light from: one of a pixel's samples serves all on one surface"""


def require_packages() -> None:
    """Raises MissingDependency unless pictures can be written."""
    try:
        import PIL.Image  # noqa: F401
    except ImportError as error:
        raise MissingDependency("drawing pictures", "pillow", "plot") from error


def save(
    path: str | os.PathLike[str],
    scene: Scene,
    moments: Sequence[np.ndarray],
    size: tuple[int, int] = (960, 540),
) -> None:
    """Writes a PNG of the scene at each moment, side by side, all from one camera.

    moments: arrays (N, 7) as `Simulation.poses()` gives them; size: pixels of the whole picture.
    """
    require_packages()
    from PIL import Image

    gap = 4  # pixels between panels
    width = (size[0] - gap * (len(moments) - 1)) // len(moments)
    if width < 1:
        raise InvalidInput("size", f"{size[0]} pixels wide", f"must hold {len(moments)} panels")
    with writable(path, "png", "wb") as file:
        hull = np.concatenate([_hull(surfaces_of(scene, poses)) for poses in moments])
        view = _camera(scene, hull, (width, size[1]))
        panels = []
        for poses in moments:
            panels.append(render(scene, poses, (width, size[1]), view))
            panels.append(np.full((size[1], gap, 3), 255, np.uint8))
        picture = Image.fromarray(np.concatenate(panels[:-1], axis=1))
        picture.save(file, format="PNG", optimize=True)


def render(
    scene: Scene,
    poses: np.ndarray,
    size: tuple[int, int] = (960, 540),
    view: View | None = None,
) -> np.ndarray:
    """(height, width, 3) uint8 of the scene at `poses` (N, 7), seen from where all of it shows."""
    surfaces = surfaces_of(scene, poses)
    hull = _hull(surfaces)
    fine = _finer(view or _camera(scene, hull, size))
    index, points, normals = _visible(fine, surfaces)
    colour = _background(fine)
    if (index >= 0).any():
        hit = index >= 0
        seen = Seen(index[hit], points[hit], normals[hit], _shared_light(index)[hit])
        colour[hit] = _shade(scene, surfaces, hull, fine, seen, colour[hit])
    height, width = fine.height // SUPERSAMPLING, fine.width // SUPERSAMPLING
    image = colour.reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 3).mean((1, 3))
    return _to_screen(image)


def _hull(surfaces: Surfaces) -> np.ndarray:
    """(M, 3) points that bound every triangle and sphere; planes have no end."""
    cube = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    balls = surfaces.centres[:, None] + cube * surfaces.radii[:, None, None]
    points = np.concatenate([surfaces.corners.reshape(-1, 3), balls.reshape(-1, 3)])
    return points if len(points) else cube.astype(float)


def _camera(scene: Scene, points: np.ndarray, size: tuple[int, int]) -> View:
    has_floor = any(isinstance(body.shape, Plane) for body in scene.bodies)
    on_floor = points * [1, 1, 0] if has_floor and points[:, 2].min() > 0 else points
    return camera(np.concatenate([points, on_floor]), size, AZIMUTH, ELEVATION)


def _finer(view: View) -> View:
    k = SUPERSAMPLING
    return replace(view, scale=view.scale * k, width=view.width * k, height=view.height * k)


def _visible(view: View, surfaces: Surfaces) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What each pixel sees (triangles, then spheres, then planes; -1 nothing), where, with what
    normal."""
    keys, index = raster(view, surfaces)
    x, y = np.meshgrid(np.arange(view.width), np.arange(view.height))
    origins, directions = view.rays(x, y)
    n_triangles, n_spheres = len(surfaces.corners), len(surfaces.centres)
    for i, (n, offset) in enumerate(
        zip(surfaces.plane_normals, surfaces.plane_offsets, strict=True)
    ):
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = (offset - origins @ n) / (directions @ n)
            nearer = (depth > 0) & (view.key(depth) > keys) & (directions @ n < 0)
        keys[nearer] = view.key(depth[nearer])
        index[nearer] = n_triangles + n_spheres + i
    seen = index >= 0
    points = np.zeros((*index.shape, 3))
    points[seen] = origins[seen] + directions[seen] / np.where(seen, keys, 1)[seen][:, None]
    normals = np.zeros_like(points)
    flat = seen & (index < n_triangles)
    xy, key = view.project(surfaces.corners)
    normals[flat] = _interpolated(xy, key, surfaces.normals, index[flat], x[flat], y[flat])
    ball = (index >= n_triangles) & (index < n_triangles + n_spheres)
    which = index[ball] - n_triangles
    normals[ball] = (points[ball] - surfaces.centres[which]) / surfaces.radii[which][:, None]
    floor = index >= n_triangles + n_spheres
    normals[floor] = surfaces.plane_normals[index[floor] - n_triangles - n_spheres]
    away = (normals * directions).sum(-1) > 0  # an open mesh seen from inside
    normals[away] *= -1
    return index, points, normals


def _shared_light(index: np.ndarray) -> np.ndarray:
    """(H, W) places in the list of pixels that see anything: the first sample of the picture's
    pixel where all its samples see one surface, else the sample itself."""
    k = SUPERSAMPLING
    height, width = index.shape
    place = (np.cumsum(index >= 0) - 1).reshape(height // k, k, width // k, k)
    block = index.reshape(height // k, k, width // k, k)
    uniform = (block == block[:, :1, :, :1]).all((1, 3), keepdims=True)
    return np.where(uniform, place[:, :1, :, :1], place).reshape(height, width)


def _interpolated(
    xy: np.ndarray,
    key: np.ndarray,
    normals: np.ndarray,
    which: np.ndarray,
    x: np.ndarray,
    y: np.ndarray,
) -> np.ndarray:
    """Normals between the corners of triangles `which`; weights divided by depth, as perspective
    asks."""
    per_x, per_y, first = gradients(xy)
    from_first = np.stack([x, y], axis=1) - xy[which, 0]
    weights = first[which] + per_x[which] * from_first[:, :1] + per_y[which] * from_first[:, 1:]
    weights *= key[which]
    mixed = (weights[..., None] * normals[which]).sum(1)
    return mixed / np.linalg.norm(mixed, axis=1, keepdims=True)


def _background(view: View) -> np.ndarray:
    x, y = np.meshgrid(np.arange(view.width), np.arange(view.height))
    _, directions = view.rays(x, y)
    up = np.clip(directions[..., 2] / np.linalg.norm(directions, axis=-1), 0, 1)[..., None]
    return HORIZON + (ZENITH - HORIZON) * up**0.6


def _shade(
    scene: Scene, surfaces: Surfaces, hull: np.ndarray, view: View, seen: Seen, behind: np.ndarray
) -> np.ndarray:
    """(M, 3) linear colours of the points seen; behind: the background's at those pixels."""
    bodies = np.concatenate([surfaces.triangle_body, surfaces.sphere_body, surfaces.plane_body])
    is_floor = seen.index >= len(surfaces.corners) + len(surfaces.centres)
    albedo = _colours(scene)[bodies[seen.index]]
    radius = 0.5 * np.linalg.norm(np.ptp(hull, axis=0))
    to_eye = view.origin - seen.points
    depth = np.linalg.norm(to_eye, axis=1)
    away = np.linalg.norm(seen.points - hull.mean(0), axis=1)
    haze = np.where(is_floor, 1 - np.exp(-((away / (4.5 * radius)) ** 2)), 0)[:, None]
    albedo = np.where(is_floor[:, None], _floor(seen, radius, depth / view.scale), albedo)

    sun = np.maximum(seen.normals @ SUN, 0)
    sky = np.full(len(sun), 0.5)
    # Farther off shadows are lost in the haze.
    near = np.unique(seen.light_from[haze[:, 0] < 0.5])
    spots = seen.points[near], seen.normals[near]
    sun[near] = lit_by(surfaces, hull, sun_directions(), *spots, pixels=min(1024, view.width))
    sky[near] = lit_by(surfaces, hull, sky_directions(), *spots, pixels=min(320, view.width))
    sun, sky = sun[seen.light_from], sky[seen.light_from]
    bounce = 0.5 - 0.5 * seen.normals[:, 2:]
    colour = albedo * (SUNLIGHT * sun[:, None] + SKYLIGHT * sky[:, None] + BOUNCE * bounce)
    colour += np.where(is_floor, 0, _gloss(seen.normals, to_eye / depth[:, None], sun))[:, None]
    return colour + (behind - colour) * haze


def _gloss(normals: np.ndarray, to_eye: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """The sun's highlight, and the sky mirrored where a surface is seen at a flat angle."""
    half = to_eye + SUN
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    highlight = 0.5 * np.maximum((normals * half).sum(1), 0) ** 90 * np.minimum(4 * sun, 1)
    rim = 0.22 * (1 - np.clip((normals * to_eye).sum(1), 0, 1)) ** 4
    return highlight + rim


def _colours(scene: Scene) -> np.ndarray:
    """(N, 3): moving bodies take the palette in turn, static ones are grey."""
    turn = iter(range(len(scene)))
    return np.array(
        [STATIC if b.static else PALETTE[next(turn) % len(PALETTE)] for b in scene.bodies]
    )


def _floor(seen: Seen, radius: float, footprint: np.ndarray) -> np.ndarray:
    """Albedo with a grid of lines 1, 2 or 5 times a power of ten m apart, a quarter of the scene.

    footprint: m that a pixel spans there, over which a line is averaged.
    """
    decade = 10 ** np.floor(np.log10(radius / 2))
    step = decade * max(k for k in (1, 2, 5) if k * decade <= radius / 2)
    tangents = [np.cross(seen.normals, axis) for axis in ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0])]
    flat = np.abs(
        np.mod(np.stack([(t * seen.points).sum(1) for t in tangents]) + step / 2, step) - step / 2
    )
    half = 0.006 * step
    grazing = 3 * footprint  # the floor is seen at a flat angle
    cover = np.clip((half + 0.5 * grazing - flat) / grazing, 0, np.minimum(1, 2 * half / grazing))
    return FLOOR * (1 - 0.35 * cover.max(0))[:, None]


def _to_screen(linear: np.ndarray) -> np.ndarray:
    """sRGB bytes; what is brighter than 0.8 is bent towards 1 rather than cut off."""
    knee = 0.8
    over = np.maximum(linear - knee, 0)
    bent = np.minimum(linear, knee) + (1 - knee) * over / (over + (1 - knee))
    encoded = np.where(bent <= 0.0031308, 12.92 * bent, 1.055 * bent ** (1 / 2.4) - 0.055)
    return np.rint(255 * encoded).astype(np.uint8)
