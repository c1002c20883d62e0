"""The tests that pytest finds in packages created by `ros2 pkg create` of a real ROS 2."""

import subprocess
import sys

LINTERS = {
    "copyright": "from ament_copyright.main import main",
    "flake8": "from ament_flake8.main import main_with_errors",
    "pep257": "import ament_pep257.main",
}
LINTER_TEST = """{line}
import pytest


@pytest.mark.{name}
@pytest.mark.linter
def test_{name}():
    assert False, "not to be run here"
"""


def pytest_in(folder, *words):
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-W", "error", "-p", "no:cacheprovider", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )


def test_tests_of_absent_linters_are_skipped(tmp_path):
    for name, line in LINTERS.items():
        text = LINTER_TEST.format(name=name, line=line)
        (tmp_path / f"test_{name}.py").write_text(text)
    (tmp_path / "test_own.py").write_text(
        "import pytest\n\n\n@pytest.mark.linter\ndef test_own():\n    pass\n"
    )
    done = pytest_in(tmp_path, "-rs")
    assert "1 passed, 3 skipped" in done.stdout, done.stdout + done.stderr
    assert "a ROS 2 linter, which is not included" in done.stdout
    assert done.returncode == 0


def test_a_linter_that_is_there_is_used(tmp_path):
    (tmp_path / "ament_flake8").mkdir()
    (tmp_path / "ament_flake8/__init__.py").touch()
    (tmp_path / "ament_flake8/main.py").write_text("def main_with_errors(): return 5\n")
    (tmp_path / "test_flake8.py").write_text(
        "from ament_flake8.main import main_with_errors\n\n\n"
        "def test_it():\n    assert main_with_errors() == 5\n"
    )
    done = pytest_in(tmp_path)
    assert "1 passed" in done.stdout, done.stdout + done.stderr
