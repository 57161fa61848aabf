# SPDX-License-Identifier: Apache-2.0
"""A request that cannot be used: what was wrong with it and what to do instead."""

import math
import reprlib

_short = reprlib.Repr()
_short.maxstring = _short.maxother = 80
_short.maxlist = _short.maxtuple = 8
_short.maxlevel = 3


class Refusal(ValueError):
    """One refused request. The four parts are the keys of the records on ~/rejected."""

    def __init__(self, field: str, value: object, rule: str, remedy: str = "") -> None:
        self.field, self.value = shown(field), shown(value)
        self.rule, self.remedy = _one_line(rule), _one_line(remedy)
        told = f"{self.field}: {self.value}, {self.rule}"
        super().__init__(f"{told}; {self.remedy}" if remedy else told)


def shown(value: object) -> str:
    """A value as a person would read it in a message: short, 4 digits, never a page of text."""
    if isinstance(value, str):
        text = _visible(value[:80])
        return text if len(value) <= 80 else f"{text[:60]}... ({len(value)} characters)"
    if isinstance(value, float):
        return f"{value:.4g}" if math.isfinite(value) else str(value)
    return _visible(_short.repr(value))


def _visible(text: str) -> str:
    """Control characters and lone surrogates escaped: messages go to terminals and to DDS."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def _one_line(text: str) -> str:
    """A sentence that may quote what was sent."""
    return _visible(" ".join(text.split("\n")))


def refusal_of(error: BaseException, field: str = "") -> Refusal:
    """Any error as a refusal; those of the core already carry the four parts."""
    if isinstance(error, Refusal):
        return error
    if all(isinstance(getattr(error, part, None), str) for part in ("field", "value", "rule")):
        return Refusal(error.field, error.value, error.rule, getattr(error, "remedy", ""))
    return Refusal(field, str(error) or type(error).__name__, "could not be used", "")
