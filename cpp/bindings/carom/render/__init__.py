# SPDX-License-Identifier: Apache-2.0
"""Pictures of a scene without a window or a graphics card: rasterised and shaded in numpy."""

from carom.render.picture import render, require_packages, save

__all__ = ["render", "require_packages", "save"]
