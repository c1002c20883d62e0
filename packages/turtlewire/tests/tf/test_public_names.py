"""The public names of ``import turtlewire``."""

from __future__ import annotations

import importlib.metadata

import pytest

import turtlewire


def test_dir_lists_the_public_names() -> None:
    assert dir(turtlewire) == ["Buffer", "Transform", "__version__", "connect", "show"]
    for name in dir(turtlewire):
        assert getattr(turtlewire, name) is not None


def test_version() -> None:
    assert turtlewire.__version__ == importlib.metadata.version("turtlewire")


def test_other_names_are_errors() -> None:
    with pytest.raises(AttributeError, match="'turtlewire' has no attribute 'Bufer'"):
        _ = turtlewire.Bufer  # type: ignore[attr-defined]
