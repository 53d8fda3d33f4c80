"""What several tests share."""

from __future__ import annotations

import pytest
from clusterdem.cli import main


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
