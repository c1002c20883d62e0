"""The examples of the how-to pages, run."""

import doctest

import pytest
from tests.places import HOW_TO

import tf2_geometry_msgs  # noqa: F401 -- registers what the page names
import tf2_ros
import tf2_sensor_msgs  # noqa: F401
from tf2_tools import view_frames


@pytest.mark.parametrize(
    ("page", "examples"), [("transform_messages.md", 25), ("view_frames.md", 4)]
)
def test_the_examples_do_what_the_page_says(page, examples):
    failed, tried = doctest.testfile(str(HOW_TO / page), module_relative=False)
    assert (failed, tried) == (0, examples)


def test_the_page_names_every_type_that_a_buffer_takes():
    page = (HOW_TO / "transform_messages.md").read_text()
    for kind in tf2_ros.TransformRegistration._transforms:
        if kind.__module__.startswith(("geometry_msgs.", "sensor_msgs.", "nav_msgs.")):
            assert f"`{kind.__name__}`" in page or f"/{kind.__name__}`" in page


def test_the_page_names_every_option_of_view_frames(capsys):
    page = (HOW_TO / "view_frames.md").read_text()
    with pytest.raises(SystemExit):
        view_frames.main(["view_frames", "--help"])
    options = {
        word.strip("[],")
        for word in capsys.readouterr().out.split()
        if word.strip("[,").startswith("--")
    }
    assert len(options) == 6
    assert all(f"`{option}" in page or f", `{option}" in page for option in options - {"--help"})
