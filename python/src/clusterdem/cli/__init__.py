"""The command line ``clusterdem``: a thin layer on the package's functions.

One module per command: its first line is the summary, ``add_arguments`` its options, ``run`` the work. Only the command
that is asked for is imported, so that ``--version`` and ``--help`` cost no more than the interpreter.
"""

from __future__ import annotations

import argparse
import logging
import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from .. import __version__
from ..errors import ArgumentError, InputError

COMMANDS = (
    "map", "sizes", "compare", "report", "profile", "groups", "mixing", "velocities", "flow", "scatter", "film", "vtk", "table", "start", "gas", "trade", "calibrate",
)  # fmt: skip

OPTIONS = {
    "method": "--deposit",
    "density": "--rho",
    "borders": "--classes",
    "count": "--clusters",
    "shape": "--grid",
    "executable": "--lmp",
}
"""Options by the arguments of the library that they set, where the two have different names."""


def _summary(command: str) -> str:
    """The first line of a command's module, without importing it."""
    here = Path(__file__).parent
    module = here / f"{command}.py"
    with open(module if module.exists() else here / command / "__init__.py", encoding="utf-8") as file:
        return file.readline().strip().strip('"')


def parser(wanted: str | None = None) -> argparse.ArgumentParser:
    """The argument parser with all commands; the options of the wanted one alone."""
    top = argparse.ArgumentParser(
        prog="clusterdem", description="Post-processing of cluster DEM runs.", allow_abbrev=False
    )
    top.add_argument("--version", action="version", version=f"clusterdem {__version__}")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name in COMMANDS:
        if name != wanted:
            commands.add_parser(name, help=_summary(name))
            continue
        module = import_module(f".{name}", __name__)
        sub = commands.add_parser(
            name,
            help=_summary(name),
            description=(module.__doc__ or "").strip(),
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,  # half an option is a typo
        )
        module.add_arguments(sub)
        sub.set_defaults(run=module.run)
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; 0 if all went well, 2 for bad input (one line on stderr), 130 if interrupted."""
    words = sys.argv[1:] if arguments is None else list(arguments)
    wanted = next((word for word in words if not word.startswith("-")), None)
    options = parser(wanted).parse_args(words)
    _print_notes()
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # mpirun passes Ctrl-C on as SIGTERM
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs begin with it ignored
    try:
        options.run(options)
        sys.stdout.flush()
    except (InputError, ArgumentError) as error:
        if os.environ.get("OMPI_COMM_WORLD_RANK", "0") == "0":
            print(f"clusterdem: {_in_options(error)}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("clusterdem: interrupted; files already named are whole", file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    return 0


def _print_notes() -> None:
    """What the library notes goes to stderr, each note once, and once under mpirun."""
    log = logging.getLogger("clusterdem")
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(logging.Formatter("clusterdem: note: %(message)s"))
    said: set[str] = set()  # frames may be read twice

    def once(record: logging.LogRecord) -> bool:
        new = record.getMessage() not in said and os.environ.get("OMPI_COMM_WORLD_RANK", "0") == "0"
        said.add(record.getMessage())
        return new

    handler.addFilter(once)
    log.handlers[:] = [handler]
    log.propagate = False


def _in_options(error: InputError | ArgumentError) -> str:
    """A library's error in the words of the command line: options instead of arguments."""
    if isinstance(error, InputError):
        return str(error)
    return f"{OPTIONS.get(error.argument, '--' + error.argument.replace('_', '-'))}: {error.rule}"
