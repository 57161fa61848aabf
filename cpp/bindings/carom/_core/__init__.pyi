# SPDX-License-Identifier: Apache-2.0
# Written by cpp/bindings/make_stubs.
"""
The C++ core of carom. Import the package `carom`, not this module.
"""

from __future__ import annotations

import collections.abc
import typing

import numpy
import numpy.typing

import carom.plan
from carom._core import ccd

from . import broad, particles

__all__: list[str] = [
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
    "HashGrid",
    "HeightField",
    "LinearDrag",
    "MassProperties",
    "Mesh",
    "MeshDiagnosis",
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
    "StageTime",
    "SweepReport",
    "TorsionSpring",
    "UniformGravity",
    "broad",
    "build_info",
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

class Sphere:
    """
    Ball about the origin of the body frame.
    """
    def __init__(self, radius: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        radius: m, > 0.
        """
    def __repr__(self) -> str: ...
    @property
    def radius(self) -> float:
        """
        m
        """

class Box:
    """
    Box about the origin of the body frame, edges along its axes.
    """
    def __init__(self, extents: numpy.typing.ArrayLike) -> None:
        """
        extents: (3,) full edge lengths, m, each > 0.
        """
    def __repr__(self) -> str: ...
    @property
    def extents(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """

class Plane:
    """
    Half-space: the body is where normal . x <= offset. For static bodies only.
    """
    def __init__(
        self,
        normal: numpy.typing.ArrayLike,
        offset: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None:
        """
        normal: (3,) of any length > 0, points out of the body; offset: m along the unit normal.
        """
    def __repr__(self) -> str: ...
    @property
    def normal(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) as given
        """
    @property
    def offset(self) -> float:
        """
        m
        """

class Mesh:
    """
    Closed triangle mesh; bodies that use one Mesh share its memory.
    """
    @staticmethod
    def load(path: typing.Any, scale: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> Mesh:
        """
        Reads an OBJ, STL or PLY file (and what else trimesh reads); needs carom[mesh].

        scale: m per unit of the file, > 0; 0.001 for a file in millimetres. Warns when the
        result is implausibly large, and repairs nothing silently: see carom.mesh_file.
        """
    def __init__(self, vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike) -> None:
        """
        vertices: (V, 3) m, body frame; faces: (F, 3) vertex indices, counter-clockwise seen
        from outside.
        """
    def __repr__(self) -> str: ...
    @property
    def faces(self) -> numpy.ndarray:
        """
        (F, 3) vertex indices, a view that cannot be written
        """
    @property
    def vertices(self) -> numpy.ndarray:
        """
        (V, 3) m, a view that cannot be written
        """

class Capsule:
    """
    Segment along z, grown by a radius.
    """
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        radius: m, > 0; length: m, >= 0, without the caps.
        """
    def __repr__(self) -> str: ...
    @property
    def length(self) -> float:
        """
        m
        """
    @property
    def radius(self) -> float:
        """
        m
        """

class Cylinder:
    """
    Solid cylinder along z about the origin.
    """
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        radius, length: m, > 0.
        """
    def __repr__(self) -> str: ...
    @property
    def length(self) -> float:
        """
        m
        """
    @property
    def radius(self) -> float:
        """
        m
        """

class Cone:
    """
    Solid cone, apex towards +z; the origin is its centre of mass, a quarter of
    the length above the base.
    """
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        radius of the base, length base to apex: m, > 0.
        """
    def __repr__(self) -> str: ...
    @property
    def length(self) -> float:
        """
        m
        """
    @property
    def radius(self) -> float:
        """
        m
        """

class Ellipsoid:
    """
    Solid ellipsoid about the origin.
    """
    def __init__(self, radii: numpy.typing.ArrayLike) -> None:
        """
        radii: (3,) semi-axes, m, each > 0.
        """
    def __repr__(self) -> str: ...
    @property
    def radii(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """

class ConvexHull:
    """
    Convex hull of points, found once and shared.
    """
    def __init__(self, points: numpy.typing.ArrayLike) -> None:
        """
        points: (N, 3) m, not all in one plane.
        """
    @property
    def faces(self) -> numpy.ndarray:
        """
        (F, 3) vertex indices
        """
    @property
    def vertices(self) -> numpy.ndarray:
        """
        (V, 3) m, the corners of the hull
        """

class Sdf:
    """
    Body given by the signed distance to its surface on a grid.
    """
    @staticmethod
    def from_function(
        distance: collections.abc.Callable,
        lower: numpy.typing.ArrayLike,
        upper: numpy.typing.ArrayLike,
        spacing: typing.SupportsFloat | typing.SupportsIndex,
    ) -> Sdf:
        """
        distance: takes a point, (3,) m, gives its signed distance, m, negative inside; lower,
        upper: (3,) m, a box that holds the body; spacing: cell size, m, > 0.
        """
    def __init__(self, mesh: Mesh, spacing: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        mesh: closed; spacing: cell size, m, > 0.
        """
    @property
    def error(self) -> float:
        """
        m, largest error met at the centres of cells near the surface
        """
    @property
    def faces(self) -> numpy.ndarray:
        """
        (F, 3) vertex indices
        """
    @property
    def spacing(self) -> float:
        """
        m, cell size
        """
    @property
    def vertices(self) -> numpy.ndarray:
        """
        (V, 3) m, of the surface where the distance is zero
        """

class HeightField:
    """
    Terrain over a grid, solid below. Static only.
    """
    def __init__(
        self,
        heights: typing.Annotated[
            numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"
        ],
        spacing: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        heights: (rows, columns) m, row i at y = i * spacing, column j at x = j * spacing.
        """
    @property
    def heights(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (rows, columns) m
        """
    @property
    def spacing(self) -> float:
        """
        m
        """

class Particles:
    """
    Equal balls held together as one body.
    """
    def __init__(
        self, positions: numpy.typing.ArrayLike, radius: typing.SupportsFloat | typing.SupportsIndex
    ) -> None:
        """
        positions: (N, 3) m; radius: m, > 0, of each.
        """
    @property
    def positions(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (N, 3) m
        """
    @property
    def radius(self) -> float:
        """
        m
        """

class Compound:
    """
    Several shapes as one body; overlaps count twice in mass.
    """
    def __init__(self, parts: collections.abc.Sequence[Part]) -> None:
        """
        parts: a list of Part.
        """
    @property
    def parts(self) -> list[Part]:
        """
        copies, in order
        """
    @property
    def size(self) -> int:
        """
        number of parts
        """

class Part:
    """
    A shape at its place in a Compound.
    """
    def __init__(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        position: numpy.typing.ArrayLike = (0.0, 0.0, 0.0),
        orientation: numpy.typing.ArrayLike = (0.0, 0.0, 0.0, 1.0),
    ) -> None:
        """
        position: (3,) m; orientation: (4,) x y z w; in the body frame.
        """
    @property
    def orientation(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        (4,) x y z w
        """
    @property
    def position(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def shape(
        self,
    ) -> (
        Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound
    ): ...

class SamplingError:
    """
    One standard error of each number of a sampled body.
    """
    def __getstate__(
        self,
    ) -> tuple[
        float,
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"],
        int,
    ]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def com(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) kg m^2
        """
    @property
    def mass(self) -> float:
        """
        kg
        """
    @property
    def samples(self) -> int:
        """
        Points evaluated.
        """

class MassProperties:
    """
    Mass, centre of mass and inertia of a rigid body, in its own frame.

    Made from numbers, which are checked, or by one of the factories; `a + b` is their
    rigid union. SI units; round bodies lie along z.
    """
    @staticmethod
    def box(
        extents: numpy.typing.ArrayLike,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Box about the origin. extents: (3,) full edge lengths, m.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        """
    @staticmethod
    def capsule(
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Capsule along z about the origin. radius: m; length: m, without the caps, >= 0.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        """
    @staticmethod
    def combined(parts: collections.abc.Sequence[MassProperties]) -> MassProperties:
        """
        Union of any number of bodies given in one frame, by the parallel-axis theorem. Unlike a
        chain of +, the order of the parts changes no digit above 1e-15.
        """
    @staticmethod
    def cone(
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
        caps: bool = True,
    ) -> MassProperties:
        """
        Cone along z, apex at 3/4 of the length: the origin is the solid's centre of mass.
        radius, length: m.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        caps: whether the flat ends belong to the skin.
        """
    @staticmethod
    def cylinder(
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
        caps: bool = True,
    ) -> MassProperties:
        """
        Cylinder along z about the origin. radius, length: m.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        caps: whether the flat ends belong to the skin.
        """
    @staticmethod
    def disc(
        radius: typing.SupportsFloat | typing.SupportsIndex,
        mass: typing.SupportsFloat | typing.SupportsIndex,
    ) -> MassProperties:
        """
        Thin disc in the plane z = 0. radius: m; mass: kg.
        """
    @staticmethod
    def ellipsoid(
        radii: numpy.typing.ArrayLike,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Ellipsoid about the origin. radii: (3,) semi-axes, m. As a shell it is of one thickness
        everywhere.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        """
    @staticmethod
    def hemisphere(
        radius: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
        caps: bool = True,
    ) -> MassProperties:
        """
        Half a ball above z = 0, its flat face in that plane. radius: m.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        caps: whether the flat ends belong to the skin.
        """
    @staticmethod
    def hollow_sphere(
        inner_radius: typing.SupportsFloat | typing.SupportsIndex,
        outer_radius: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Ball with a hollow about its centre; sizes in m, inner < outer.
        """
    @staticmethod
    def mesh(
        vertices: numpy.typing.ArrayLike,
        faces: numpy.typing.ArrayLike,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Closed triangle mesh, exact for the mesh. vertices: (V, 3) m; faces: (F, 3).
        Wrong winding is mended and said in `.warnings`, as are cavities, crossings and
        copies; an open mesh is refused, unless as a shell.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        """
    @staticmethod
    def particles(
        positions: numpy.typing.ArrayLike, masses: numpy.typing.ArrayLike
    ) -> MassProperties:
        """
        Point masses. positions: (N, 3) m; masses: (N,) kg, >= 0. On one line: rank 2; one: rank 0.
        """
    @staticmethod
    def plate(
        x: typing.SupportsFloat | typing.SupportsIndex,
        y: typing.SupportsFloat | typing.SupportsIndex,
        mass: typing.SupportsFloat | typing.SupportsIndex,
    ) -> MassProperties:
        """
        Thin rectangle in the plane z = 0. x, y: full edges, m; mass: kg.
        """
    @staticmethod
    def point(
        position: numpy.typing.ArrayLike, mass: typing.SupportsFloat | typing.SupportsIndex
    ) -> MassProperties:
        """
        One particle: rank 0. position: (3,) m; mass: kg.
        """
    @staticmethod
    def rod(
        length: typing.SupportsFloat | typing.SupportsIndex,
        mass: typing.SupportsFloat | typing.SupportsIndex,
    ) -> MassProperties:
        """
        Thin rod along z about the origin: rank 2. length: m; mass: kg.
        """
    @staticmethod
    def sampled(
        inside: collections.abc.Callable,
        lower: numpy.typing.ArrayLike,
        upper: numpy.typing.ArrayLike,
        density: typing.Any = 1000.0,
        samples: typing.SupportsInt | typing.SupportsIndex = 100000,
        stratified: bool = True,
        seed: typing.SupportsInt | typing.SupportsIndex = 0,
        *,
        method: str | None = None,
    ) -> MassProperties:
        """
        Any body, by sampling the box lower..upper ((3,) m) that holds it; `.error` says how well.

        inside: callable (N, 3) -> (N,) bool; density: kg/m^3, or a callable (N, 3) -> (N,), asked
        at points inside only; samples: at most this many points, >= 2; stratified: two points in
        each cell of a grid (error ~ samples^-2/3) instead of independent ones (^-1/2); seed: the
        same points on every machine. method: 'stratified', 'monte_carlo' or 'grid' (cell centres,
        no error estimate) instead of `stratified`.
        """
    @staticmethod
    def sphere(
        radius: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Ball about the origin. radius: m.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        """
    @staticmethod
    def torus(
        major_radius: typing.SupportsFloat | typing.SupportsIndex,
        minor_radius: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        shell: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Ring about z. major_radius: m, to the middle of the tube; minor_radius: m, of the tube, at
        most major_radius.
        density: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.
        shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *
        thickness per m^2, else give mass.
        """
    @staticmethod
    def tube(
        inner_radius: typing.SupportsFloat | typing.SupportsIndex,
        outer_radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> MassProperties:
        """
        Hollow cylinder along z about the origin; sizes in m, inner < outer.
        """
    def __add__(self, arg0: MassProperties) -> MassProperties: ...
    def __getstate__(
        self,
    ) -> tuple[
        float,
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"],
        list[str],
        SamplingError | None,
    ]: ...
    def __init__(
        self,
        mass: typing.SupportsFloat | typing.SupportsIndex,
        com: numpy.typing.ArrayLike,
        inertia: numpy.typing.ArrayLike,
    ) -> None:
        """
        mass: kg, > 0; com: (3,) m; inertia: (3, 3) kg m^2 about com. A tensor no distribution
        of mass has is refused: largest moment above the sum of the other two, or negative.
        """
    def __radd__(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> typing.Any: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def principal(
        self,
    ) -> tuple[
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"],
    ]:
        """
        (moments (3,) ascending in kg m^2, axes (3, 3) a rotation with the axes as columns):
        inertia = axes @ diag(moments) @ axes.T.
        """
    def scaled_to(self, mass: typing.SupportsFloat | typing.SupportsIndex) -> MassProperties:
        """
        The same body with its density scaled until it weighs `mass`, kg.
        """
    def transformed(
        self, rotation: numpy.typing.ArrayLike, translation: numpy.typing.ArrayLike
    ) -> MassProperties:
        """
        The same body seen from another frame: x_new = rotation @ x + translation.

        rotation: (3, 3), a reflection is refused; translation: (3,) m.
        """
    @property
    def com(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def error(self) -> SamplingError | None:
        """
        SamplingError, or None where nothing was sampled.
        """
    @property
    def inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) kg m^2, about com, axes of the body frame
        """
    @property
    def inverse_inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) 1/(kg m^2), the pseudo-inverse: zero about axes nothing resists
        """
    @property
    def mass(self) -> float:
        """
        kg
        """
    @property
    def rank(self) -> int:
        """
        How many axes resist rotation: 3 a solid, 2 a rod, 0 a point.
        """
    @property
    def warnings(self) -> list[str]:
        """
        What is legal but odd, one sentence each.
        """

class MeshDiagnosis:
    """
    What is odd about a triangle mesh as the boundary of a solid.
    """
    def __repr__(self) -> str: ...
    @property
    def cavities(self) -> int:
        """
        Closed parts that bound a hole.
        """
    @property
    def closed(self) -> bool: ...
    @property
    def components(self) -> int:
        """
        Parts joined over edges.
        """
    @property
    def crossings(self) -> int:
        """
        Pairs of faces that pass through each other.
        """
    @property
    def degenerate_faces(self) -> int:
        """
        Faces that use a corner twice.
        """
    @property
    def duplicate_faces(self) -> int:
        """
        Copies of a face.
        """
    @property
    def findings(self) -> list[str]:
        """
        One sentence each.
        """
    @property
    def inverted(self) -> int:
        """
        Closed parts that were inside out.
        """
    @property
    def mixed_edges(self) -> int:
        """
        Edges along which two faces run the same way.
        """
    @property
    def nested(self) -> int:
        """
        Closed parts inside the solid of another.
        """
    @property
    def non_manifold_edges(self) -> int:
        """
        Edges of four or more faces.
        """
    @property
    def open_edges(self) -> int:
        """
        Edges with a face on one side only.
        """
    @property
    def orientable(self) -> bool:
        """
        False for a surface with one side.
        """
    @property
    def volume(self) -> float:
        """
        m^3, of the mended mesh; 0 while open.
        """

class UniformGravity:
    """
    Constant acceleration of every moving body; energy -m g . x.
    """
    def __init__(self, acceleration: numpy.typing.ArrayLike = (0, 0, -9.81)) -> None:
        """
        acceleration: (3,) m/s^2, world axes.
        """
    def __repr__(self) -> str: ...
    @property
    def acceleration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2, world axes
        """

class AppliedWrench:
    """
    Force and torque held on one body; its power is booked as work.
    """
    def __init__(
        self,
        body: int,
        force: numpy.typing.ArrayLike = (0, 0, 0),
        torque: numpy.typing.ArrayLike = (0, 0, 0),
        *,
        point_b: numpy.typing.ArrayLike = (0, 0, 0),
        in_body_axes: bool = False,
        until: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> None:
        """
        body: id; force: (3,) N; torque: (3,) N m; point_b: (3,) m from the centre of mass, body
        axes; in_body_axes: force and torque turn with the body; until: s of simulated time.
        """
    def __repr__(self) -> str: ...
    @property
    def body(self) -> int:
        """
        id
        """
    @property
    def force(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) N
        """
    @property
    def in_body_axes(self) -> bool: ...
    @property
    def point_b(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def torque(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) N m
        """
    @property
    def until(self) -> float:
        """
        s of simulated time
        """

class LinearDrag:
    """
    Resistance of the air to motion relative to it: F = -coefficient (v -
    wind), T = -angular_coefficient omega; solved exactly, so never too stiff.
    """
    def __init__(
        self,
        coefficient: typing.SupportsFloat | typing.SupportsIndex,
        wind: numpy.typing.ArrayLike = (0, 0, 0),
        *,
        angular_coefficient: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        body: int | None = None,
    ) -> None:
        """
        coefficient: kg/s; wind: (3,) m/s, world axes; angular_coefficient: N m s; body: id,
        every moving body where none is named.
        """
    def __repr__(self) -> str: ...
    @property
    def angular_coefficient(self) -> float:
        """
        N m s
        """
    @property
    def body(self) -> int | None:
        """
        id, or None for every moving body
        """
    @property
    def coefficient(self) -> float:
        """
        kg/s
        """
    @property
    def wind(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s, world axes
        """

class TorsionSpring:
    """
    Spring that turns a body back to `rest`: T = -stiffness theta -
    damping omega; energy stiffness |theta|^2 / 2.
    """
    def __init__(
        self,
        body: int,
        stiffness: typing.SupportsFloat | typing.SupportsIndex,
        damping: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        *,
        rest: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 1]"] = (0, 0, 0, 1),
    ) -> None:
        """
        body: id; stiffness: N m/rad; damping: N m s; rest: (4,) x y z w, body frame to world.
        """
    def __repr__(self) -> str: ...
    @property
    def body(self) -> int:
        """
        id
        """
    @property
    def damping(self) -> float:
        """
        N m s
        """
    @property
    def rest(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        (4,) x y z w, body frame to world
        """
    @property
    def stiffness(self) -> float:
        """
        N m/rad
        """

class Repulsion:
    """
    The lecture's way out of overlap: speed depth / dt along the normal. It
    puts energy in: see Energy.repulsion and Report.repulsion.
    """
    def __init__(
        self,
        bounded: bool = True,
        cap: typing.SupportsFloat | typing.SupportsIndex = 3.0,
        interior_normals: bool = True,
    ) -> None:
        """
        bounded: give a point only what it lacks of that speed, and never more than leaves it at
        cap, m/s, > 0; interior_normals: take the normals of particles inside distance grids from
        the chain gradient, swept hit, velocity.
        """
    def __repr__(self) -> str: ...
    @property
    def bounded(self) -> bool: ...
    @property
    def cap(self) -> float:
        """
        m/s
        """
    @property
    def interior_normals(self) -> bool: ...

class EffectInfo:
    """
    What there is to know of a kind of effect.
    """
    def __repr__(self) -> str: ...
    @property
    def energy(self) -> str:
        """
        potential energy or power
        """
    @property
    def formula(self) -> str:
        """
        of the force
        """
    @property
    def name(self) -> str:
        """
        as in scene files
        """
    @property
    def stage(self) -> str:
        """
        of the plan
        """
    @property
    def units(self) -> str:
        """
        of the parameters
        """

class Body:
    """
    A body as its scene describes it: a copy, read-only.
    """
    def __repr__(self) -> str: ...
    @property
    def angular_velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) rad/s, world axes, at the start
        """
    @property
    def ccd(self) -> str:
        """
        'auto', 'always' or 'never'
        """
    @property
    def friction(self) -> float: ...
    @property
    def groups(self) -> int:
        """
        bits of the groups it belongs to
        """
    @property
    def id(self) -> int: ...
    @property
    def mass_properties(self) -> MassProperties:
        """
        in the body frame; zero mass for a static body
        """
    @property
    def meets(self) -> int:
        """
        bits of the groups it meets
        """
    @property
    def name(self) -> str: ...
    @property
    def orientation(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        (4,) x y z w, at the start
        """
    @property
    def position(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m, at the start
        """
    @property
    def restitution(self) -> float: ...
    @property
    def rolling_resistance(self) -> float:
        """
        m
        """
    @property
    def shape(
        self,
    ) -> (
        Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound
    ): ...
    @property
    def spinning_resistance(self) -> float:
        """
        m
        """
    @property
    def static(self) -> bool: ...
    @property
    def velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s, of the body frame's origin, at the start
        """

class EffectList:
    """
    The effects of a scene: a list that checks what goes in.
    """
    def __delitem__(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __getitem__(
        self, arg0: typing.SupportsInt | typing.SupportsIndex
    ) -> UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion: ...
    def __iter__(self) -> collections.abc.Iterator: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def __setitem__(
        self,
        arg0: typing.SupportsInt | typing.SupportsIndex,
        arg1: UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion,
    ) -> None: ...
    def append(
        self, effect: UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion
    ) -> None: ...
    def clear(self) -> None: ...
    def extend(
        self,
        effects: collections.abc.Sequence[
            UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion
        ],
    ) -> None: ...
    def insert(
        self,
        index: typing.SupportsInt | typing.SupportsIndex,
        effect: UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion,
    ) -> None: ...
    def pop(
        self, index: typing.SupportsInt | typing.SupportsIndex = -1
    ) -> UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion: ...

class Scene:
    """
    Everything a simulation is told: bodies and effects.
    """
    @staticmethod
    def load(path: typing.Any) -> Scene:
        """
        Reads a scene file (YAML). Raises InvalidInput naming file, line, field and rule.
        """
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, memo: dict) -> Scene: ...
    def __init__(self) -> None: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def add(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        *,
        name: str = "",
        static: bool = False,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        mass_properties: MassProperties | None = None,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        orientation: numpy.typing.ArrayLike = (0, 0, 0, 1),
        velocity: numpy.typing.ArrayLike = (0, 0, 0),
        angular_velocity: numpy.typing.ArrayLike = (0, 0, 0),
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        restitution: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        rolling_resistance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        spinning_resistance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        ccd: str = "auto",
        groups: typing.SupportsInt | typing.SupportsIndex = 1,
        meets: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> int:
        """
        Adds a body and returns its id; ids are never used again.

        shape: any shape of this module; name: unique, letters, digits and _, a letter first
        ('body_<id>' where none is given); static: never moves;
        mass: kg, spread evenly, or density: kg/m^3 (1000 where nothing is given), or
        mass_properties in the body frame;
        position: (3,) m and orientation: (4,) x y z w, of the body frame;
        velocity: (3,) m/s of that frame's origin; angular_velocity: (3,) rad/s; world axes;
        friction: >= 0, a pair uses sqrt(mu1 mu2); restitution: 0 to 1, a pair uses the larger;
        rolling_resistance, spinning_resistance: m, >= 0: torque bounds over the normal force, a pair
        uses the larger;
        ccd: 'auto' follows the body along its path in steps that move it farther than its own
        thickness allows, 'always' in every step, 'never': it may then pass through things;
        groups, meets: bits of the groups the body belongs to and of those it meets: two bodies meet
        where each belongs to a group the other meets; meets 0: nothing touches it.

        Raises InvalidInput (a ValueError) naming the field; nothing has changed then.
        """
    def find(self, name: str) -> int | None:
        """
        Id of the body of that name, or None.
        """
    def never_meet(self, a: int | str, b: int | str) -> None:
        """
        Lets two bodies, by id or name, pass through each other, whatever their groups.
        """
    def remove(self, body: int | str) -> None:
        """
        Takes a body out by id or name; the rows after it close up.
        """
    @property
    def bodies(self) -> list[Body]:
        """
        Copies of the bodies, in the order of rows.
        """
    @property
    def effects(self) -> EffectList:
        """
        What acts on the bodies: a list to append to.
        """
    @effects.setter
    def effects(
        self,
        arg1: collections.abc.Sequence[
            UniformGravity | AppliedWrench | LinearDrag | TorsionSpring | Repulsion
        ],
    ) -> None: ...
    @property
    def never(self) -> list[tuple[int, int]]:
        """
        Pairs of ids that never meet.
        """

class PlannedStage:
    """
    One thing a step does, or does not do, and why.
    """
    def __repr__(self) -> str: ...
    @property
    def bodies(self) -> int:
        """
        how many it concerns
        """
    @property
    def on(self) -> bool: ...
    @property
    def reason(self) -> str: ...
    @property
    def stage(self) -> str: ...

class Plan:
    """
    Every stage there is, in the order a step runs them.
    """
    def __str__(self) -> str: ...
    @property
    def movers(self) -> list[int]:
        """
        rows of the bodies that move
        """
    @property
    def stages(self) -> list[PlannedStage]:
        """
        those that are off too, with the reason
        """

class Energy:
    """
    Where the energy is and where it went, J; `balance` is constant up to the
    error of the integration.
    """
    def __repr__(self) -> str: ...
    @property
    def balance(self) -> float:
        """
        J, kinetic + potential + dissipated - work - repulsion
        """
    @property
    def dissipated(self) -> float:
        """
        J, by contacts and friction since the start
        """
    @property
    def kinetic(self) -> float:
        """
        J
        """
    @property
    def potential(self) -> float:
        """
        J
        """
    @property
    def repulsion(self) -> float:
        """
        J, put in by the lecture's repulsion since the start
        """
    @property
    def work(self) -> float:
        """
        J, by applied wrenches and impulses since the start
        """

class ContactReport:
    """
    What contacts did: extremes and sums over the steps of a report.
    """
    def __repr__(self) -> str: ...
    @property
    def asleep(self) -> int:
        """
        bodies at rest without cost
        """
    @property
    def deepest_overlap(self) -> float:
        """
        m, worst seen at a step's start, >= 0
        """
    @property
    def direct_islands(self) -> int:
        """
        of these, solved directly; the others took small steps
        """
    @property
    def gave_up(self) -> int:
        """
        solves that ended above their tolerance
        """
    @property
    def islands(self) -> int:
        """
        in the last step
        """
    @property
    def iterations(self) -> int:
        """
        in all
        """
    @property
    def points(self) -> int:
        """
        in the last step
        """
    @property
    def residual(self) -> float:
        """
        m/s, worst the solver left
        """

class RepulsionReport:
    """
    What the lecture's repulsion did, added up; the first four: where the
    normals of centres inside distance grids came from.
    """
    def __repr__(self) -> str: ...
    @property
    def capped(self) -> int:
        """
        steps that stopped at the cap of sweeps
        """
    @property
    def fastest(self) -> float:
        """
        m/s, largest speed given to a point
        """
    @property
    def gradient(self) -> int:
        """
        of the distance
        """
    @property
    def kept(self) -> int:
        """
        of the step before: inside all along
        """
    @property
    def pushed(self) -> int:
        """
        contact points
        """
    @property
    def stagnated(self) -> int:
        """
        steps that rounding stopped
        """
    @property
    def swept_hit(self) -> int:
        """
        where the path met the surface
        """
    @property
    def velocity(self) -> int:
        """
        opposite of the motion
        """

class RotationReport:
    """
    What turning the bodies took, added up.
    """
    def __repr__(self) -> str: ...
    @property
    def capped(self) -> int:
        """
        bodies too fast for the most sub-steps
        """
    @property
    def clamped(self) -> int:
        """
        square-root steps beyond |dt w| = 2
        """
    @property
    def most_substeps(self) -> int:
        """
        of any body in any step
        """
    @property
    def not_converged(self) -> int:
        """
        implicit or adaptive steps that stopped at their cap
        """

class SweepReport:
    """
    The certificate: what was followed along its path, and what could not
    be followed to the end of a step and waited there. Nothing has passed through
    anything else.
    """
    def __repr__(self) -> str: ...
    @property
    def crossings(self) -> int:
        """
        of these, found to cross
        """
    @property
    def gave_up(self) -> int:
        """
        pairs not certified to the end of a step: query cap met
        """
    @property
    def impacts(self) -> int:
        """
        hits resolved at their time
        """
    @property
    def queries(self) -> int:
        """
        distances that took
        """
    @property
    def smallest_gap(self) -> float:
        """
        m, least separation of swept pairs; negative: overlap, inf where none was
        """
    @property
    def sweeps(self) -> int:
        """
        pairs of paths asked about
        """
    @property
    def swept(self) -> int:
        """
        bodies followed in the last step
        """
    @property
    def time_lost(self) -> float:
        """
        s, that those bodies did not move
        """
    @property
    def verified(self) -> int:
        """
        pairs of ways looked at again, with Simulation(verify=True)
        """
    @property
    def waited(self) -> int:
        """
        bodies stopped for the rest of a step: too many hits, or given up
        """

class StageTime:
    """
    Wall time spent in one stage.
    """
    def __repr__(self) -> str: ...
    @property
    def bodies(self) -> int:
        """
        how many it worked on in the last step
        """
    @property
    def seconds(self) -> float:
        """
        s, wall
        """
    @property
    def stage(self) -> str: ...

class Report:
    """
    What an advance did, how wrong it may be and what it cost.
    """
    def __repr__(self) -> str: ...
    @property
    def contact(self) -> ContactReport: ...
    @property
    def frozen(self) -> list[int]:
        """
        ids of bodies held at their last good pose since their state went non-finite
        """
    @property
    def ok(self) -> bool:
        """
        no body frozen or made to wait, no solve given up
        """
    @property
    def repulsion(self) -> RepulsionReport: ...
    @property
    def rotation(self) -> RotationReport: ...
    @property
    def simulated(self) -> float:
        """
        s, advanced
        """
    @property
    def stages(self) -> list[StageTime]:
        """
        wall time of each stage
        """
    @property
    def steps(self) -> int: ...
    @property
    def sweep(self) -> SweepReport: ...
    @property
    def time(self) -> float:
        """
        s, simulated clock at the end
        """
    @property
    def wall_seconds(self) -> float:
        """
        s
        """

class Simulation:
    """
    Runs the plan of a scene, step by step.
    """
    def __init__(
        self,
        scene: Scene,
        dt: typing.SupportsFloat | typing.SupportsIndex = 0.016666666666666666,
        integrator: str = "symmetric_top",
        *,
        contact_solver: str = "automatic",
        contact_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-07,
        substeps: typing.SupportsInt | typing.SupportsIndex = 0,
        sleep_after: typing.SupportsFloat | typing.SupportsIndex = ...,
        verify: bool = False,
        threads: typing.SupportsInt | typing.SupportsIndex = 1,
    ) -> None:
        """
        scene: copied, so later changes to it do not reach the simulation; dt: s, > 0, the
        largest step taken; integrator: of rotations, one of METHODS; contact_solver:
        'automatic', 'small_steps' or 'direct'; contact_tolerance: m/s, residual at which the
        direct solver stops; substeps: of the small steps, 0 for as many as the loads ask
        for; sleep_after: s at rest until an island costs nothing, inf for
        never; verify: look at the ways of every step again with exact predicates, see
        report.sweep.crossings; slow; threads: 1 to 1024 share the contact solver's work, with
        the same bits whatever their number.
        """
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def add(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        *,
        name: str = "",
        static: bool = False,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        mass_properties: MassProperties | None = None,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        orientation: numpy.typing.ArrayLike = (0, 0, 0, 1),
        velocity: numpy.typing.ArrayLike = (0, 0, 0),
        angular_velocity: numpy.typing.ArrayLike = (0, 0, 0),
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        restitution: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        rolling_resistance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        spinning_resistance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        ccd: str = "auto",
        groups: typing.SupportsInt | typing.SupportsIndex = 1,
        meets: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> int:
        """
        Adds a body and returns its id; ids are never used again.

        shape: any shape of this module; name: unique, letters, digits and _, a letter first
        ('body_<id>' where none is given); static: never moves;
        mass: kg, spread evenly, or density: kg/m^3 (1000 where nothing is given), or
        mass_properties in the body frame;
        position: (3,) m and orientation: (4,) x y z w, of the body frame;
        velocity: (3,) m/s of that frame's origin; angular_velocity: (3,) rad/s; world axes;
        friction: >= 0, a pair uses sqrt(mu1 mu2); restitution: 0 to 1, a pair uses the larger;
        rolling_resistance, spinning_resistance: m, >= 0: torque bounds over the normal force, a pair
        uses the larger;
        ccd: 'auto' follows the body along its path in steps that move it farther than its own
        thickness allows, 'always' in every step, 'never': it may then pass through things;
        groups, meets: bits of the groups the body belongs to and of those it meets: two bodies meet
        where each belongs to a group the other meets; meets 0: nothing touches it.

        Raises InvalidInput (a ValueError) naming the field; nothing has changed then.
        """
    def advance(self, seconds: typing.SupportsFloat | typing.SupportsIndex) -> Report:
        """
        Advances by exactly `seconds` of simulated time, in equal steps no longer than dt, and
        reports. Other Python threads run meanwhile.
        """
    def angular_momentum(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) kg m^2/s, about the world origin.
        """
    def apply_angular_impulse(self, body: int | str, impulse: numpy.typing.ArrayLike) -> None:
        """
        With the next step. impulse: (3,) N m s, world axes.
        """
    def apply_force(
        self,
        body: int | str,
        force: numpy.typing.ArrayLike,
        point: numpy.typing.ArrayLike | None = None,
    ) -> None:
        """
        For the next step only. force: (3,) N, world axes; point: (3,) m, world; the centre of
        mass where none is given.
        """
    def apply_impulse(
        self,
        body: int | str,
        impulse: numpy.typing.ArrayLike,
        point: numpy.typing.ArrayLike | None = None,
    ) -> None:
        """
        With the next step. impulse: (3,) N s, world axes; point: (3,) m, world; the centre of
        mass where none is given.
        """
    def apply_torque(self, body: int | str, torque: numpy.typing.ArrayLike) -> None:
        """
        For the next step only. torque: (3,) N m, world axes.
        """
    def centres(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, 3) centres of mass, m.
        """
    def closest(
        self,
        points: numpy.typing.ArrayLike,
        reach: typing.SupportsFloat | typing.SupportsIndex = ...,
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> tuple[
        numpy.typing.NDArray[numpy.float64],
        numpy.typing.NDArray[numpy.int32],
        numpy.typing.NDArray[numpy.float64],
    ]:
        """
        Nearest body to each point (N, 3), no farther than reach m: distance (N,) m, negative
        inside, inf for none; row (N,), -1 for none; point (N, 3) on the body.
        """
    def closest_to_shape(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        positions: numpy.typing.ArrayLike,
        orientations: numpy.typing.ArrayLike = (0, 0, 0, 1),
        reach: typing.SupportsFloat | typing.SupportsIndex = ...,
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> tuple[
        numpy.typing.NDArray[numpy.float64],
        numpy.typing.NDArray[numpy.int32],
        numpy.typing.NDArray[numpy.float64],
        numpy.typing.NDArray[numpy.float64],
    ]:
        """
        Nearest body to a shape where it is placed, no farther than reach m. positions: (N, 3) m;
        orientations: (N, 4) x y z w, or (4,) for all. Returns distance (N,) m, negative where they
        overlap, inf for none; row (N,), -1 for none; the nearest points on body and shape, (N, 3).
        """
    def contacts(self) -> numpy.ndarray:
        """
        Contact points of the last step, a structured array: a, b (rows), position (m, world),
        normal (unit, from a to b), separation (m, < 0: overlap, at the start of the step),
        impulse (N s, on b), friction and restitution of the pair.
        """
    def contacts_of(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        positions: numpy.typing.ArrayLike,
        orientations: numpy.typing.ArrayLike = (0, 0, 0, 1),
        margin: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> numpy.ndarray:
        """
        Contacts a shape would have where it is placed: positions (N, 3) m, orientations (N, 4)
        x y z w, or (4,) for all; margin: m, points farther apart are left out. A structured array,
        one row a point: query (which placing), row (of the body), manifold (number within the
        placing), position (m, world), normal (unit, from the body to the shape), separation (m,
        negative: overlap), feature (names the meeting features).
        """
    def energy(self) -> Energy:
        """
        The energy ledger, J.
        """
    def hold_wrench(
        self,
        body: int | str,
        force: numpy.typing.ArrayLike = (0, 0, 0),
        torque: numpy.typing.ArrayLike = (0, 0, 0),
        *,
        point_b: numpy.typing.ArrayLike = (0, 0, 0),
        in_body_axes: bool = False,
        until: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> None:
        """
        Holds force (3,) N and torque (3,) N m on a body until replaced or until `until`, s of
        simulated time; all zeros clears it. point_b: (3,) m from the centre of mass, body axes;
        in_body_axes: force and torque turn with the body.
        """
    def ids(self) -> numpy.typing.NDArray[numpy.uint32]:
        """
        (N,) id of the body in each row.
        """
    def momentum(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) kg m/s, of all moving bodies.
        """
    def names(self) -> list[str]:
        """
        Name of the body in each row.
        """
    def overlaps(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        positions: numpy.typing.ArrayLike,
        orientations: numpy.typing.ArrayLike = (0, 0, 0, 1),
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> tuple[numpy.typing.NDArray[numpy.int64], numpy.typing.NDArray[numpy.int32]]:
        """
        Bodies that a shape touches where it is placed. positions: (N, 3) m; orientations: (N, 4)
        x y z w, or (4,) for all. Returns offsets (N + 1,) and rows: those of placing i are
        rows[offsets[i]:offsets[i + 1]], ascending.
        """
    def plan(self, off: bool = False) -> list[carom.plan.Stage]:
        """
        What a step runs, in order: named tuples (stage, reason, bodies, seconds), seconds being
        the wall time spent so far. With off=True those that are off as well, with the reason.
        """
    def poses(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, 7) x y z qx qy qz qw of each body frame, m; row i is body i in the order added.
        """
    def raycast(
        self,
        origins: numpy.typing.ArrayLike,
        directions: numpy.typing.ArrayLike,
        max_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> tuple:
        """
        First body along each ray. origins, directions: (N, 3) m, directions of any length > 0;
        max_distance: m; groups: bits, only bodies of these groups are asked.
        Returns distance (N,) m (inf where none), row (N,) of the body (-1), normal (N, 3).
        """
    def remove(self, body: int | str) -> None:
        """
        Takes a body out by id or name; rows close up, ids are never used again.
        """
    def restore(self, bytes: str) -> None:
        """
        Back to a saved state; the same bits follow from there.
        """
    def row(self, body: int | str) -> int:
        """
        Row of a body, by id or name.
        """
    def save(self) -> bytes:
        """
        All that steps depend on, as bytes for this same build.
        """
    def segments(
        self,
        starts: numpy.typing.ArrayLike,
        ends: numpy.typing.ArrayLike,
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> tuple:
        """
        First body along each segment. starts, ends: (N, 3) m. Returns fraction (N,) of the way, 0
        to 1 (inf where none), row (N,) of the body (-1), normal (N, 3).
        """
    def set_state(
        self,
        body: int | str,
        *,
        position: numpy.typing.ArrayLike | None = None,
        orientation: numpy.typing.ArrayLike | None = None,
        velocity: numpy.typing.ArrayLike | None = None,
        angular_velocity: numpy.typing.ArrayLike | None = None,
    ) -> None:
        """
        Puts a body somewhere; what is not given stays. position (3,) m, orientation (4,)
        x y z w, velocity (3,) m/s of the body frame's origin, angular_velocity (3,) rad/s.
        """
    def shape_cast(
        self,
        shape: Sphere
        | Box
        | Plane
        | Mesh
        | Capsule
        | Cylinder
        | Cone
        | Ellipsoid
        | ConvexHull
        | Sdf
        | HeightField
        | Particles
        | Compound,
        positions: numpy.typing.ArrayLike,
        directions: numpy.typing.ArrayLike,
        orientations: numpy.typing.ArrayLike = (0, 0, 0, 1),
        max_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
        *,
        groups: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> tuple:
        """
        How far a shape goes without turning until it meets a body. positions, directions: (N, 3)
        m; orientations: (N, 4) x y z w, or (4,) for all. Returns distance (N,) m, never beyond the
        first contact (inf where none), row (N,) (-1), normal (N, 3) out of the body.
        """
    def state_hash(self) -> int:
        """
        64-bit hash of the state: equal bits, equal hash.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex | None = None) -> None:
        """
        Takes exactly one step of dt seconds (the simulation's own where none is given).
        Other Python threads run meanwhile.
        """
    def twists(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, 6) velocity of each body frame's origin, m/s, then angular velocity, rad/s, world axes.
        """
    @property
    def dt(self) -> float:
        """
        s, the largest step taken
        """
    @property
    def report(self) -> Report:
        """
        The Report since the simulation began.
        """
    @property
    def scene(self) -> Scene:
        """
        A copy of the scene as it stands: what was added and removed included.
        """
    @property
    def time(self) -> float:
        """
        s, simulated
        """

class Bvh:
    """
    Bounding volume hierarchy over the faces of a mesh. Answers are those of a loop over all faces in double, whatever volume and quality.
    """
    def __init__(
        self,
        vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        faces: numpy.ndarray,
        volume: str = "box",
        quality: str = "medium",
    ) -> None:
        """
        vertices: (N, 3) m; faces: (M, 3) indices; volume: box, sphere or oriented_box; quality: low (fastest build), medium or high (fastest queries).
        """
    def any_hit(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        max_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether each ray hits anything: (N,) bool.
        """
    def blocked(
        self,
        starts: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        ends: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether anything lies between start and end: (N,) bool.
        """
    def closest(
        self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]
    ) -> tuple[
        numpy.typing.NDArray[numpy.float64],
        numpy.typing.NDArray[numpy.int32],
        numpy.typing.NDArray[numpy.float64],
    ]:
        """
        Nearest point of the mesh to each of (N, 3) points, m.
        Returns distance (N,), face (N,) and point (N, 3).
        """
    def overlaps(
        self,
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.int32]]:
        """
        Faces whose bounding boxes overlap each closed box, (N, 3) m.
        Returns offsets (N + 1,) and faces: those of box i are faces[offsets[i]:offsets[i + 1]], ascending.
        """
    def raycast(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        max_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.int32]]:
        """
        First hit of each ray. origins, directions: (N, 3) m, of any length; max_distance: m, inclusive.
        Returns distance (N,) m, inf for none, and face (N,), -1 for none.
        """
    def refit(self, vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        The same faces with moved vertices, (N, 3) m.
        """
    def segments(
        self,
        starts: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        ends: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.int32]]:
        """
        First hit of each closed segment, (N, 3) m.
        Returns the fraction of the way (N,) in [0, 1], 1 for none, and face (N,), -1 for none.
        """
    def self_pairs(self) -> numpy.typing.NDArray[numpy.int32]:
        """
        Pairs of faces a < b whose bounding boxes overlap, neighbours included: (K, 2), ascending.
        """
    @property
    def depth(self) -> int: ...
    @property
    def face_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int:
        """
        bytes held by the index
        """
    @property
    def node_count(self) -> int: ...
    @property
    def rebuilt_parts(self) -> int: ...

class HashGrid:
    """
    Uniform grid over the faces of a mesh, cells hashed on (i, j, k). Same queries and answers as Bvh.
    """
    def __init__(
        self,
        vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        faces: numpy.ndarray,
        cell_size: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> None:
        """
        vertices: (N, 3) m; faces: (M, 3) indices; cell_size: m, chosen from the faces if None.
        """
    def any_hit(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        max_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether each ray hits anything: (N,) bool.
        """
    def blocked(
        self,
        starts: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        ends: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether anything lies between start and end: (N,) bool.
        """
    def closest(
        self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]
    ) -> tuple[
        numpy.typing.NDArray[numpy.float64],
        numpy.typing.NDArray[numpy.int32],
        numpy.typing.NDArray[numpy.float64],
    ]:
        """
        Nearest point of the mesh to each of (N, 3) points, m.
        Returns distance (N,), face (N,) and point (N, 3).
        """
    def overlaps(
        self,
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.int32]]:
        """
        Faces whose bounding boxes overlap each closed box, (N, 3) m.
        Returns offsets (N + 1,) and faces: those of box i are faces[offsets[i]:offsets[i + 1]], ascending.
        """
    def raycast(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        max_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.int32]]:
        """
        First hit of each ray. origins, directions: (N, 3) m, of any length; max_distance: m, inclusive.
        Returns distance (N,) m, inf for none, and face (N,), -1 for none.
        """
    def segments(
        self,
        starts: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        ends: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.int32]]:
        """
        First hit of each closed segment, (N, 3) m.
        Returns the fraction of the way (N,) in [0, 1], 1 for none, and face (N,), -1 for none.
        """
    def self_pairs(self) -> numpy.typing.NDArray[numpy.int32]:
        """
        Pairs of faces a < b whose bounding boxes overlap, neighbours included: (K, 2), ascending.
        """
    @property
    def cell_count(self) -> int: ...
    @property
    def cell_size(self) -> float:
        """
        m
        """
    @property
    def entry_count(self) -> int: ...
    @property
    def face_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int:
        """
        bytes held by the index
        """

def build_info() -> dict:
    """
    Version, Eigen, compiler and scalar of this build.
    """

def closest_points(
    a: Sphere
    | Box
    | Plane
    | Mesh
    | Capsule
    | Cylinder
    | Cone
    | Ellipsoid
    | ConvexHull
    | Sdf
    | HeightField
    | Particles
    | Compound,
    b: Sphere
    | Box
    | Plane
    | Mesh
    | Capsule
    | Cylinder
    | Cone
    | Ellipsoid
    | ConvexHull
    | Sdf
    | HeightField
    | Particles
    | Compound,
    positions_a: numpy.typing.ArrayLike,
    positions_b: numpy.typing.ArrayLike,
    orientations_a: numpy.typing.ArrayLike = (0, 0, 0, 1),
    orientations_b: numpy.typing.ArrayLike = (0, 0, 0, 1),
    reach: typing.SupportsFloat | typing.SupportsIndex = ...,
) -> tuple[
    numpy.typing.NDArray[numpy.float64],
    numpy.typing.NDArray[numpy.float64],
    numpy.typing.NDArray[numpy.float64],
    numpy.typing.NDArray[numpy.float64],
]:
    """
    Nearest points of two shapes at N pairs of poses, as of `collide`: distance (N,) m, negative
    where they overlap, inf beyond reach; points on a and on b (N, 3) m; normal (N, 3) from a to b.
    """

def collide(
    a: Sphere
    | Box
    | Plane
    | Mesh
    | Capsule
    | Cylinder
    | Cone
    | Ellipsoid
    | ConvexHull
    | Sdf
    | HeightField
    | Particles
    | Compound,
    b: Sphere
    | Box
    | Plane
    | Mesh
    | Capsule
    | Cylinder
    | Cone
    | Ellipsoid
    | ConvexHull
    | Sdf
    | HeightField
    | Particles
    | Compound,
    positions_a: numpy.typing.ArrayLike,
    positions_b: numpy.typing.ArrayLike,
    orientations_a: numpy.typing.ArrayLike = (0, 0, 0, 1),
    orientations_b: numpy.typing.ArrayLike = (0, 0, 0, 1),
    margin: typing.SupportsFloat | typing.SupportsIndex = 0.0,
) -> numpy.ndarray:
    """
    All contacts of two shapes at N pairs of poses: positions (N, 3) m, orientations (N, 4)
    x y z w, or (4,) for all; margin: m, points farther apart are left out. A structured array,
    one row a point: query (which pair of poses), row (-1), manifold (number within the query),
    position (m, world, midway between the surfaces), normal (unit, from a to b), separation (m
    along it, negative: overlap), feature (names the meeting features).
    """

def compile(scene: Scene) -> Plan:
    """
    Decides what a step of this scene must do. Pure: same scene, same plan.
    """

def diagnose_mesh(vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike) -> MeshDiagnosis:
    """
    Finds what is odd about a mesh: open edges, winding, copies, crossings, cavities.

    vertices: (V, 3) m; faces: (F, 3).
    """

def effects_table() -> list[EffectInfo]:
    """
    Every effect there is: name, stage, formula, energy or power, units.
    """

def integrate_free(
    mass_properties: MassProperties,
    orientation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 1]"],
    angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
    seconds: typing.SupportsFloat | typing.SupportsIndex,
    steps: typing.SupportsInt | typing.SupportsIndex,
    method: str,
    tolerance: typing.SupportsFloat | typing.SupportsIndex | None,
) -> tuple[
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
    str,
    float,
    int,
]: ...
def mend_mesh(
    vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike
) -> tuple[
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"],
    typing.Annotated[numpy.typing.NDArray[numpy.int32], "[m, 3]"],
    MeshDiagnosis,
]:
    """
    (vertices, faces, MeshDiagnosis) with corners joined, copies left out and faces turned
    outward (inward about cavities). Open meshes keep their winding.
    """

METHODS: tuple = (
    "lecture_gram_schmidt",
    "lecture_polar",
    "lecture_exponential",
    "lecture_quaternion",
    "lecture_quaternion_sqrt",
    "midpoint",
    "implicit_midpoint",
    "cayley",
    "symmetric_top",
    "symmetric_top_4",
    "taylor",
    "exact",
)
__version__: str = "0.1.0"
