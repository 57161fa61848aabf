#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What engines make of the same scene, side by side: pyramid, pile and a stack under 1:1000.

    ./pictures.py --bin $PEERS_BUILD/bin --out ../results

runs the driver with `--dump` for carom and one peer (built by build.sh) and writes one PNG a scene,
both seen by one camera, with the figures the driver measured below. Needs carom[plot].
"""

import argparse
import csv
import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import carom
from carom.render import save

# Arguments of the driver, those of the moment shown where it is not the end, what to call it.
SCENES: dict[str, tuple[list[str], list[str], str]] = {
    "pyramid": (["--scene", "pyramid", "--n", "20"], [], "pyramid of 20, 10 s"),
    "pile": (["--scene", "pile", "--steps", "600"], [], "1000 boxes dropped, 12 s"),
    "stack_1000": (
        ["--scene", "stack", "--n", "10", "--ratio", "1000"],
        ["--steps", "54"],
        "ten under 1:1000 after 0.9 s",
    ),
}
SIZE = (1200, 460)  # pixels of both panels
CAPTION = 64  # pixels below
INK, PALE = (38, 44, 54), (108, 116, 128)


def simulate(binary: Path, arguments: list[str], shown: list[str]) -> tuple[dict, list[dict]]:
    """The driver's figures at the end and its bodies at the moment shown."""
    with tempfile.TemporaryDirectory() as folder:
        dump = Path(folder) / "bodies.csv"
        command = [binary, *arguments, "--dump", dump]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        if shown:
            subprocess.run([*command, *shown], check=True, capture_output=True)
        with dump.open() as file:
            return json.loads(done.stdout.splitlines()[-1]), list(csv.DictReader(file))


def scene_of(bodies: list[dict]) -> carom.Scene:
    """The driver's moving bodies over a plane in place of its ground."""
    scene = carom.Scene()
    scene.add(carom.Plane([0, 0, 1], 0), static=True)
    for body in bodies:
        if body["moves"] == "0":
            continue
        size = [float(body[f"size_{axis}"]) for axis in "xyz"]
        shape = carom.Box(size) if body["shape"] == "box" else carom.Sphere(size[0] / 2)
        scene.add(shape, density=float(body["density"]))
    return scene


def poses_of(bodies: list[dict]) -> np.ndarray:
    keys = ("x", "y", "z", "qx", "qy", "qz", "qw")
    moving = [[float(b[k]) for k in keys] for b in bodies if b["moves"] == "1"]
    return np.array([[0, 0, 0, 0, 0, 0, 1], *moving])


def verdict(figures: dict) -> str:
    overlap = f"mean overlap {figures['pen_mean_mm']:.2g} mm, deepest {figures['pen_max_mm']:.2g}"
    if "top_sink_mm" not in figures:
        return overlap
    sink, drift = figures["top_sink_mm"], figures["top_drift_mm"]
    if max(abs(sink), drift) > 250:
        return "has fallen"
    # A wide stance reads better than digits: what is below a micrometre is called so.
    plain = ["< 0.001" if abs(x) < 1e-3 else f"{x:.2g}" for x in (sink, drift)]
    if figures["pen_max_mm"] < 1e-3:
        overlap = "overlap < 0.001"
    return f"after 10 s top sank {plain[0]} mm, drifted {plain[1]} mm; {overlap}"


def picture(path: Path, title: str, runs: list[tuple[str, dict, list[dict]]]) -> None:
    save(path, scene_of(runs[0][2]), [poses_of(bodies) for _, _, bodies in runs], SIZE)
    rendered = Image.open(path).convert("RGB")
    page = Image.new("RGB", (SIZE[0], SIZE[1] + CAPTION), "white")
    page.paste(rendered)
    draw = ImageDraw.Draw(page)
    large, small = ImageFont.load_default(19), ImageFont.load_default(15)
    width = SIZE[0] // len(runs)
    for i, (name, figures, _) in enumerate(runs):
        x, y = i * width + 14, SIZE[1] + 8
        draw.text((x, y), f"{name}: {title}", fill=INK, font=large)
        draw.text((x, y + 27), verdict(figures), fill=PALE, font=small)
    # 256 colours hold a picture of few hues; its size is a quarter.
    page.quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", type=Path, required=True, help="folder of the drivers")
    parser.add_argument("--out", type=Path, default=Path(), help="folder of the PNGs")
    parser.add_argument("--peer", default="box3d_f32_v3", help="driver to stand beside carom")
    parser.add_argument("--peer-name", default="Box3D")
    parser.add_argument("--scenes", default=",".join(SCENES), help="of " + ", ".join(SCENES))
    options = parser.parse_args()
    for name in options.scenes.split(","):
        arguments, shown, title = SCENES[name]
        runs = [
            (label, *simulate(options.bin / binary, arguments, shown))
            for label, binary in (("carom", "own"), (options.peer_name, options.peer))
        ]
        path = options.out / f"beside_{name}.png"
        picture(path, title, runs)
        print(f"{path}: " + "; ".join(f"{label} {verdict(f)}" for label, f, _ in runs))


if __name__ == "__main__":
    main()
