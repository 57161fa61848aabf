# SPDX-License-Identifier: Apache-2.0
"""YAML from strangers: size, depth and kinds are bounded before anything is built.

YAML 1.2 scalars: 1e3 is a number, `on` and `yes` are text. Anchors, aliases and tags are refused:
they are how a short text becomes a large one, or something that is not data.
"""

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError
from ruamel.yaml.events import (
    AliasEvent,
    CollectionEndEvent,
    CollectionStartEvent,
    DocumentStartEvent,
    ScalarEvent,
)

from carom_ros import limits
from carom_ros.refusal import Refusal


def check(text: str, field: str, limit: int) -> None:
    """Refuses text that is too long, not YAML, too deep, or more than plain data."""
    if len(text) > limit:
        raise Refusal(field, text, f"must have at most {limit} characters")
    depth = nodes = documents = 0
    try:
        for event in YAML(typ="safe", pure=True).parse(text):
            if isinstance(event, AliasEvent) or getattr(event, "anchor", None):
                raise Refusal(field, text, "anchors and aliases are not taken", "write it out")
            if isinstance(event, (ScalarEvent, CollectionStartEvent)):
                nodes += 1
                if getattr(event, "tag", None):
                    raise Refusal(field, str(event.tag), "tags are not taken", "plain data only")
            documents += isinstance(event, DocumentStartEvent)
            depth += isinstance(event, CollectionStartEvent)
            depth -= isinstance(event, CollectionEndEvent)
            if depth > limits.YAML_DEPTH or nodes > limits.YAML_NODES or documents > 1:
                rule = (
                    f"at most {limits.YAML_DEPTH} levels, {limits.YAML_NODES} values, one document"
                )
                raise Refusal(field, text, rule)
    except YAMLError as error:
        raise _not_yaml(error, text, field) from None
    except (ValueError, OverflowError) as error:  # such as the escape "\UFFFFFFFF"
        if isinstance(error, Refusal):
            raise
        raise Refusal(field, text, f"is not usable YAML: {error}") from None


def load(text: str, field: str, limit: int) -> object:
    """The plain value a YAML text stands for. @throws Refusal"""
    check(text, field, limit)
    try:
        return YAML(typ="safe", pure=True).load(text)
    except YAMLError as error:
        raise _not_yaml(error, text, field) from None
    except (ValueError, TypeError, OverflowError) as error:  # such as 2026-13-45, or a key [1, 2]
        raise Refusal(field, text, f"is not usable YAML: {error}") from None


def _not_yaml(error: YAMLError, text: str, field: str) -> Refusal:
    where = getattr(error, "problem_mark", None)
    problem = getattr(error, "problem", None) or str(error).splitlines()[0]
    place = f" (line {where.line + 1}, column {where.column + 1})" if where else ""
    return Refusal(field, text, f"is not YAML: {problem}{place}", "quote texts with ' or \"")
