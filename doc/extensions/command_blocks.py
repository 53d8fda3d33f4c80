"""The commands in Markdown pages: fenced `bash` blocks, each marked as tested, or as not run with the reason.

The mark is a comment in the line before the block: `<!-- tested -->` or `<!-- not run: why -->`.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

BLOCK = re.compile(r"^(?:<!-- (?P<mark>.*?) -->\n)?(?P<fence>```+)bash\n(?P<body>.*?)^(?P=fence)$", re.M | re.S)
SKIPPED = ("build", "results", "trade")


@dataclass(frozen=True)
class CommandBlock:
    """One block of commands: its page (path from the root), line, text, and what its mark says."""

    page: str
    line: int
    body: str
    mark: str | None

    @property
    def tested(self) -> bool:
        return self.mark == "tested"

    @property
    def reason(self) -> str | None:
        """Why it is not run; nothing where no reason is given."""
        return self.mark.removeprefix("not run: ") if self.mark and self.mark.startswith("not run: ") else None


def pages(root: Path) -> Iterator[Path]:
    """All Markdown files of a checkout, in order."""
    for path in sorted(root.rglob("*.md")):
        top = path.relative_to(root).parts[0]
        if not (top.startswith(".") or top.startswith(SKIPPED)):
            yield path


def command_blocks(root: Path) -> list[CommandBlock]:
    """Every block of commands in the Markdown files of a checkout."""
    found = []
    for path in pages(root):
        text = path.read_text(encoding="utf-8")
        for match in BLOCK.finditer(text):
            line = text.count("\n", 0, match.start("fence")) + 1
            found.append(CommandBlock(str(path.relative_to(root)), line, match["body"], match["mark"]))
    return found
