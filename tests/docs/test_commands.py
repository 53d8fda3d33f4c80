"""The commands on the pages are run as they stand, each page's in a copy of the sources of its own."""

import os
import subprocess
from pathlib import Path

import pytest
from checkout import BUILD, ROOT
from command_blocks import command_blocks

BLOCKS = command_blocks(ROOT)
# the copy has the build of this checkout; Open MPI refuses root and more ranks than cores unless told
ENVIRONMENT = {"CLUSTERDEM_IS_SET_UP": "yes", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
if os.geteuid() == 0:
    ENVIRONMENT |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
TESTED = sorted({block.page for block in BLOCKS if block.tested})


def test_every_block_is_run_or_says_why_not() -> None:
    unmarked = [f"{b.page}:{b.line}" for b in BLOCKS if not b.tested and not b.reason]
    assert not unmarked, "mark with `<!-- tested -->` or `<!-- not run: why -->` in the line before"
    assert sum(b.tested for b in BLOCKS) >= 5  # the start page alone has these


@pytest.mark.parametrize("page", TESTED)
def test_commands_of_page(page: str, copied_sources: Path, record_property) -> None:
    (copied_sources / "build").symlink_to(BUILD)
    blocks = [block for block in BLOCKS if block.page == page and block.tested]
    # `$LINE` tells which block it was when a command fails
    script = "".join(f"LINE={b.line}\n{b.body}\n" for b in blocks)
    trap = "trap 'echo \"failed in the block of line $LINE: $BASH_COMMAND\" >&2' ERR\n"
    done = subprocess.run(
        ["bash", "-c", "set -Eeuo pipefail\n" + trap + script],
        cwd=copied_sources,
        env=os.environ | ENVIRONMENT,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, f"{page}\n{done.stdout[-2000:]}\n{done.stderr[-3000:]}"
    commands = [line for b in blocks for line in b.body.splitlines() if line]
    record_property("commands", "\n".join(commands))
    print(f"{page}: {len(blocks)} blocks, {len(commands)} lines run")


def test_start_page_ends_in_events_and_figures(copied_sources: Path) -> None:
    """What the start page promises is there: its own script has breakups."""
    (block,) = [b for b in BLOCKS if b.page == "doc/start.md" and "my.in" in b.body]
    (copied_sources / "build").symlink_to(BUILD)
    done = subprocess.run(
        ["bash", "-c", f"export PATH=$PWD/build/bin:$PATH\n{block.body}"],
        cwd=copied_sources,
        env=os.environ | ENVIRONMENT,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=True,
    )
    table = done.stdout.split("d_mean")[-1].split("Loop")[0].split("\n")
    last = [row.split() for row in table if row.strip()][-1]
    assert float(last[3]) > 0, "no breakup"
