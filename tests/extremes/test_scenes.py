"""A few scenes of every family: the campaign of ./run extremes in small."""

import pytest
from families import FAMILIES
from outcomes import ran

SMALL = [(family.name, k) for family in FAMILIES.values() for k in range(family.small)]


@pytest.mark.parametrize("name, index", SMALL, ids=[f"{name}:{k}" for name, k in SMALL])
def test_scene(tmp_path, name, index):
    outcome = ran(FAMILIES[name].scene(index), tmp_path)
    assert outcome.kind in ("passed", "refused"), f"./run extremes '{name}:{index}': {outcome.why}"


def test_a_scene_is_drawn_from_its_number_alone():
    for family in FAMILIES.values():
        one, other, next_one = family.scene(1), family.scene(1), family.scene(2)
        assert one.script() == other.script() and one.data_file() == other.data_file()
        assert (one.script(), one.data_file()) != (next_one.script(), next_one.data_file())
