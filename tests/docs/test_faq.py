"""Every error that doc/faq.md explains exists in the sources, word for word."""

import ast
import re
from collections.abc import Iterator

import pytest
from checkout import ROOT

ENTRY = re.compile(r"^`(.+)`\n: ", re.M)
QUOTED = [match[1] for match in ENTRY.finditer((ROOT / "doc/faq.md").read_text(encoding="utf-8"))]
LAMMPS_OWN = {"Lost atoms", "requires atom attribute omega", "Unrecognized atom style 'cluster'"}
CPP_STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"(?:\s*"((?:[^"\\\n]|\\.)*)")*')


def cpp_texts(text: str) -> Iterator[str]:
    """String literals of C++, neighbours joined as the compiler joins them."""
    for match in CPP_STRING.finditer(text):
        yield "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match[0]))


def python_texts(text: str) -> Iterator[str]:
    """String literals of Python; what an f-string fills in becomes {}."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        if isinstance(node, ast.JoinedStr):
            yield "".join(v.value if isinstance(v, ast.Constant) else "{}" for v in node.values)


def shell_texts(text: str) -> Iterator[str]:
    yield from re.findall(r'"([^"\n]*)"', text)


def sources() -> list[str]:
    texts: set[str] = set()
    for folder, ending, of in (
        ("src", ".cpp", cpp_texts),
        ("src", ".h", cpp_texts),
        ("python/src", ".py", python_texts),
        ("setup", ".sh", shell_texts),
    ):
        for file in sorted((ROOT / folder).rglob(f"*{ending}")):
            texts |= set(of(file.read_text(encoding="utf-8")))
    return sorted(texts)


SOURCES = sources()


def found(quoted: str) -> bool:
    """All that stands between the dots comes in this order in one text of the sources."""
    parts = [part.strip() for part in quoted.split("…") if part.strip()]
    return any(in_order(parts, text) for text in SOURCES)


def in_order(parts: list[str], text: str) -> bool:
    at = 0
    for part in parts:
        at = text.find(part, at)
        if at < 0:
            return False
        at += len(part)
    return True


@pytest.mark.parametrize("quoted", QUOTED)
def test_text_is_in_the_sources(quoted: str) -> None:
    if quoted in LAMMPS_OWN:
        pytest.skip("an error of the engine")
    assert found(quoted), "the program no longer says this: change the page"


def test_the_search_can_fail() -> None:
    assert len(QUOTED) > 50
    assert not found("the ghost cutoff … is above …")
    assert not found("no such error was ever written")
