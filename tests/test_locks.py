"""`tools/locks` names a release, with hashes, of all that CI and a release install."""

import ast
import re
import sys

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from tests.places import ROOT, TOOLS

if sys.version_info < (3, 11):
    pytest.skip("tomllib comes with Python 3.11", allow_module_level=True)
import tomllib

OWN = {"turtlewire", "turtlewire-ros", "turtlewire-class", "learning-tf2-py"}


def locked(name, folder="tools/locks"):
    """The releases in a file: name and versions; each has a hash."""
    text = (ROOT / folder / f"{name}.txt").read_text(encoding="utf-8")
    assert "://" not in text
    assert "index-url" not in text
    releases = {}
    for entry in re.split(r"\n(?! )", text.strip()):
        first, *hashes = entry.replace("\\\n", "\n").split("\n")
        assert hashes, entry
        assert all(re.fullmatch(r" +--hash=sha256:[0-9a-f]{64} *", line) for line in hashes), entry
        requirement = Requirement(first)
        [version] = requirement.specifier
        assert version.operator == "=="
        releases.setdefault(canonicalize_name(requirement.name), []).append(version.version)
    return releases


def assert_covered(lock, wanted):
    releases = locked(lock)
    for requirement in map(Requirement, wanted):
        name = canonicalize_name(requirement.name)
        if name not in OWN:
            assert any(requirement.specifier.contains(each) for each in releases[name]), name


def project(folder):
    return tomllib.loads((ROOT / folder / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def names(module, variable):
    """A tuple of a script."""
    tree = ast.parse((TOOLS / f"{module}.py").read_text(encoding="utf-8"))
    [value] = [
        node.value
        for node in tree.body
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == variable
    ]
    return ast.literal_eval(value)


def test_ci():
    wanted = project("packages/turtlewire-colcon")["optional-dependencies"]["workspace"]
    for path in ROOT.glob("packages/*/pyproject.toml"):
        wanted += project(path.parent)["dependencies"]
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    wanted += settings["dependency-groups"]["test"] + settings["dependency-groups"]["lint"]
    assert_covered("ci", wanted)


def test_a_release():
    assert_covered("build", names("release_wheels", "BACKEND"))
    assert_covered("release", names("release_checks", "TOOLS"))
    assert_covered("wheels", ["cibuildwheel>=3,<4"])


def test_each_distribution_ships_the_licence():
    licence = (ROOT / "LICENSE").read_text(encoding="utf-8")
    for path in ROOT.glob("packages/*/pyproject.toml"):
        assert (path.parent / "LICENSE").read_text(encoding="utf-8") == licence


@pytest.mark.parametrize("distro", ["jazzy", "kilted"])
def test_real_nodes(distro):
    releases = locked(distro, "tests/peers")
    for package in ("rclpy", "rmw-fastrtps-cpp", "common-interfaces", "test-msgs"):
        assert len(releases[f"ros-{distro}-{package}"]) == 1
    script = (ROOT / "scripts" / "peers").read_text(encoding="utf-8")
    assert "--no-deps --require-hashes" in script


def test_actions_are_pinned_by_commit():
    files = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
    used = [
        line
        for file in files
        for line in file.read_text(encoding="utf-8").splitlines()
        if re.match(r"\s*(- )?uses:", line)
    ]
    assert len(used) > len(files) == 3
    for line in used:
        assert re.fullmatch(r"\s*(- )?uses: [\w/-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", line), line


def test_ci_installs_what_is_locked():
    text = (ROOT / ".github" / "workflows" / "check.yml").read_text(encoding="utf-8")
    installs = re.findall(r"pip install (?:.|\n(?! *- | *\w+:))*", text)
    assert installs
    for words in installs:
        assert "--require-hashes" in words or "--no-deps --no-build-isolation" in words, words
