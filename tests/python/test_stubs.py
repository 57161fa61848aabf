# SPDX-License-Identifier: Apache-2.0
"""The type stubs list what the module has: every class, method, property, function and argument.

After a change of the bindings: cpp/bindings/make_stubs
"""

import ast
import inspect
from pathlib import Path

import pytest

import carom
from carom import _core
from carom.signature import parameters

FOLDER = Path(carom.__file__).parent / "_core"
MODULES = {"__init__": _core} | {n: m for n, m in vars(_core).items() if inspect.ismodule(m)}
ITEMS = [(file, name) for file, module in MODULES.items() for name in sorted(vars(module))]


def stub_of(file):
    return definitions(ast.parse((FOLDER / f"{file}.pyi").read_text()).body)


def definitions(body):
    """Names of a stub's body to their nodes; overloads of one name in a list."""
    found = {}
    for node in body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            found.setdefault(node.name, []).append(node)
        elif isinstance(node, ast.AnnAssign):
            found.setdefault(node.target.id, []).append(node)
        elif isinstance(node, ast.Assign):
            found.setdefault(node.targets[0].id, []).append(node)
    return found


def need(present, what):
    assert present, f"the stubs lack {what}: run cpp/bindings/make_stubs"


def public(members):
    return {name for name in members if not name.startswith("_")}


def check_arguments(function, nodes, where):
    named = list(parameters(function))
    if not named or len(nodes) > 1:  # nothing told, or overloaded
        return
    arguments = nodes[0].args
    stub = [a.arg for a in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]]
    need([a for a in stub if a != "self"] == named, where)


@pytest.mark.parametrize(("file", "name"), [i for i in ITEMS if not i[1].startswith("_")])
def test_the_stub_has(file, name):
    thing, stub = getattr(MODULES[file], name), stub_of(file)
    if inspect.ismodule(thing):
        need((FOLDER / f"{name}.pyi").is_file(), name)
        return
    need(name in stub, name)
    if inspect.isclass(thing):
        (node,) = stub[name]
        members = definitions(node.body)
        missing = public(vars(thing)) - set(members)
        need(not missing, f"{name}: {missing}")
        for member in [*public(vars(thing)), *({"__init__"} & set(members))]:
            check_arguments(getattr(thing, member), members[member], f"{name}.{member}")
    elif callable(thing):
        check_arguments(thing, stub[name], name)


@pytest.mark.parametrize("file", MODULES)
def test_the_stub_has_nothing_that_is_gone(file):
    need((FOLDER / f"{file}.pyi").is_file(), file)
    assert public(stub_of(file)) <= set(vars(MODULES[file])), "run cpp/bindings/make_stubs"


def test_the_package_is_marked_as_typed_and_names_its_face():
    assert (Path(carom.__file__).parent / "py.typed").is_file()
    for name in carom.__all__:
        assert getattr(carom, name).__doc__, f"{name} has no docstring"
