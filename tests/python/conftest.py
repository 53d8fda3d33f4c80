"""What several tests share."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from clusterdem.cli import main
from hypothesis import settings
from hypothesis.configuration import set_hypothesis_home_dir

# leave no folder behind
set_hypothesis_home_dir(Path(tempfile.gettempdir()) / "hypothesis")
settings.register_profile("plain", database=None, deadline=None)
settings.load_profile("plain")


@pytest.fixture
def command(capsys):
    """Run a command line in this process: exit code, stdout, stderr."""

    def run(*arguments):
        try:
            code = main([str(argument) for argument in arguments])
        except SystemExit as stop:  # argparse
            code = stop.code
        out, err = capsys.readouterr()
        return code, out, err

    return run
