"""The index of installed packages."""

import argparse
from pathlib import Path

import pytest

import ament_index_python
from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
)


@pytest.fixture
def index(tmp_path, monkeypatch):
    folder = tmp_path / "share/ament_index/resource_index"
    (folder / "packages").mkdir(parents=True)
    (folder / "packages/my_pkg").touch()
    (folder / "plugins").mkdir()
    (folder / "plugins/my_pkg").write_text("some content\n", encoding="utf-8")
    (tmp_path / "share/my_pkg").mkdir()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    return tmp_path


def test_a_package_and_its_folders(index):
    assert get_package_prefix("my_pkg") == str(index)
    assert get_package_share_directory("my_pkg") == str(index / "share/my_pkg")
    assert ament_index_python.get_package_share_path("my_pkg") == index / "share/my_pkg"
    assert ament_index_python.get_packages_with_prefixes()["my_pkg"] == str(index)


def test_a_package_that_is_not_there(index):
    with pytest.raises(PackageNotFoundError) as error:
        get_package_share_directory("nope")
    assert isinstance(error.value, KeyError)
    assert str(error.value).startswith(f"\"package 'nope' not found, searching: ['{index}'")


@pytest.mark.parametrize("name", ["", "a/b", ".."])
def test_names_that_are_no_package_names(index, name):
    with pytest.raises(ValueError, match="package name"):
        get_package_prefix(name)


def test_a_missing_share_folder_is_warned_of(index):
    (index / "share/my_pkg").rmdir()
    with pytest.warns(UserWarning, match="does not exist"):
        get_package_share_directory("my_pkg")
    assert get_package_share_directory("my_pkg", print_warning=False) == str(index / "share/my_pkg")


def test_resources(index):
    assert ament_index_python.get_resource("plugins", "my_pkg") == ("some content\n", str(index))
    assert ament_index_python.get_resources("plugins") == {"my_pkg": str(index)}
    assert ament_index_python.has_resource("plugins", "nope") is False
    assert {"packages", "plugins"} <= ament_index_python.get_resource_types()
    with pytest.raises(LookupError, match="Could not find the resource 'nope' of type 'plugins'"):
        ament_index_python.get_resource("plugins", "nope")


def test_names_with_separators_are_refused(index):
    with pytest.raises(ament_index_python.InvalidResourceNameError):
        ament_index_python.get_resource("plugins", "../x")
    with pytest.raises(ament_index_python.InvalidResourceTypeNameError):
        ament_index_python.get_resources("a/b")


def test_without_any_prefix_the_variable_is_named(monkeypatch):
    monkeypatch.setattr("turtlewire_ros.prefix.own_prefix", lambda: None)
    monkeypatch.setenv("AMENT_PREFIX_PATH", "")
    with pytest.raises(
        EnvironmentError, match=r"^Environment variable 'AMENT_PREFIX_PATH' is not set or empty$"
    ):
        ament_index_python.get_search_paths()


def test_prefixes_that_do_not_exist_are_left_out(index, monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{index}")
    assert ament_index_python.get_search_paths()[0] == str(index)
    assert all(Path(path).is_dir() for path in ament_index_python.get_search_paths())


def test_the_command_line(capsys):
    from ament_index_python.cli import main, resource_name_completer, resource_type_completer

    assert main([]) is None
    assert "packages\n" in capsys.readouterr().out
    assert main(["packages"]) is None
    assert "turtlesim\t" in capsys.readouterr().out
    assert main(["packages", "turtlesim"]) is None
    assert capsys.readouterr().out
    assert main(["packages", "no_such"]) == (
        "Could not find the resource 'no_such' of type 'packages'"
    )
    assert resource_type_completer("pack") == ["packages"]
    chosen = argparse.Namespace(resource_type="packages")
    assert "turtlesim" in resource_name_completer("turtle", chosen)
