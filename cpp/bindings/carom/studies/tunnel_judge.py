# SPDX-License-Identifier: Apache-2.0
"""Who passed through what, told from poses alone: no collision code takes part.

Every judge looks at the state after each step and says whether a crossing has happened. `deepest`
is how far, m, a point of a body was seen inside what it hit.
"""

from __future__ import annotations

import numpy as np

PIERCED = 1e-3
"""m. A point of the surface that far beyond the far side of a wall is a crossing too."""


def rotation(q: np.ndarray) -> np.ndarray:
    x, y, z, w = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def place(simulation, row: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(R, origin, velocity of the origin) of a body."""
    pose = simulation.poses()[row]
    return rotation(pose[3:]), pose[:3], simulation.twists()[row, :3]


class WallJudge:
    """A flat wall that may move; its frame's z axis is its normal, the body starts at z > 0."""

    def __init__(self, wall: int, body: int, mover, half: float, thickness: float) -> None:
        self.wall, self.body, self.mover = wall, body, mover
        self.half, self.thickness = half, thickness
        self.deepest, self.over = 0.0, False

    def _seen(self, simulation):
        """R, place and velocity of the body in the wall's frame."""
        r, x, v = place(simulation, self.body)
        wall_r, wall_x, wall_v = place(simulation, self.wall)
        return wall_r.T @ r, wall_r.T @ (x - wall_x), wall_r.T @ (v - wall_v)

    def crossed(self, simulation, dt: float) -> bool:
        if self.over:
            return False
        r, x, v = self._seen(simulation)
        rim = self.half - self.mover.outer
        if x[2] < 0:
            # Where was the plane passed? On the last straight piece of the path, if it can be.
            back = x[2] / v[2] if v[2] < 0 else 0.0
            at = x[:2] - v[:2] * min(back, dt)
            if np.abs(at).max() < self.half:
                return True
            self.over = True  # it went round the rim
            return False
        points = self.mover.surface @ r.T + x
        inside = points[np.abs(points[:, :2]).max(axis=1) < rim]
        if len(inside):
            low = float(inside[:, 2].min())
            self.deepest = max(self.deepest, self.thickness / 2 - low)
            if low < -self.thickness / 2 - PIERCED:
                return True
        self.over = bool(np.abs(x[:2]).max() > rim)
        return False


class CavityJudge:
    """A convex cavity, normal . x <= offset for each side, in the frame of a body (None: world).

    `mouth`: an index of a side that is open: whatever leaves through it is judged no more.
    """

    def __init__(self, frame: int | None, bodies, normals, offsets, thickness: float, mouth=None):
        self.frame, self.bodies = frame, bodies  # (row, mover) of each
        self.normals, self.offsets = np.asarray(normals, float), np.asarray(offsets, float)
        self.thickness, self.mouth = thickness, mouth
        self.deepest, self.gone = 0.0, set()

    def crossed(self, simulation, dt: float) -> bool:
        wall_r, wall_x = np.eye(3), np.zeros(3)
        if self.frame is not None:
            wall_r, wall_x, _ = place(simulation, self.frame)
        closed = np.ones(len(self.offsets), bool)
        if self.mouth is not None:
            closed[self.mouth] = False
        for row, mover in self.bodies:
            if row in self.gone:
                continue
            r, x, _ = place(simulation, row)
            r, x = wall_r.T @ r, wall_r.T @ (x - wall_x)
            points = mover.surface @ r.T + x
            if self.mouth is not None:
                over = points @ self.normals[self.mouth] - self.offsets[self.mouth]
                if over.max() > 0:  # part of it is out of the mouth, where sides have no rule
                    self.gone.add(row)
                    out = self.normals[self.mouth] @ x - self.offsets[self.mouth]
                    if out > 0:
                        continue
            beyond = (self.normals @ x - self.offsets)[closed]
            if beyond.max() > 0:
                return True
            if row in self.gone:
                continue
            depth = float((points @ self.normals[closed].T - self.offsets[closed]).max())
            self.deepest = max(self.deepest, depth)
            if depth > self.thickness + PIERCED:
                return True
        return False


class PairJudge:
    """Two bodies that fly at each other: their order along the line must stay.

    They may pass beside each other after a glancing hit; then the distance of their centres at the
    moment they are level, on the last straight piece of their paths, is at least that of the balls
    inside them.
    """

    def __init__(self, a: int, b: int, movers, direction) -> None:
        self.a, self.b, self.direction = a, b, np.asarray(direction, float)
        self.near = (movers[0].inner + movers[1].inner) * (1 - 1e-6)
        self.deepest, self.over = 0.0, False

    def crossed(self, simulation, dt: float) -> bool:
        if self.over:
            return False
        _, xa, va = place(simulation, self.a)
        _, xb, vb = place(simulation, self.b)
        x, v = xb - xa, vb - va
        self.deepest = max(self.deepest, self.near - float(np.linalg.norm(x)))
        along, speed = x @ self.direction, v @ self.direction
        if along > 0:
            return False
        self.over = True
        back = along / speed if speed < 0 else 0.0
        at = x - v * min(back, dt)
        return float(np.linalg.norm(at)) < self.near
