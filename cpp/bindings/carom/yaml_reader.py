# SPDX-License-Identifier: Apache-2.0
"""YAML with a place for every value, so that errors say file, line and field."""

from __future__ import annotations

import contextlib
import numbers
from collections.abc import Iterable, Iterator
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from carom.errors import InvalidInput, nearest


def parse_yaml(text: str, source: str) -> Place:
    """The document as a Place. Raises InvalidInput where it is not YAML or not a mapping."""
    try:
        value = YAML(typ="rt").load(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        at = f"{source}:{mark.line + 1}" if mark else source
        problem = " ".join(str(error.problem or error.context).split())
        raise InvalidInput(at, "not YAML", problem) from error
    except (YAMLError, RecursionError, ValueError) as error:
        raise InvalidInput(source, "not YAML", " ".join(str(error).split())[:200]) from error
    if not isinstance(value, CommentedMap):
        raise InvalidInput(source, _shown(value), "must be a mapping with bodies and effects")
    return Place(source, "", 1, value)


class Place:
    """A value of a YAML file and where it stands."""

    def __init__(self, source: str, path: str, line: int, value: Any) -> None:
        self.source = source
        self.path = path
        self.line = line
        self.value = value

    def text(self) -> str:
        return _shown(self.value)

    def error(self, value: str, rule: str, remedy: str = "") -> InvalidInput:
        return InvalidInput(f"{self.source}:{self.line} {self.path}".rstrip(), value, rule, remedy)

    def unknown(self, name: str, rule: str, valid: Iterable[str]) -> InvalidInput:
        return self.error(f"'{name}'", rule, nearest(name, valid))

    # As a mapping.
    def __contains__(self, key: str) -> bool:
        return isinstance(self.value, CommentedMap) and key in self.value

    def __getitem__(self, key: str) -> Place:
        return Place(self.source, self._joined(key), self._line_of(key), self.value[key])

    def __iter__(self) -> Iterator[str]:
        """Keys, in the order of the file."""
        return iter(self.value if isinstance(self.value, CommentedMap) else ())

    def only_keys(self, valid: Iterable[str]) -> None:
        if not isinstance(self.value, CommentedMap):
            raise self.error(self.text(), f"must be a mapping of {', '.join(valid)}")
        for key in self.value:
            if key not in valid:
                here = Place(self.source, self._joined(str(key)), self._line_of(key), None)
                raise here.unknown(str(key), "is not a key here", valid)

    def single_choice(self, valid: Iterable[str]) -> tuple[str, Place]:
        """`{Name: {arguments}}`, or `Name` alone where every argument has its default."""
        names = list(valid)
        if isinstance(self.value, str):
            value = CommentedMap({self.value: CommentedMap()})
            return Place(self.source, self.path, self.line, value).single_choice(names)
        if not isinstance(self.value, CommentedMap) or len(self.value) != 1:
            raise self.error(self.text(), f"must be one of {', '.join(names)} with its arguments")
        self.only_keys(names)
        (name,) = self.value
        arguments = self[name]
        if arguments.value is None:
            arguments.value = CommentedMap()
        return name, arguments

    # As a list.
    def items(self, key: str) -> Iterator[Place]:
        """Entries of the list under `key`; none where the key is missing or empty."""
        if key not in self or self.value[key] is None:
            return
        entries = self[key]
        if not isinstance(entries.value, CommentedSeq):
            raise entries.error(entries.text(), "must be a list")
        for i, value in enumerate(entries.value):
            line = entries.value.lc.item(i)[0] + 1
            yield Place(self.source, f"{entries.path}[{i}]", line, value)

    # As a value.
    def value_as(self, annotation: str) -> Any:
        """The plain value, where it is of the kind that the annotation of an argument asks for."""
        value = self.value
        if value is None and "None" in annotation:
            return None
        for words, fits, rule in _KINDS:
            if any(word in annotation for word in words):
                if fits(value):
                    return _plain(value)
                raise self.error(self.text(), rule)
        raise self.error(self.text(), "cannot be given in a scene file")

    @contextlib.contextmanager
    def locating_errors(self, owner: str) -> Iterator[None]:
        """Adds file, line and path to an InvalidInput about `owner.key` of this mapping."""
        try:
            yield
        except InvalidInput as error:
            field = error.field.removeprefix(f"{owner}.")
            key = field.partition(".")[0].partition("[")[0]
            line = self._line_of(key) if key in self else self.line
            at = f"{self.source}:{line} {self._joined(field)}"
            raise InvalidInput(at, error.value, error.rule, error.remedy) from error

    def _joined(self, key: str) -> str:
        return f"{self.path}.{key}" if self.path else key

    def _line_of(self, key: Any) -> int:
        try:
            return int(self.value.lc.key(key)[0]) + 1
        except (AttributeError, KeyError, TypeError):  # merged in by <<, or made here
            return self.line


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def _is_whole(value: Any) -> bool:
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def _is_array(value: Any) -> bool:
    def is_row(entry: Any) -> bool:
        return isinstance(entry, list) and all(map(_is_number, entry))

    return is_row(value) or (isinstance(value, list) and all(map(is_row, value)))


_KINDS = (
    (("ArrayLike", "ndarray", "NDArray"), _is_array, "must be a list of numbers"),
    (("float", "SupportsFloat"), _is_number, "must be a number"),
    (("bool",), lambda value: isinstance(value, bool), "must be true or false"),
    (("str",), lambda value: isinstance(value, str), "must be text"),
    (("int", "SupportsInt"), _is_whole, "must be a whole number"),
)


def _plain(value: Any) -> Any:
    """Without the reader's own subclasses of float, str and list."""
    if isinstance(value, list):
        return [_plain(entry) for entry in value]
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return value


def _shown(value: Any) -> str:
    if isinstance(value, CommentedMap):
        return "a mapping"
    if value is None:
        return "nothing"
    text = repr(_plain(value)) if not isinstance(value, CommentedSeq) else "a list"
    return text if len(text) <= 60 else text[:57] + "..."
