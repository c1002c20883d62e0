import pytest

from turtlewire.wording import counted


@pytest.mark.parametrize(
    ("count", "text"),
    [(0, "0 links"), (1, "1 link"), (2, "2 links"), (-1, "-1 links"), (2000, "2,000 links")],
)
def test_a_noun_is_plural_unless_it_is_one(count, text):
    assert counted(count, "link") == text
