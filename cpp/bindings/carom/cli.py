# SPDX-License-Identifier: Apache-2.0
"""The command `carom`: results on stdout, progress on stderr and only on a terminal."""

from __future__ import annotations

import argparse
import os
import sys
import warnings
from collections.abc import Callable, Sequence
from importlib.metadata import entry_points
from pathlib import Path

from carom import _core
from carom.commands import COMMANDS
from carom.errors import InvalidInput, MissingDependency

OK, FAILED, BAD_INPUT, MISSING, INTERRUPTED, BROKEN_PIPE = 0, 1, 2, 3, 130, 141

EPILOG = """\
exit codes: 0 ok, 1 the scene failed its own check, 2 bad usage or input,
            3 an optional dependency is missing, 130 interrupted

example:
  carom run tower --seconds 3 --png tower.png
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command and returns its exit code."""
    with warnings.catch_warnings():
        warnings.showwarning = _show_warning
        return _run(argv)


def _run(argv: Sequence[str] | None) -> int:
    try:
        arguments = make_parser().parse_args(argv)
        code = arguments.run(arguments)
        sys.stdout.flush()
        return int(code)
    except InvalidInput as error:
        return _complain(error, BAD_INPUT)
    except MissingDependency as error:
        return _complain(error, MISSING)
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:  # the reader has gone, as in `carom run ... | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE


def make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="carom",
        description="Rigid bodies that never pass through each other, with the error and the price "
        "told.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=_version())
    parser.add_argument("--cmake-dir", action=_CmakeDir, help="print where find_package looks")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for add in COMMANDS:
        add(subparsers)
    for point in sorted(entry_points(group="carom.commands"), key=lambda point: point.name):
        try:
            point.load()(subparsers)
        except ImportError as error:
            _add_unavailable(subparsers, point.name, error)
    return parser


def _add_unavailable(subparsers: argparse._SubParsersAction, name: str, why: ImportError) -> None:
    """A command of another package that cannot be imported says so when it is called."""

    def refuse(error: ImportError) -> Callable[[argparse.Namespace], int]:
        def run(_: argparse.Namespace) -> int:
            raise MissingDependency(f"carom {name}", error.name or str(error), "ros") from error

        return run

    parser = subparsers.add_parser(name, help=f"not available: {why}", add_help=False)
    parser.add_argument("rest", nargs=argparse.REMAINDER)
    parser.set_defaults(run=refuse(why))


class _CmakeDir(argparse.Action):
    def __init__(self, option_strings: Sequence[str], dest: str, **options: object) -> None:
        super().__init__(option_strings, dest, nargs=0, help=str(options.get("help")))

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        folder = Path(_core.__file__).parent / "cpp" / "lib" / "cmake" / "carom"
        if not folder.is_dir():
            parser.error("this carom runs from a checkout; install it for its CMake files")
        print(folder)
        parser.exit()


def _version() -> str:
    build = _core.build_info()
    return "carom " + ", ".join([build.pop("version"), *(f"{k} {v}" for k, v in build.items())])


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    print(f"carom: warning: {message}", file=sys.stderr)


def _complain(error: Exception, code: int) -> int:
    print(f"carom: {error}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
