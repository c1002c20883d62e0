"""The sentence says what the numbers say."""

from __future__ import annotations

import math

import pytest

from turtlewire_view.words import transform_in_words

SAME = (0.0, 0.0, 0.0, 1.0)
LEFT = (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4))


@pytest.mark.parametrize(
    ("translation", "rotation", "sentence"),
    [
        ((0, 0, 0), SAME, "a is where b is, and looks the same way."),
        ((2, 0, 0), SAME, "a is 2.00 m ahead of b, and looks the same way."),
        ((-2, 0, 0), SAME, "a is 2.00 m behind b, and looks the same way."),
        (
            (1, 0.5, 0),
            LEFT,
            "a is 1.00 m ahead and 0.50 m to the left of b, and looks 90° further to the left.",
        ),
        (
            (1, 0, 0.25),
            (0.0, 0.0, -LEFT[2], LEFT[3]),
            "a is 1.00 m ahead and 0.25 m above b, and looks 90° further to the right.",
        ),
        ((0, 0, 1), (LEFT[2], 0, 0, LEFT[3]), "a is 1.00 m above b, and is turned by 90°."),
        ((math.nan, 0, 0), SAME, "a has no finite position in b."),
    ],
)
def test_sentences(translation, rotation, sentence):
    assert transform_in_words("a", "b", translation, rotation) == sentence
