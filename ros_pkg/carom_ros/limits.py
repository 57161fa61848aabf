# SPDX-License-Identifier: Apache-2.0
"""The largest request the node takes from the graph. Each is a choice, with its reason.

They are far beyond any scene the physics can do well, and far below what could stop the node: a
request outside is a slip of units or an attack, and is refused with its reason.
"""

COORDINATE_M = 1e6
"""Doubles resolve 1e-10 m there, so contact distances keep six digits."""

SIZE_MIN_M, SIZE_MAX_M = 1e-4, 1e5
"""Below a tenth of a millimetre the contact margin is as large as the body."""

SPEED_M_S = 1e5
"""Ten times what leaves the Earth's orbit."""

SPIN_RAD_S = 1e5
"""A turbine turns at 1e4 rad/s."""

ACCELERATION = 1e7
"""m/s^2, of a held force: a bullet in its barrel sees 1e6."""

SPIN_UP = 1e8
"""rad/s^2, of a held torque: SPIN_RAD_S within a millisecond."""

MASS_MIN_KG, MASS_MAX_KG = 1e-9, 1e12

WRENCH = 1e12
"""N or N m, for impulses N s or N m s: a kilogram would leave the coordinates in a step."""

TEXT_CHARACTERS = 4096
"""Of a Marker's text. A full set of properties takes about 200."""

SCENE_CHARACTERS = 262_144
"""Of a scene sent over ~/scene: a thousand bodies written out in full."""

YAML_DEPTH, YAML_NODES = 16, 50_000

NAME_CHARACTERS = 64
"""Topic names of a body are built from it, and rmw caps them at about 200."""

MESH_POINTS = 300_000
"""Of a TRIANGLE_LIST: 100,000 triangles, 7 MB a message."""

MESH_FILE_BYTES = 64 * 1024 * 1024

PENDING_REQUESTS = 10_000
"""Waiting for the next step boundary; more than that in one tick is a flood."""

REJECTED_PER_TICK = 100
"""Records published on ~/rejected in one tick: the depth a late joiner gets to see."""

QUATERNION_NORM = 1e-2
"""How far from 1 the norm of an orientation may be: three typed digits give 0.5e-2."""
