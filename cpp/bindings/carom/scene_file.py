# SPDX-License-Identifier: Apache-2.0
"""Scenes as YAML, its keys the arguments of `Scene.add` and of the shapes and effects.

    effects:
      - UniformGravity: {acceleration: [0, 0, -9.81]}
    bodies:
      - {name: ground, static: true, shape: {Plane: {normal: [0, 0, 1], offset: 0}}}
      - {name: crate, mass: 2, shape: {Box: {extents: [0.2, 0.2, 0.2]}}, position: [0, 0, 1]}
      - {name: bolt, shape: {Mesh: {path: bolt.stl, scale: 0.001}}, position: [0, 0, 2]}

`never_meet: [[crate, bolt]]` at the top lets the two pass through each other.

YAML 1.2: 1e3 is a number and `on` is text. A body that an effect names is named, not numbered. Mesh
files are found from the folder of the scene file. Shapes nest: `Sdf: {mesh: {path: bolt.stl},
spacing: 0.01}`, `Compound: {parts: [{shape: {Sphere: {radius: 1}}, position: [0, 0, 1]}]}`.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from carom import _core
from carom._core import Mesh, Scene
from carom.errors import InvalidInput
from carom.signature import parameters
from carom.yaml_reader import Place, parse_yaml

SHAPES: dict[str, type] = {
    name: getattr(_core, name)
    for name in re.findall(r"_core\.(\w+)", parameters(Scene.add)["shape"].kind)
}
EFFECTS: dict[str, type] = {info.name: getattr(_core, info.name) for info in _core.effects_table()}


def load(path: str | os.PathLike[str]) -> Scene:
    """Reads a scene file. Raises InvalidInput naming file, line, field, value, rule and remedy."""
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        reason = error.strerror or "cannot be read"
        raise InvalidInput("scene file", str(path), f"must be readable ({reason})") from error
    except UnicodeDecodeError as error:
        raise InvalidInput("scene file", str(path), "must be UTF-8 text") from error
    return parse(text, source=path.name, folder=path.parent)


def parse(text: str, *, source: str = "scene", folder: Path | None = None) -> Scene:
    """Reads a scene from text. source: what errors call it; folder: where its mesh files are found,
    none are read without one."""
    return _SceneReader(folder).read(parse_yaml(text, source))


class _SceneReader:
    def __init__(self, folder: Path | None) -> None:
        self.folder = folder
        self.scene = Scene()
        self.meshes: dict[tuple[Path, float], Mesh] = {}

    def read(self, top: Place) -> Scene:
        top.only_keys(["bodies", "effects", "never_meet"])
        for body in top.items("bodies"):
            self.add_body(body)
        for effect in top.items("effects"):
            self.scene.effects.append(self.effect(effect))
        for pair in top.items("never_meet"):
            self.keep_apart(pair)
        return self.scene

    def keep_apart(self, pair: Place) -> None:
        names = pair.value
        if not isinstance(names, list) or len(names) != 2:
            raise pair.error(pair.text(), "must be two names of bodies, as [arm, hand]")
        ids = [self.body_id(Place(pair.source, pair.path, pair.line, name)) for name in names]
        with pair.locating_errors("never_meet"):
            self.scene.never_meet(*ids)

    def add_body(self, body: Place) -> None:
        valid = parameters(Scene.add)
        body.only_keys(valid)
        if "shape" not in body:
            raise body.error("no shape", f"must have a shape: {', '.join(SHAPES)}")
        arguments: dict[str, Any] = {"shape": self.shape(body["shape"])}
        for key in body:
            if key not in ("shape", "mass_properties"):
                arguments[key] = body[key].value_as(valid[key].kind)
        if "mass_properties" in body:
            arguments["mass_properties"] = self.build(_core.MassProperties, body["mass_properties"])
        with body.locating_errors(arguments.get("name", f"body_{len(self.scene)}")):
            self.scene.add(**arguments)

    def shape(self, place: Place) -> Any:
        kind, arguments = place.single_choice(SHAPES)
        return self.mesh(arguments) if SHAPES[kind] is Mesh else self.build(SHAPES[kind], arguments)

    def mesh(self, place: Place) -> Mesh:
        if "path" not in place and "scale" not in place:
            return self.build(Mesh, place)
        place.only_keys(["path", "scale"])
        if "path" not in place:
            raise place.error("no path", "must have a path", "or give vertices and faces")
        if self.folder is None:
            raise place["path"].error(
                place["path"].text(), "must not be a file here", "give vertices and faces"
            )
        path = self.folder / place["path"].value_as("str")
        scale = place["scale"].value_as("float") if "scale" in place else 1.0
        if (path, scale) not in self.meshes:  # bodies of one file share one mesh
            with place.locating_errors("Mesh"):
                self.meshes[path, scale] = Mesh.load(path, scale)
        return self.meshes[path, scale]

    def effect(self, place: Place) -> Any:
        kind, arguments = place.single_choice(EFFECTS)
        return self.build(EFFECTS[kind], arguments)

    def build(self, cls: type, place: Place) -> Any:
        valid = parameters(cls)
        place.only_keys(valid)
        arguments = {}
        for key in place:
            named = key == "body" or key.startswith("body_")
            arguments[key] = (
                self.body_id(place[key]) if named else self.argument(place, key, valid[key].kind)
            )
        missing = [key for key in valid if valid[key].required and key not in arguments]
        if missing:
            raise place.error(f"no {missing[0]}", f"must have {' and '.join(missing)}")
        with place.locating_errors(cls.__name__):
            return cls(**arguments)

    def argument(self, place: Place, key: str, kind: str) -> Any:
        """A value, or a shape or the parts of one within another."""
        if kind.endswith("_core.Mesh"):
            return self.mesh(place[key])
        if "_core.Part]" in kind:
            return [self.build(_core.Part, part) for part in place.items(key)]
        if kind.count("_core.") == len(SHAPES):
            return self.shape(place[key])
        return place[key].value_as(kind)

    def body_id(self, place: Place) -> int:
        name = place.value_as("str")
        found = self.scene.find(name)
        if found is None:
            names = [body.name for body in self.scene.bodies]
            raise place.unknown(name, "must name a body of the scene", names)
        return found
