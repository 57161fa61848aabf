# SPDX-License-Identifier: Apache-2.0
# Written by cpp/bindings/make_stubs.
"""
A body as the particles it is made of.
"""

from __future__ import annotations

import typing

import numpy
import numpy.typing

__all__: list[str] = [
    "angular_momentum",
    "centred",
    "kinetic_energy",
    "momentum",
    "net_wrench",
    "to_object",
    "to_world",
    "velocities",
]

def angular_momentum(
    masses: numpy.typing.ArrayLike,
    positions: numpy.typing.ArrayLike,
    velocities: numpy.typing.ArrayLike,
    about: numpy.typing.ArrayLike,
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    Sum of m (x - X) x v about the point X, (3,) kg m^2/s; world axes.
    """

def centred(
    positions: numpy.typing.ArrayLike, masses: numpy.typing.ArrayLike
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    (N, 3) m: the same particles with their centre of mass at the origin of object space.
    """

def kinetic_energy(masses: numpy.typing.ArrayLike, velocities: numpy.typing.ArrayLike) -> float:
    """
    Sum of m v^2 / 2, J.
    """

def momentum(
    masses: numpy.typing.ArrayLike, velocities: numpy.typing.ArrayLike
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    Sum of m v, (3,) kg m/s.
    """

def net_wrench(
    forces: numpy.typing.ArrayLike, positions: numpy.typing.ArrayLike, about: numpy.typing.ArrayLike
) -> tuple[
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
]:
    """
    (force (3,) N, torque (3,) N m about the point) of forces (N, 3) at positions (N, 3).
    """

def to_object(
    positions: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    p = R^T (x - X), the inverse of to_world.
    """

def to_world(
    positions: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    x = R p + X. positions: (N, 3) m; pose: (7,) x y z qx qy qz qw.
    """

def velocities(
    positions: numpy.typing.ArrayLike,
    centre: numpy.typing.ArrayLike,
    velocity: numpy.typing.ArrayLike,
    angular_velocity: numpy.typing.ArrayLike,
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    v = omega x (x - X) + V, (N, 3) m/s. positions: (N, 3) m, world; centre: (3,) m.
    """
