from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.tf.tidy_tree import tidy_positions


@st.composite
def forests(draw):
    """Each node hangs on an earlier one, or on none."""
    names = [f"n{i}" for i in range(draw(st.integers(1, 30)))]
    children, roots = {name: [] for name in names}, []
    for i, name in enumerate(names):
        parent = draw(st.integers(-1, i - 1))
        (roots if parent < 0 else children[names[parent]]).append(name)
    return roots, children, {name: draw(st.floats(1, 100)) for name in names}


@given(forests(), st.floats(0, 20))
def test_rows_keep_order_and_parents_are_centred(forest, gap):
    roots, children, sizes = forest
    positions = tidy_positions(roots, children, sizes, gap)
    assert positions.keys() == sizes.keys()
    rows = {}
    for name, (place, row) in positions.items():
        rows.setdefault(row, []).append((place - sizes[name] / 2, place + sizes[name] / 2))
    for row in rows.values():
        row.sort()
        assert all(right + gap <= left + 1e-6 for (_, right), (left, _) in itertools.pairwise(row))
    assert min(left for row in rows.values() for left, _ in row) == pytest.approx(0.0, abs=1e-6)
    for parent, below in children.items():
        places = [positions[child][0] for child in below]
        assert places == sorted(places)
        assert all(positions[child][1] == positions[parent][1] + 1 for child in below)
        if below:
            assert positions[parent][0] == pytest.approx((places[0] + places[-1]) / 2)


def test_by_hand():
    positions = tidy_positions(
        ["a"],
        {"a": ["b", "c"], "b": [], "c": ["d"], "d": []},
        {"a": 10, "b": 20, "c": 20, "d": 60},
        4,
    )
    assert positions == {"b": (10.0, 1), "c": (34.0, 1), "a": (22.0, 0), "d": (34.0, 2)}


def test_a_chain_may_be_longer_than_pythons_stack():
    names = [f"n{i}" for i in range(3000)]
    children = {name: [below] for name, below in itertools.pairwise(names)} | {names[-1]: []}
    positions = tidy_positions(names[:1], children, dict.fromkeys(names, 10.0), 4)
    assert positions[names[-1]] == (5.0, 2999)


def test_nothing():
    assert tidy_positions([], {}, {}, 4) == {}
