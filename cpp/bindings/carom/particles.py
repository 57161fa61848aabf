# SPDX-License-Identifier: Apache-2.0
"""A body as the particles it is made of: where they are, how fast, and what they add up to.

Arrays are (N, 3), one row per particle; masses are (N,). `MassProperties.particles` gives the rigid
body they form.
"""

from carom._core.particles import (
    angular_momentum,
    centred,
    kinetic_energy,
    momentum,
    net_wrench,
    to_object,
    to_world,
    velocities,
)

__all__ = [
    "angular_momentum",
    "centred",
    "kinetic_energy",
    "momentum",
    "net_wrench",
    "to_object",
    "to_world",
    "velocities",
]
