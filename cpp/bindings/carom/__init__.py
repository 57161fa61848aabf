# SPDX-License-Identifier: Apache-2.0
"""carom: rigid bodies that never pass through each other, with the error and the price told.

    import carom

    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -9.81]))
    scene.add(carom.Plane([0, 0, 1], 0), name="ground", static=True)
    scene.add(carom.Box([0.2, 0.2, 0.2]), name="crate", position=[0, 0, 1])

    simulation = carom.Simulation(scene, dt=1 / 240)
    report = simulation.advance(2.0)
    print(simulation.poses()[1])  # x y z qx qy qz qw

SI units throughout; arrays are float64, one row per body in the order added; quaternions are
x y z w. Input that cannot be used raises InvalidInput, a ValueError.
"""

from collections.abc import MutableSequence

from carom import broad, ccd, particles
from carom._core import (
    AppliedWrench,
    Body,
    Box,
    Bvh,
    Capsule,
    Compound,
    Cone,
    ContactReport,
    ConvexHull,
    Cylinder,
    EffectInfo,
    EffectList,
    Ellipsoid,
    Energy,
    HashGrid,
    HeightField,
    LinearDrag,
    MassProperties,
    Mesh,
    MeshDiagnosis,
    Part,
    Particles,
    Plan,
    Plane,
    PlannedStage,
    Report,
    Repulsion,
    RepulsionReport,
    RotationReport,
    SamplingError,
    Scene,
    Sdf,
    Simulation,
    Sphere,
    StageTime,
    SweepReport,
    TorsionSpring,
    UniformGravity,
    __version__,
    closest_points,
    collide,
    compile,
    diagnose_mesh,
    effects_table,
    mend_mesh,
)
from carom.errors import InvalidInput, MissingDependency
from carom.free_flight import METHODS, FreeFlight, integrate_free
from carom.plan import Stage

MutableSequence.register(EffectList)

__all__ = [
    "METHODS",
    "AppliedWrench",
    "Body",
    "Box",
    "Bvh",
    "Capsule",
    "Compound",
    "Cone",
    "ContactReport",
    "ConvexHull",
    "Cylinder",
    "EffectInfo",
    "EffectList",
    "Ellipsoid",
    "Energy",
    "FreeFlight",
    "HashGrid",
    "HeightField",
    "InvalidInput",
    "LinearDrag",
    "MassProperties",
    "Mesh",
    "MeshDiagnosis",
    "MissingDependency",
    "Part",
    "Particles",
    "Plan",
    "Plane",
    "PlannedStage",
    "Report",
    "Repulsion",
    "RepulsionReport",
    "RotationReport",
    "SamplingError",
    "Scene",
    "Sdf",
    "Simulation",
    "Sphere",
    "Stage",
    "StageTime",
    "SweepReport",
    "TorsionSpring",
    "UniformGravity",
    "__version__",
    "broad",
    "ccd",
    "closest_points",
    "collide",
    "compile",
    "diagnose_mesh",
    "effects_table",
    "integrate_free",
    "mend_mesh",
    "particles",
]
