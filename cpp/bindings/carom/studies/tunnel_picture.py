# SPDX-License-Identifier: Apache-2.0
"""The scene `tunnel` before, without and with continuous collision, side by side.

    python -m carom.studies.tunnel_picture cpp/scenes/tunnel.png

Needs carom[plot].
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from carom import Scene, Simulation
from carom.render import require_packages, save
from carom.scene_file import parse
from carom.scenes import scene_path

SECONDS, DT = 0.05, 1 / 60
SIZE, CAPTION = (1500, 330), 64
"""Pixels of the three panels, and of the words below."""
INK, PALE = (38, 44, 54), (108, 116, 128)


def scene(ccd: str) -> Scene:
    """The shipped scene, its moving bodies followed ("auto") or not ("never")."""
    return parse(
        scene_path("tunnel").read_text(encoding="utf-8").replace("ccd: auto", f"ccd: {ccd}")
    )


def run(ccd: str) -> Simulation:
    simulation = Simulation(scene(ccd), dt=DT)
    simulation.advance(SECONDS)
    return simulation


def passed(simulation: Simulation) -> list[str]:
    """Names of what is on the wrong side of pane, guard or cup."""
    at = dict(zip(simulation.names(), simulation.centres(), strict=True))
    rod = simulation.poses()[simulation.names().index("rod")]
    x, y, z, w = rod[3:]
    axis = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    found = [name for name in at if name.startswith("ball") and at[name][0] > at["pane"][0]]
    if rod[0] + 0.4 * abs(axis[0]) > at["guard"][0] + 0.01:
        found.append("rod")
    return found + [name for name in at if name.startswith("shot") and at[name][2] < at["cup"][2]]


def draw(path: Path) -> list[str]:
    """Writes the PNG; gives its captions."""
    require_packages()
    from PIL import Image, ImageDraw, ImageFont

    runs = {ccd: run(ccd) for ccd in ("never", "auto")}
    moments = [Simulation(scene("auto")).poses(), *(r.poses() for r in runs.values())]
    captions = [
        ("the start", "30 m/s at a pane, 100 rad/s beside one, 30 m/s into a cup of sheets"),
        ("0.05 s later, ccd: never", f"through: {len(passed(runs['never']))} of 7"),
        ("0.05 s later, as carom does it", f"through: {len(passed(runs['auto']))} of 7"),
    ]
    save(path, scene("auto"), moments, SIZE)
    page = Image.new("RGB", (SIZE[0], SIZE[1] + CAPTION), "white")
    page.paste(Image.open(path).convert("RGB"))
    pen = ImageDraw.Draw(page)
    for i, (title, figure) in enumerate(captions):
        x, y = i * SIZE[0] // len(captions) + 14, SIZE[1] + 8
        pen.text((x, y), title, fill=INK, font=ImageFont.load_default(19))
        pen.text((x, y + 27), figure, fill=PALE, font=ImageFont.load_default(15))
    # 256 colours hold a picture of few hues; its size is a quarter.
    page.quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
    return [f"{title}: {figure}" for title, figure in captions]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("png", type=Path, help="file to write")
    print("\n".join(draw(parser.parse_args().png)))


if __name__ == "__main__":
    main()
