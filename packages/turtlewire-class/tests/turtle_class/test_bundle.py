"""The folder for a USB stick: built from a wheelhouse, installed and used without a network."""

import os
import shutil
import subprocess
import sys
import zipfile

import pytest
from tests.places import ROOT, TOOLS

WHEELHOUSE = ROOT / "build/wheelhouse" / f"{sys.version_info.major}.{sys.version_info.minor}"
UP = "ip link set lo up"


def bundle(output, *words):
    command = [sys.executable, str(TOOLS / "bundle.py"), "--output", str(output)]
    return subprocess.run([*command, *map(str, words)], capture_output=True, text=True, check=False)


@pytest.fixture
def fake_wheels(tmp_path):
    """The names of wheels for a Python that is none."""
    folder = tmp_path / "fake"
    folder.mkdir()
    for name in ("turtlewire-0.1.0-cp32-cp32-win_amd64.whl", "turtlewire_class-0.1.0-py3.whl"):
        (folder / name).touch()
    return folder


@pytest.mark.slow
def test_it_holds_what_a_class_needs(tmp_path, fake_wheels):
    done = bundle(tmp_path, "--wheels", fake_wheels)
    assert done.returncode == 0, done.stderr
    assert "turtlewire-class.zip: " in done.stdout
    folder = tmp_path / "turtlewire-class"
    assert (folder / "exercises/static/static_frame_broadcaster.py").exists()
    assert (folder / "docs/how-to/classroom.md").exists()
    assert (folder / "classroom_template/.github/workflows/classroom.yml").exists()
    with zipfile.ZipFile(tmp_path / "turtlewire-class.zip") as packed:
        modes = {info.filename: info.external_attr >> 16 for info in packed.infolist()}
    assert modes["turtlewire-class/start"] & 0o111
    assert "turtlewire-class/wheels/turtlewire_class-0.1.0-py3.whl" in modes


def test_start_says_which_computers_it_is_for(tmp_path, fake_wheels):
    bundle(tmp_path, "--wheels", fake_wheels)
    done = subprocess.run(
        ["sh", tmp_path / "turtlewire-class/start", "--into", tmp_path / "venv"],
        env={**os.environ, "PYTHON": sys.executable},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "The folder has wheels for: Python 3.2 on win_amd64." in done.stderr
    assert not (tmp_path / "venv").exists()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--wheels", "nothing"], "[bundle] nothing holds no wheel of turtlewire-class"),
        (["--python", "python9"], "[bundle] there is no program python9"),
    ],
)
def test_without_what_it_needs_an_older_bundle_stays(tmp_path, words, told):
    older = tmp_path / "turtlewire-class" / "wheels" / "older.whl"
    older.parent.mkdir(parents=True)
    older.touch()
    done = bundle(tmp_path, *words)
    assert (done.returncode, done.stderr.splitlines()) == (1, [told])
    assert older.exists()


def why_not():
    """Return why it cannot be installed here; empty if it can."""
    if not list(WHEELHOUSE.glob("turtlewire_class-*.whl")):
        return f"needs wheels in {WHEELHOUSE.relative_to(ROOT)}: scripts/smoke makes them"
    probe = subprocess.run(f"unshare -n {UP}", shell=True, capture_output=True, check=False)
    return "a separate network needs root, unshare and ip" if probe.returncode else ""


@pytest.mark.slow
@pytest.mark.skipif(bool(why_not()), reason=why_not())
def test_without_a_network_it_installs_runs_the_demo_and_grades(tmp_path):
    done = bundle(tmp_path, "--wheels", WHEELHOUSE)
    assert done.returncode == 0, done.stderr
    folder, venv = tmp_path / "turtlewire-class", tmp_path / "home" / "turtlewire-class"
    venv.parent.mkdir()
    student = tmp_path / "student"
    shutil.copytree(folder / "classroom_template", student)
    shutil.copytree(folder / "wheels", student / "wheelhouse")
    script = f"""
    set -e
    {UP}
    {folder}/start --seconds 10
    {venv}/bin/turtlewire class check {folder}/exercises -e static || test $? = 1
    {student}/install
    {student}/.venv/bin/turtlewire class list
    """
    done = subprocess.run(
        ["unshare", "-n", "bash", "-c", script],
        env={
            "HOME": str(venv.parent),
            "PATH": os.environ["PATH"],
            "PYTHON": sys.executable,
            "TURTLEWIRE_BROWSER": "0",
            "TURTLEWIRE_PORT": "0",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert "static: " in done.stdout
    assert "camera " in done.stdout
    assert "turtlesim" in done.stdout + done.stderr
