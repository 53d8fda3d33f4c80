"""What several tests share."""

from __future__ import annotations

import pytest
from hypothesis import settings
from clusterdem.cli import main

settings.register_profile("plain", database=None, deadline=None)  # leaves no folder behind
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
