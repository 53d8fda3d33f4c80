"""OpenFOAM's dictionaries: as much of them as tells patches, boundary conditions and schemes.

Format: OpenFOAM user guide, "Basic input/output file format". Lists of numbers, also binary ones, are passed over: VTK
reads them.
"""

from __future__ import annotations

import gzip
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Union

Entries = dict[str, Union[str, "Entries"]]

TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}();]|[^\s{}();"]+')
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#[^\n]*", re.MULTILINE)
BINARY_LIST = re.compile(rb"nonuniform\s+List<(\w+)>\s*(\d+)\s*\(")
COMPONENTS = {"scalar": 1, "label": 1, "vector": 3, "sphericalTensor": 1, "symmTensor": 6, "tensor": 9}


def foam_file(folder: Path, name: str) -> Path | None:
    """The file of that name, or packed by gzip; None if there is neither."""
    return next((path for path in (folder / name, folder / f"{name}.gz") if path.is_file()), None)


def read_bytes(path: Path) -> bytes:
    """The bytes of a file, unpacked."""
    data = path.read_bytes()
    return gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data


def entries(text: str) -> Entries:
    """A dictionary's entries: the words up to ``;`` as one string, dictionaries within as dictionaries."""
    text = DIRECTIVE.sub("", COMMENT.sub(" ", text))
    return _entries(iter(TOKEN.findall(text)))


def _entries(tokens: Iterator[str]) -> Entries:
    found: Entries = {}
    words: list[str] = []
    depth = 0  # of parentheses
    for token in tokens:
        depth += (token == "(") - (token == ")")
        if depth > 0 or token == ")":
            continue
        if token == "{":
            found[words[-1] if words else ""] = _entries(tokens)
            words = []
        elif token == "}":
            break
        elif token == ";":
            if words:
                found[words[0]] = " ".join(words[1:])
            words = []
        else:
            words.append(token)
    return found


def read_entries(path: Path) -> Entries:
    """The entries of a dictionary file."""
    return entries(read_bytes(path).decode("latin-1"))


def patch_kinds(boundary: Path) -> dict[str, tuple[str, tuple[str, ...]]]:
    """Of ``polyMesh/boundary``: each patch's type, and the groups that it belongs to (its type is one)."""
    text = COMMENT.sub(" ", read_bytes(boundary).decode("latin-1"))
    text = re.sub(r"FoamFile\s*\{[^}]*\}", "", text, count=1)
    found = {}
    for name, body in re.findall(r'([^\s{}();]+|"[^"]*")\s*\{([^{}]*)\}', text):
        kind = re.search(r"\btype\s+([^\s;]+)", body)
        groups = re.search(r"\binGroups\s+[^(]*\(([^)]*)\)", body)
        type_name = kind.group(1) if kind else "patch"
        found[name.strip('"')] = (type_name, (*(groups.group(1).split() if groups else ()), type_name))
    return found


def boundary_field(path: Path) -> Entries:
    """``boundaryField`` of a field's file; empty if there is none."""
    data = read_bytes(path)
    start = data.rfind(b"boundaryField")
    if start < 0:
        return {}
    header, body = data[:2000].decode("latin-1"), data[start:]
    if re.search(r"\bformat\s+binary", header):
        label, scalar = (
            int(match.group(1)) // 8 if (match := re.search(rf"\b{word}=(\d+)", header)) else usual
            for word, usual in (("label", 4), ("scalar", 8))
        )
        body = _without_binary(body, {k: n * (label if k == "label" else scalar) for k, n in COMPONENTS.items()})
    found = entries(body.decode("latin-1")).get("boundaryField", {})
    return found if isinstance(found, dict) else {}


def _without_binary(data: bytes, sizes: Mapping[str, int]) -> bytes:
    parts, at = [], 0
    while match := BINARY_LIST.search(data, at):
        parts.append(data[at : match.start()])
        at = match.end() + int(match.group(2)) * sizes.get(match.group(1).decode(), 8)
        parts.append(b"nonuniform (")
    return b"".join([*parts, data[at:]])


def of_patch(conditions: Entries, patch: str, groups: tuple[str, ...]) -> Entries:
    """What holds at a patch: by its name, else by a group of it, else by the last pattern that fits."""
    patterns = [key for key in reversed(conditions) if key.startswith('"') and re.fullmatch(key[1:-1], patch)]
    for key in (patch, f'"{patch}"', *groups, *patterns):
        found = conditions.get(key)
        if isinstance(found, dict):
            return found
    return {}
