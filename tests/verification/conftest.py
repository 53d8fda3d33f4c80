import os
from pathlib import Path

import pytest
from verification_case import VerificationCase


@pytest.fixture
def case(request, tmp_path):
    """The case that the test file stands for, with a scratch folder of this test."""
    results = os.environ.get("CLUSTERDEM_VERIFY")
    return VerificationCase(request.path.parent, tmp_path, Path(results) if results else None)
