# SPDX-License-Identifier: Apache-2.0
"""Continuous collision of moving triangles and edges: no miss, no false alarm, at any scale."""

from carom._core.ccd import (
    Feature,
    Hits,
    Roots,
    RootStatus,
    Status,
    SweepResult,
    SweepStatus,
    SweptBody,
    cubic_roots,
    edge_edge,
    point_triangle,
    sweep,
)

__all__ = [
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
