# SPDX-License-Identifier: Apache-2.0
"""Flight of one body without force or torque, by any of METHODS."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import _core
from carom._core import METHODS

__all__ = ["METHODS", "FreeFlight", "integrate_free"]


class FreeFlight(tuple):
    """The pair (orientation, angular_velocity) at the end of a flight, and how it went.

    Attributes:
        orientation: (4,) x y z w, body frame to world.
        angular_velocity: (3,) rad/s, world axes.
        status: "ok"; "clamped" (a square-root step beyond |dt w| = 2); "iteration_cap";
            "step_cap"; "below_rounding" (the tolerance is below what double precision allows here).
        error: estimate of the orientation's error, rad; None where the method gives none.
        steps: how many were taken.
    """

    status: str
    error: float | None
    steps: int

    def __new__(
        cls,
        orientation: NDArray[np.float64],
        angular_velocity: NDArray[np.float64],
        status: str,
        error: float,
        steps: int,
    ) -> FreeFlight:
        self = super().__new__(cls, (orientation, angular_velocity))
        self.status = status
        self.error = None if math.isnan(error) else error
        self.steps = steps
        return self

    def __getnewargs__(self):
        error = math.nan if self.error is None else self.error
        return (self[0], self[1], self.status, error, self.steps)

    @property
    def orientation(self) -> NDArray[np.float64]:
        return self[0]

    @property
    def angular_velocity(self) -> NDArray[np.float64]:
        return self[1]

    def __repr__(self) -> str:
        return (
            f"FreeFlight(orientation={self[0]}, angular_velocity={self[1]}, "
            f"status={self.status!r}, error={self.error}, steps={self.steps})"
        )


def integrate_free(
    mass_properties: _core.MassProperties,
    orientation: ArrayLike,
    angular_velocity: ArrayLike,
    seconds: float,
    steps: int = 1,
    method: str = "symmetric_top",
    tolerance: float | None = None,
) -> FreeFlight:
    """Turn a body that no torque acts on; gravity changes nothing here.

    Args:
        mass_properties: of the body, any centre of mass, any inertia a body can have.
        orientation: (4,) x y z w, unit, body frame to world.
        angular_velocity: (3,) rad/s, world axes.
        seconds: s; negative flies backwards.
        steps: equal steps, at least 1; "taylor" takes at least as many, "exact" needs none.
        method: one of METHODS.
        tolerance: rad, of the final orientation. Fixed-step methods double their steps until two
            tries agree to it; "taylor" aims at it (1e-12 where none is given). The result's status
            says "below_rounding" where double precision cannot reach it.

    Returns:
        The pair (orientation, angular_velocity) at the end, with attributes status, error, steps.

    Raises:
        ValueError: naming the argument, its value, the rule and the remedy.

    Example:
        >>> q, w = integrate_free(MassProperties.box([1, 2, 3], density=1),
        ...                       [0, 0, 0, 1], [0.1, 5, 0.1], seconds=10, method="exact")
    """
    return FreeFlight(
        *_core.integrate_free(
            mass_properties, orientation, angular_velocity, seconds, steps, method, tolerance
        )
    )
