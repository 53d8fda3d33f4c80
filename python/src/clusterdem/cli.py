"""The command line ``clusterdem``: a thin layer on the package's functions."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Sequence

from . import __version__
from .commands import COMMANDS
from .errors import InputError


def parser() -> argparse.ArgumentParser:
    """The argument parser with all commands."""
    top = argparse.ArgumentParser(prog="clusterdem", description=__doc__)
    top.add_argument("--version", action="version", version=f"clusterdem {__version__}")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for module in COMMANDS:
        name = module.__name__.rpartition(".")[2]
        summary = (module.__doc__ or "").strip()
        sub = commands.add_parser(
            name,
            help=summary.splitlines()[0],
            description=summary,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(sub)
        sub.set_defaults(run=module.run)
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; 0 if all went well, 2 for bad input (one line on stderr), 130 if interrupted."""
    options = parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # mpirun passes Ctrl-C on as SIGTERM
    try:
        options.run(options)
        sys.stdout.flush()
    except InputError as error:
        if os.environ.get("OMPI_COMM_WORLD_RANK", "0") == "0":
            print(f"clusterdem: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("clusterdem: interrupted; files already named are whole", file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    return 0
