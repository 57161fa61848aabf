# SPDX-License-Identifier: Apache-2.0
# Written by cpp/bindings/make_stubs.
"""
Moving boxes, and a mesh without an index.
"""

from __future__ import annotations

import typing

import numpy
import numpy.typing

__all__: list[str] = ["AllFaces", "BoxTree"]

class AllFaces:
    """
    No index: every query looks at every face. What Bvh and HashGrid are held against.
    """
    def __init__(
        self,
        vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        faces: numpy.ndarray,
    ) -> None: ...
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
    def face_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int:
        """
        bytes held by the index
        """

class BoxTree:
    """
    Overlapping pairs among boxes that move a little from step to step.
    """
    def __init__(self) -> None: ...
    def __len__(self) -> int: ...
    def crossed(
        self,
        start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        end: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
    ) -> numpy.typing.NDArray[numpy.int32]:
        """
        Rows of the boxes a segment may touch, ascending.
        """
    def overlaps(
        self,
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
    ) -> numpy.typing.NDArray[numpy.int32]:
        """
        Rows of the boxes that overlap one box, ascending.
        """
    def update(
        self,
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        moves: typing.Any = None,
    ) -> numpy.typing.NDArray[numpy.int32]:
        """
        Takes the boxes of this step, (N, 3) m, infinite bounds allowed; moves: (N,) bool, all if None; two static boxes are no pair.
        Returns (K, 2) rows a < b, ascending.
        """
