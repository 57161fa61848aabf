# SPDX-License-Identifier: Apache-2.0
# Written by cpp/bindings/make_stubs.
"""
Continuous collision of moving triangles and edges.
"""

from __future__ import annotations

import collections.abc
import typing

import numpy
import numpy.typing

__all__: list[str] = [
    "Feature",
    "Hits",
    "RootStatus",
    "Roots",
    "Status",
    "SweepResult",
    "SweepStatus",
    "SweptBody",
    "cubic_roots",
    "edge_edge",
    "point_triangle",
    "sweep",
]

class Status:
    """
    How a query was decided.

    Members:

      certified : in doubles, every rounding bounded

      coplanar : exactly; one plane throughout

      exact : exactly, in integers

      conservative : thickness > 0: contact not excluded, reported as a hit
    """

    __members__: typing.ClassVar[dict[str, Status]]
    certified: typing.ClassVar[Status]
    conservative: typing.ClassVar[Status]
    coplanar: typing.ClassVar[Status]
    exact: typing.ClassVar[Status]
    @typing.overload
    def __eq__(self: Status, other: Status) -> bool: ...
    @typing.overload
    def __eq__(self: Status, other: typing.Any) -> bool: ...
    @typing.overload
    def __ge__(self: Status, other: Status) -> bool: ...
    @typing.overload
    def __ge__(self: Status, other: typing.Any) -> None: ...
    def __getstate__(self) -> int: ...
    @typing.overload
    def __gt__(self: Status, other: Status) -> bool: ...
    @typing.overload
    def __gt__(self: Status, other: typing.Any) -> None: ...
    def __hash__(self) -> int: ...
    def __index__(self: Status) -> int: ...
    def __init__(self: Status, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self: Status) -> int: ...
    @typing.overload
    def __le__(self: Status, other: Status) -> bool: ...
    @typing.overload
    def __le__(self: Status, other: typing.Any) -> None: ...
    @typing.overload
    def __lt__(self: Status, other: Status) -> bool: ...
    @typing.overload
    def __lt__(self: Status, other: typing.Any) -> None: ...
    @typing.overload
    def __ne__(self: Status, other: Status) -> bool: ...
    @typing.overload
    def __ne__(self: Status, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self: Status, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class RootStatus:
    """
    How a root search ended.

    Members:

      converged

      cap

      stagnated

      zero_polynomial
    """

    __members__: typing.ClassVar[dict[str, RootStatus]]
    cap: typing.ClassVar[RootStatus]
    converged: typing.ClassVar[RootStatus]
    stagnated: typing.ClassVar[RootStatus]
    zero_polynomial: typing.ClassVar[RootStatus]
    @typing.overload
    def __eq__(self: RootStatus, other: RootStatus) -> bool: ...
    @typing.overload
    def __eq__(self: RootStatus, other: typing.Any) -> bool: ...
    @typing.overload
    def __ge__(self: RootStatus, other: RootStatus) -> bool: ...
    @typing.overload
    def __ge__(self: RootStatus, other: typing.Any) -> None: ...
    def __getstate__(self) -> int: ...
    @typing.overload
    def __gt__(self: RootStatus, other: RootStatus) -> bool: ...
    @typing.overload
    def __gt__(self: RootStatus, other: typing.Any) -> None: ...
    def __hash__(self) -> int: ...
    def __index__(self: RootStatus) -> int: ...
    def __init__(self: RootStatus, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self: RootStatus) -> int: ...
    @typing.overload
    def __le__(self: RootStatus, other: RootStatus) -> bool: ...
    @typing.overload
    def __le__(self: RootStatus, other: typing.Any) -> None: ...
    @typing.overload
    def __lt__(self: RootStatus, other: RootStatus) -> bool: ...
    @typing.overload
    def __lt__(self: RootStatus, other: typing.Any) -> None: ...
    @typing.overload
    def __ne__(self: RootStatus, other: RootStatus) -> bool: ...
    @typing.overload
    def __ne__(self: RootStatus, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(
        self: RootStatus, state: typing.SupportsInt | typing.SupportsIndex
    ) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Hits:
    """
    Answers, one row per query.
    """
    @property
    def hit(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        (N,) bool
        """
    @property
    def status(self) -> numpy.typing.NDArray[numpy.uint8]:
        """
        (N,) uint8 of ccd.Status
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,) fraction of the step, 1.0 where none
        """

class Roots:
    """
    Unpacks as roots, status.
    """
    def __iter__(self: Roots) -> collections.abc.Iterator: ...
    @property
    def iterations(self) -> numpy.typing.NDArray[numpy.int32]:
        """
        (N,) function values spent on brackets
        """
    @property
    def roots(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, 3) ascending, a multiple root once, NaN-padded
        """
    @property
    def status(self) -> numpy.typing.NDArray[numpy.uint8]:
        """
        (N,) uint8 of ccd.RootStatus
        """

class SweepStatus:
    """
    How a sweep ended.

    Members:

      separated : certified: farther than thickness

      contact : distance <= thickness + tolerance within 1e-9 of the step after time

      interval_limit : certified only up to time
    """

    __members__: typing.ClassVar[dict[str, SweepStatus]]
    contact: typing.ClassVar[SweepStatus]
    interval_limit: typing.ClassVar[SweepStatus]
    separated: typing.ClassVar[SweepStatus]
    @typing.overload
    def __eq__(self: SweepStatus, other: SweepStatus) -> bool: ...
    @typing.overload
    def __eq__(self: SweepStatus, other: typing.Any) -> bool: ...
    @typing.overload
    def __ge__(self: SweepStatus, other: SweepStatus) -> bool: ...
    @typing.overload
    def __ge__(self: SweepStatus, other: typing.Any) -> None: ...
    def __getstate__(self) -> int: ...
    @typing.overload
    def __gt__(self: SweepStatus, other: SweepStatus) -> bool: ...
    @typing.overload
    def __gt__(self: SweepStatus, other: typing.Any) -> None: ...
    def __hash__(self) -> int: ...
    def __index__(self: SweepStatus) -> int: ...
    def __init__(self: SweepStatus, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self: SweepStatus) -> int: ...
    @typing.overload
    def __le__(self: SweepStatus, other: SweepStatus) -> bool: ...
    @typing.overload
    def __le__(self: SweepStatus, other: typing.Any) -> None: ...
    @typing.overload
    def __lt__(self: SweepStatus, other: SweepStatus) -> bool: ...
    @typing.overload
    def __lt__(self: SweepStatus, other: typing.Any) -> None: ...
    @typing.overload
    def __ne__(self: SweepStatus, other: SweepStatus) -> bool: ...
    @typing.overload
    def __ne__(self: SweepStatus, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(
        self: SweepStatus, state: typing.SupportsInt | typing.SupportsIndex
    ) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Feature:
    """
    Which features met.

    Members:

      none

      vertex_face

      face_vertex

      edge_edge

      edge_face : at time 0: an edge is through a face

      face_edge
    """

    __members__: typing.ClassVar[dict[str, Feature]]
    edge_edge: typing.ClassVar[Feature]
    edge_face: typing.ClassVar[Feature]
    face_edge: typing.ClassVar[Feature]
    face_vertex: typing.ClassVar[Feature]
    none: typing.ClassVar[Feature]
    vertex_face: typing.ClassVar[Feature]
    @typing.overload
    def __eq__(self: Feature, other: Feature) -> bool: ...
    @typing.overload
    def __eq__(self: Feature, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self: Feature) -> int: ...
    def __init__(self: Feature, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self: Feature) -> int: ...
    @typing.overload
    def __ne__(self: Feature, other: Feature) -> bool: ...
    @typing.overload
    def __ne__(self: Feature, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self: Feature, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SweptBody:
    """
    A body moving rigidly over one step.
    """
    def __init__(
        self: SweptBody,
        vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 3]"],
        faces: typing.Annotated[numpy.typing.ArrayLike, numpy.int32, "[m, 3]"] | None = None,
        edges: typing.Annotated[numpy.typing.ArrayLike, numpy.int32, "[m, 2]"] | None = None,
        *,
        position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        orientation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 1]"] = ...,
        displacement: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
    ) -> None:
        """
        vertices: (N, 3) m, relative to the centre of rotation. faces: (F, 3). edges: (E, 2),
        those of the faces unless given; a rod is two vertices and one edge.
        position, orientation (x y z w): at the start. displacement: (3,) m over the step.
        rotation: (3,) rad over the step, world axes.
        """

class SweepResult:
    @property
    def a(self) -> int:
        """
        vertex, face or edge of the first body; -1 for none
        """
    @property
    def b(self) -> int:
        """
        vertex, face or edge of the second body; -1 for none
        """
    @property
    def intervals(self) -> int:
        """
        chords tried
        """
    @property
    def kind(self) -> Feature:
        """
        ccd.Feature
        """
    @property
    def queries(self) -> int:
        """
        continuous queries spent
        """
    @property
    def status(self) -> SweepStatus: ...
    @property
    def time(self) -> float:
        """
        no contact before this fraction of the step
        """

def cubic_roots(
    coefficients: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    *,
    method: str = "exact",
    max_iterations: typing.SupportsInt | typing.SupportsIndex = 64,
) -> Roots:
    """
    Real roots in [0, 1] of cubics, by the lecture's route: derivative's quadratic, extrema,
    brackets, secant and bisection.

    coefficients: (N, 4), ascending powers. method: "exact" decides every sign exactly, so
    the number of roots is right; "lecture" is the plain double version.
    Returns Roots: roots (N, 3) ascending, a multiple root once, padded with NaN (all NaN for
    the zero polynomial); status (N,) of ccd.RootStatus; iterations (N,). Unpacks as
    roots, status.
    """

def edge_edge(
    queries: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    *,
    thickness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    method: str = "certified",
) -> Hits:
    """
    Do two moving segments meet, and when first?
    queries: (N, 8, 3) float64, m: four points at the start of the step, then the same four at its
        end; each moves on a straight line. Order: a0, a1, b0, b1.
    thickness: m, >= 0. A hit: distance <= thickness at some time.
    method: "certified" (no miss, no false alarm), or "lecture" and "tolerance", the plain double
        methods it is measured against.

    Returns Hits: hit (N,) bool; time (N,) in [0, 1], never later than the first contact and within
    1e-9 of it, 1.0 where none; status (N,) uint8 of ccd.Status.
    Raises ValueError for coordinates that are not finite.
    """

def point_triangle(
    queries: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    *,
    thickness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    method: str = "certified",
) -> Hits:
    """
    Does a moving point meet a moving triangle, and when first?
    queries: (N, 8, 3) float64, m: four points at the start of the step, then the same four at its
        end; each moves on a straight line. Order: point, a, b, c.
    thickness: m, >= 0. A hit: distance <= thickness at some time.
    method: "certified" (no miss, no false alarm), or "lecture" and "tolerance", the plain double
        methods it is measured against.

    Returns Hits: hit (N,) bool; time (N,) in [0, 1], never later than the first contact and within
    1e-9 of it, 1.0 where none; status (N,) uint8 of ccd.Status.
    Raises ValueError for coordinates that are not finite.
    """

def sweep(
    a: SweptBody,
    b: SweptBody,
    *,
    thickness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
    max_intervals: typing.SupportsInt | typing.SupportsIndex = 4096,
) -> SweepResult:
    """
    First contact of two rigidly moving surfaces, rotation included: never a miss; a false
    alarm only below thickness + tolerance (m). Time is never later than the first contact.
    """
