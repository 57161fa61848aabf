# SPDX-License-Identifier: Apache-2.0
"""Vectors turned by a quaternion (x, y, z, w), and simulated time as a stamp."""

import numpy as np


def rotated(orientation: np.ndarray, vector: object) -> np.ndarray:
    """The vector of body axes in world axes, for a unit quaternion from body to world."""
    axis, w = np.asarray(orientation[:3], dtype=float), float(orientation[3])
    v = np.asarray(vector, dtype=float)
    twice = 2.0 * np.cross(axis, v)
    return v + w * twice + np.cross(axis, twice)


def stamp(seconds: float) -> tuple[int, int]:
    """Simulated time, s >= 0, as (sec, nanosec) to the nearest nanosecond."""
    return divmod(round(seconds * 1e9), 1_000_000_000)
