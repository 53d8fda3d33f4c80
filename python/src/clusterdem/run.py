"""What lies in the folder of a run: frames, table over time, log."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from .errors import InputError
from .io.reader import natural_order

DUMP = re.compile(r"^(?P<name>.+?)\.(?:\d+\.)?dump(?:\.gz|\.zst|\.bin)?$")


@dataclass(frozen=True)
class RunFolder:
    """The files of one run.

    Parameters
    ----------
    path : Path
        The folder.
    name : str
        What its files' names begin with, such as ``case1``.
    dumps : list of Path
        Dump files in order.
    series, log, command : Path or None
        ``NAME.N.txt``, ``NAME.log`` and ``command.txt``, where they are.
    """

    path: Path
    name: str
    dumps: list[Path]
    series: Path | None
    log: Path | None
    command: Path | None


def find_run(path: str | Path, name: str | None = None) -> RunFolder:
    """Look for the files of a run.

    Parameters
    ----------
    path : str or Path
        The folder.
    name : str, optional
        What the files' names begin with; needed only where several runs share the folder.
    """
    folder = Path(path)
    if not folder.is_dir():
        raise InputError(folder, "must be the folder of a run")
    dumps: dict[str, list[Path]] = {}
    for file in folder.iterdir():
        if (found := DUMP.match(file.name)) and not file.name.startswith("."):
            dumps.setdefault(found["name"], []).append(file)
    if name is None:
        if not dumps:
            raise InputError(folder, "holds no dump file (NAME.STEP.dump, maybe .gz, .zst or .bin)")
        if len(dumps) > 1:
            raise InputError(folder, f"holds several runs ({', '.join(sorted(dumps))}): choose one with --name")
        (name,) = dumps
    if name not in dumps:
        raise InputError(folder, f"holds no dump file {name}.*.dump")

    def there(file: str) -> Path | None:
        return folder / file if (folder / file).is_file() else None

    series, log, command = there(f"{name}.N.txt"), there(f"{name}.log"), there("command.txt")
    return RunFolder(folder, name, natural_order(dumps[name]), series, log, command)
