"""`scripts/release`: its fast parts; a release tests the rest."""

import json
import re
import tarfile
import zipfile

import pytest
import release
import release_checks as checks
import release_wheels as wheels
from tests.places import ROOT


@pytest.fixture
def sources(monkeypatch, tmp_path):
    """Two projects and a CHANGELOG in an empty folder."""
    monkeypatch.setattr(release, "ROOT", tmp_path)
    monkeypatch.setattr(release, "PROJECTS", {"one": tmp_path, "two": tmp_path / "ros"})
    (tmp_path / "ros").mkdir()
    for folder in (tmp_path, tmp_path / "ros"):
        (folder / "pyproject.toml").write_text('[project]\nversion = "1.2.0"\n')
    (tmp_path / "CHANGELOG.md").write_text(
        "# Changelog\n\n## Unreleased\n\n- New.\n\n## 1.1.0\n\n- Old.\n"
    )
    return tmp_path


def test_the_version_of_the_sources_is_one():
    assert re.fullmatch(r"\d+\.\d+\.\d+", release.version_of_all())


def test_different_versions_are_no_release(sources):
    assert release.version_of_all() == "1.2.0"
    other = 'version = "1.2.0"\ndependencies = [\n    "turtlewire==1.1.0",\n]\n'
    (sources / "ros" / "pyproject.toml").write_text(other)
    with pytest.raises(release.ReleaseError, match=r"different versions: 1\.1\.0, 1\.2\.0"):
        release.version_of_all()


def test_a_version_is_set_in_each_project_and_requirement(sources):
    requires = (
        'version = "1.2.0"\ndependencies = [\n    "turtlewire==1.2.0",\n    "six==1.2.0",\n]\n'
    )
    (sources / "ros" / "pyproject.toml").write_text(requires)
    release.set_version("1.3.0rc1")
    assert release.version_of_all() == "1.3.0rc1"
    text = (sources / "ros" / "pyproject.toml").read_text()
    assert '"turtlewire==1.3.0rc1"' in text
    assert '"six==1.2.0"' in text
    with pytest.raises(release.ReleaseError, match="is not a version such as"):
        release.set_version("1.3")
    assert release.version_of_all() == "1.3.0rc1"


def test_other_bytes_of_a_second_build_are_no_release(tmp_path):
    for name, content in {"a": b"x", "b": b"x", "c": b"y"}.items():
        (tmp_path / name).write_bytes(content)
    release.check_again(tmp_path / "a", tmp_path / "b")
    with pytest.raises(release.ReleaseError, match="a has other bytes when it is built again"):
        release.check_again(tmp_path / "a", tmp_path / "c")


def test_the_notes_are_the_section_of_the_version_or_what_is_unreleased(sources):
    assert release.notes("1.1.0") == "# turtlewire 1.1.0\n\n- Old.\n"
    assert release.notes("1.2.0") == "# turtlewire 1.2.0\n\n- New.\n"
    (sources / "CHANGELOG.md").write_text("# Changelog\n\n## 1.1.0\n\n- Old.\n")
    with pytest.raises(release.ReleaseError, match=r"no section .1\.2\.0."):
        release.notes("1.2.0")


def test_a_step_that_fails_shows_what_it_printed(capsys):
    with pytest.raises(release.ReleaseError, match="the step failed, see above"):
        release.run("python3", "-c", "print('why'); raise SystemExit(3)", what="the step")
    assert "why" in capsys.readouterr().err


def test_an_unknown_python_is_refused(monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["release", "--python", "3.9"])
    with pytest.raises(SystemExit) as ended:
        release.main()
    assert ended.value.code == 2
    assert "3.9" in capsys.readouterr().err


def test_one_wheel_is_for_python_3_12_and_all_later_ones():
    pythons = {version: f"/python{version}" for version in wheels.VERSIONS}
    made = wheels.targets(pythons, ("x86_64", "aarch64"))
    for machine in ("x86_64", "aarch64"):
        found = {target.tag: target.python for target in made if target.machine == machine}
        assert found == {
            "cp310-cp310": "/python3.10",
            "cp311-cp311": "/python3.11",
            "cp312-abi3": "/python3.12",
            "cp313-cp313t": "/python3.13t",
            "cp314-cp314t": "/python3.14t",
        }
    assert len(made) == 10


def test_a_machine_asked_for_needs_its_compiler(monkeypatch, capsys):
    monkeypatch.setattr(wheels, "here", lambda: "x86_64")
    monkeypatch.setattr(wheels.sys, "platform", "linux")
    monkeypatch.setattr(wheels.shutil, "which", lambda name: None)
    with pytest.raises(wheels.ReleaseError, match=r"apt install g\+\+-aarch64-linux-gnu"):
        wheels.possible_machines(("aarch64",))
    assert wheels.possible_machines(wheels.MACHINES) == ("x86_64",)
    assert "no such wheels" in capsys.readouterr().err


def zipped(path, *names):
    with zipfile.ZipFile(path, "w") as archive:
        for name in names:
            archive.writestr(name, "")
    return path


GOOD = (
    "turtlewire/__init__.py",
    "turtlewire-1.dist-info/METADATA",
    "turtlewire-1.dist-info/sboms/sbom.cdx.json",
    "turtlewire/_native.abi3.so",
)


def test_a_wheel_holds_its_package_and_one_compiled_module(tmp_path):
    checks.check_wheel(zipped(tmp_path / "good.whl", *GOOD), "turtlewire")
    checks.check_wheel(zipped(tmp_path / "pure.whl", "rclpy/node.py", "tf2_ros/a.py"), None)


@pytest.mark.parametrize(
    ("names", "package", "told"),
    [
        ((*GOOD, "tests/test_buffer.py"), "turtlewire", "tests/test_buffer.py"),
        ((*GOOD, "turtlewire/__pycache__/a.pyc"), "turtlewire", "__pycache__"),
        ((*GOOD, "turtlewire/libother.so"), "turtlewire", "libother.so"),
        ((GOOD[0], *GOOD[3:]), "turtlewire", "what is linked into it"),
        (GOOD[:3], "turtlewire", "one compiled module, not 0"),
        (("rclpy/node.py", "rclpy/node.so"), None, "node.so"),
    ],
)
def test_a_wheel_with_anything_else_is_refused(tmp_path, names, package, told):
    with pytest.raises(checks.ReleaseError, match=re.escape(told)):
        checks.check_wheel(zipped(tmp_path / "bad.whl", *names), package)


def test_an_sdist_holds_sources_alone(tmp_path):
    (tmp_path / "a.py").write_text("")
    for name, inside in (("good", "p-1/src/a.py"), ("bad", "p-1/src/_native.so")):
        with tarfile.open(tmp_path / f"{name}.tar.gz", "w:gz") as archive:
            archive.add(tmp_path / "a.py", inside)
    checks.check_sdist(tmp_path / "good.tar.gz")
    with pytest.raises(checks.ReleaseError, match=r"src/_native\.so"):
        checks.check_sdist(tmp_path / "bad.tar.gz")


def test_the_bill_of_materials_of_the_view_lists_what_is_vendored():
    view = ROOT / "packages" / "turtlewire-view"
    listed = json.loads((view / "sbom.cdx.json").read_text())["components"]
    vendored = {path.name for path in (view / "src/turtlewire_view/page/vendor").iterdir()}
    assert {f"{each['name']}-{each['version']}" for each in listed} == vendored
