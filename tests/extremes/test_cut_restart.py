"""A restart file cut short is refused with a message."""

import pytest
from cut_restart import fault_when_read, lengths, written


@pytest.mark.parametrize("np_", [1, 2])
def test_cut_anywhere(tmp_path, np_):
    whole = written(tmp_path, np_).read_bytes()
    for length in lengths(len(whole), 11, seed=np_):
        (tmp_path / "cut.restart").write_bytes(whole[:length])
        assert fault_when_read(tmp_path, "cut.restart", np_) == "", f"{length} of {len(whole)} bytes"
