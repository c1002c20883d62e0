"""Errors in package.xml files."""

import pytest

from ros2cli.main import main
from turtlewire_ros.manifest import manifest_fault


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("<package>\n<name>p</name>\n</package>\n", None),
        (
            "<package>\n<name>p</name><br>\n<version>0</version>\n</package>\n",
            ":2: <br> is never closed; remove it, or add </br>",
        ),
        (
            "<package>\n<name>p</name>\n",
            ":1: <package> is never closed; remove it, or add </package>",
        ),
        ("<package>\n<name>a & b</name>\n</package>\n", ":2: not well-formed (invalid token)"),
        ("", ":1: no element found"),
        (
            '<!DOCTYPE p [\n<!ENTITY a "b">]>\n<p/>',
            ":2: the declaration of the entity 'a' is not allowed here",
        ),
        ('<?xml version="1.0" encoding="nope"?>\n<p/>', ":1: unknown encoding: nope"),
    ],
)
def test_the_line_and_the_fault(tmp_path, text, fault):
    path = tmp_path / "package.xml"
    path.write_text(text)
    assert manifest_fault(path) == (fault and f"{path}{fault}")


def test_ros2_pkg_xml_says_so_in_one_line(tmp_path, monkeypatch, capsys):
    for folder in ("share/ament_index/resource_index/packages", "share/broken"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "share/ament_index/resource_index/packages/broken").touch()
    manifest = tmp_path / "share/broken/package.xml"
    manifest.write_text("<package>\n<name>broken</name><br>\n</package>\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert main(["pkg", "xml", "broken", "--tag", "name"]) == 1
    assert capsys.readouterr() == (
        "",
        f"{manifest}:2: <br> is never closed; remove it, or add </br>\n",
    )
    manifest.unlink()
    assert main(["pkg", "xml", "broken"]) == 1
    assert capsys.readouterr() == ("", "Package XML manifest not found\n")
