# SPDX-License-Identifier: Apache-2.0
"""Pairs among moving boxes, and queries of a mesh without an index to hold others against."""

from carom._core.broad import AllFaces, BoxTree

__all__ = ["AllFaces", "BoxTree"]
