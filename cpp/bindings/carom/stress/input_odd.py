# SPDX-License-Identifier: Apache-2.0
"""Input that is legal and odd: empty scenes, damaged meshes, bodies that come and go."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np

from carom import (
    Box,
    InvalidInput,
    MassProperties,
    Mesh,
    Scene,
    Simulation,
    Sphere,
    UniformGravity,
    diagnose_mesh,
    mend_mesh,
)
from carom.stress.case import Group
from carom.stress.grounds import world
from carom.stress.solids import ball_mesh, box_mesh, grid_mesh

cases = Group("input")


@cases.case(
    "no body at all, one body, only static ones: loops over pairs of nothing",
    "of 4 scenes, those that fail or whose clock is wrong",
    0,
    "scenes",
)
def scenes_of_nothing() -> float:
    empty, one, still, weightless = Scene(), Scene(), world(), Scene()
    one.add(Sphere(1.0))
    still.add(Box([1, 1, 1]), static=True, position=[0, 0, 0.2])
    weightless.effects.append(UniformGravity([0, 0, 0]))
    wrong = 0
    for scene in (empty, one, still, weightless):
        simulation = Simulation(scene, dt=0.25)
        report = simulation.advance(1.0)
        wrong += not (report.ok and simulation.time == 1.0 and report.steps == 4)
    return wrong


@cases.case(
    "a mesh inside out, open, with a face twice, crossing itself, with an edge of four faces",
    "of 6 damaged meshes, those whose fault is not found, and sound ones accused",
    0,
    "meshes",
)
def faults_of_a_mesh() -> float:
    vertices, faces = box_mesh([1.0, 2.0, 3.0])
    second = np.concatenate([vertices, vertices + np.array([0.25, 0.5, 0.75])])
    crossing = np.concatenate([faces, faces + 8])
    # two boxes that share one edge: four faces meet in it
    beside = vertices + np.array([1.0, 2.0, 0.0])
    share = np.concatenate([vertices, beside])
    wrong = bool(diagnose_mesh(vertices, faces).findings)
    wrong += diagnose_mesh(vertices, faces[:, ::-1]).inverted != 1
    wrong += diagnose_mesh(vertices, faces[1:]).open_edges != 3
    wrong += diagnose_mesh(vertices, np.concatenate([faces, faces[:1]])).duplicate_faces != 1
    wrong += diagnose_mesh(second, crossing).crossings == 0
    wrong += diagnose_mesh(share, crossing).non_manifold_edges != 1
    flat = np.concatenate([faces, [[0, 0, 1]]])
    wrong += diagnose_mesh(vertices, flat).degenerate_faces != 1
    return wrong


@cases.case(
    "every face with corners of its own, as STL files have them: no two faces share an edge",
    "relative error of the volume after mending, against the sound mesh",
    1e-14,
    "1",
)
def soup_of_triangles() -> float:
    vertices, faces = ball_mesh(1.0, 3)
    loose, own = vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)
    sound = diagnose_mesh(vertices, faces).volume
    fixed, joined, diagnosis = mend_mesh(loose, own)
    if len(np.unique(joined)) != len(vertices) or not diagnosis.closed:
        return math.inf
    return abs(MassProperties.mesh(fixed, joined, density=1.0).mass / sound - 1)


@cases.case(
    "one bad face among eighty thousand (a million and more with --long)",
    "open edges found besides the three of the missing face",
    0,
    "edges",
    has_long=True,
)
def one_bad_face_of_many(scale: int = 1, left_out: int = 1) -> float:
    vertices, faces = ball_mesh(1.0, 6 if scale == 1 else 8)
    gone = [len(faces) // 3, 5][:left_out]
    return abs(diagnose_mesh(vertices, np.delete(faces, gone, axis=0)).open_edges - 3)


@cases.case(
    "triangles without area in a floor: a normal of 0/0 would throw bodies about",
    "distance of a box from its place of rest after 3 s on such a floor",
    1e-3,
    "m",
)
def floor_with_flat_triangles() -> float:
    vertices, faces = grid_mesh(4.0, 4)
    extra = [[0, 0, 1], [6, 12, 18], [7, 7, 7], [5, 6, 7]]
    scene = world(ground=False)
    scene.add(Mesh(vertices, np.concatenate([faces, extra])), static=True)
    scene.add(Box([0.5] * 3), position=[0.1, 0.2, 0.25])
    simulation = Simulation(scene)
    simulation.advance(3.0)
    return float(np.linalg.norm(simulation.centres()[1] - [0.1, 0.2, 0.25]))


@cases.case(
    "bodies added and removed at every step, in the middle of a pile",
    "wrong outcomes: an id used twice, a row out of place, a pose not finite",
    0,
    "outcomes",
)
def bodies_that_come_and_go() -> float:
    rng = np.random.default_rng(72)
    simulation, ids, wrong = Simulation(world()), [], 0
    seen = {0}
    for step in range(300):
        new = simulation.add(
            Box([0.3] * 3) if step % 2 else Sphere(0.2), position=[*rng.uniform(-0.5, 0.5, 2), 2.0]
        )
        wrong += new in seen
        seen.add(new)
        ids.append(new)
        simulation.step()
        if len(ids) > 15:
            simulation.remove(ids.pop(int(rng.integers(len(ids)))))
        wrong += simulation.ids().tolist() != [0, *ids]
        wrong += not np.isfinite(simulation.poses()).all()
    return wrong


@cases.case(
    "scene files with NaN, a key twice, an unknown key, a tab, a word for a number, no such shape",
    "of 7 files, those read without complaint or with one that names no line",
    0,
    "files",
)
def scene_files_with_faults() -> float:
    head = "bodies:\n  - {name: ball, shape: {Sphere: {radius: 0.5}}"
    texts = (
        head + ", mass: .nan}\n",
        head + ", mass: 1, mass: 2}\n",
        head + ", colour: red}\n",
        head + ", mass: heavy}\n",
        head + "}\n\t- {}\n",
        "bodies:\n  - {name: ball, shape: {Globe: {radius: 0.5}}}\n",
        head + ", position: [1, 2]}\n",
    )
    unseen = 0
    with tempfile.TemporaryDirectory() as folder:
        for text in texts:
            path = Path(folder) / "scene.yaml"
            path.write_text(text)
            try:
                Scene.load(path)
                unseen += 1
            except InvalidInput as error:
                unseen += "scene.yaml:" not in str(error)
    return unseen


@cases.case(
    "bytes of a saved state cut short, changed or of another program",
    "of 240 damaged states, those taken silently or that change the simulation when refused",
    0,
    "states",
)
def damaged_saved_states() -> float:
    scene = world()
    scene.add(Box([1, 1, 1]), position=[0, 0, 0.7])
    simulation = Simulation(scene)
    simulation.advance(0.5)
    saved, before, wrong = simulation.save(), simulation.state_hash(), 0
    rng = np.random.default_rng(73)
    damaged = [saved[:n] for n in rng.integers(0, len(saved), 20)]
    damaged += [bytes(rng.integers(0, 256, n, dtype=np.uint8)) for n in rng.integers(0, 500, 20)]
    for at in rng.integers(0, len(saved), 200):
        damaged.append(saved[:at] + bytes([saved[at] ^ 0xFF]) + saved[at + 1 :])
    for data in damaged:
        try:
            simulation.restore(data)
            wrong += 1
        except InvalidInput:
            wrong += simulation.state_hash() != before
    return wrong
