"""The C++ tests (native/tests), plain and under the sanitizers."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from tests.needs import COMPILED_CORE
from tests.places import ENGINE, ROOT, TOOLS

from turtlewire.tf.buffer import CORE

if TYPE_CHECKING:
    from pathlib import Path

NATIVE = ENGINE / "native"
SANITIZERS = {
    "plain": "",
    "address": "-fsanitize=address,undefined -fno-sanitize-recover=all",
    "thread": "-fsanitize=thread -DTURTLEWIRE_READER_LOCKS=8",
}


@pytest.mark.timeout(1200)
@pytest.mark.parametrize(
    "sanitizer",
    [
        "plain",
        pytest.param("address", marks=pytest.mark.slow),
        pytest.param("thread", marks=pytest.mark.slow),
    ],
)
def test_core(sanitizer: str) -> None:
    if shutil.which("cmake") is None or (
        shutil.which("g++") is None and shutil.which("clang++") is None
    ):
        pytest.skip("needs CMake and a C++ compiler (Debian: apt install cmake g++)")
    flags = f"-g -O1 {SANITIZERS[sanitizer]}" if sanitizer != "plain" else ""
    options = ["-DTURTLEWIRE_MODULE=OFF", "-DTURTLEWIRE_TESTS=ON", f"-DCMAKE_CXX_FLAGS={flags}"]
    if sanitizer != "plain":
        options.append("-DCMAKE_BUILD_TYPE=None")
    else:  # the core as one translation unit: half the time of compilation
        options += ["-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=0"]
    folder = ROOT / "build" / "core-tests" / sanitizer  # kept: only changes are compiled
    for command in (
        ["cmake", "-S", str(NATIVE), "-B", str(folder), *options],
        ["cmake", "--build", str(folder), "--parallel", "2"],
    ):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
    messages = {"plain": "50000", "address": "1000000", "thread": "20000"}[sanitizer]
    environment = {
        **os.environ,
        "TSAN_OPTIONS": "halt_on_error=1",
        "ASAN_OPTIONS": "detect_leaks=1",
    }
    for program in ("test_core", "test_identities"):
        run = subprocess.run(
            [str(folder / "tests" / program), messages],
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert run.returncode == 0, run.stdout + run.stderr
        assert run.stdout.endswith("all passed\n")


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="not a clone")
def test_a_build_leaves_nothing_beside_the_sources() -> None:
    unknown = subprocess.run(
        ["git", "ls-files", "--others", "--", str(NATIVE)],
        cwd=NATIVE,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    build_files = [line for line in unknown.splitlines() if not line.endswith((".cpp", ".hpp"))]
    assert build_files == []


def test_the_core_knows_neither_messages_nor_python() -> None:
    """Messages and records are feeds; those stand on the core, and the bindings on both."""
    included = {
        folder: {
            line.split('"')[1]
            for path in (NATIVE / folder).iterdir()
            for line in path.read_text(encoding="utf-8").splitlines()
            if line.startswith('#include "')
        }
        for folder in ("core", "feeds")
    }
    own = {folder: {path.name for path in (NATIVE / folder).iterdir()} for folder in included}
    assert included["core"] <= own["core"]
    assert included["feeds"] <= own["feeds"] | {f"../core/{name}" for name in own["core"]}
    for path in (NATIVE / "core").iterdir():
        assert not re.search("TFMessage|JointState|Python.h", path.read_text(encoding="utf-8")), (
            path
        )


STUB = ENGINE / "src" / "turtlewire" / "_native.pyi"


def compared(stub: Path) -> tuple[int, list[str]]:
    done = subprocess.run(
        [sys.executable, str(TOOLS / "native_stub.py"), str(stub)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert not done.stderr
    return done.returncode, done.stdout.splitlines()


def test_the_stub_agrees_with_the_module() -> None:
    code, lines = compared(STUB)
    assert code == 0, lines


@pytest.mark.skipif(CORE != "native", reason=COMPILED_CORE)
@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("def _wake(self)", "def awake(self)", "Buffer.awake: declared (), built not at all"),
        (
            "child_frame: str) -> bool",
            "child: str) -> bool",
            "declared (child), built (child_frame)",
        ),
        ("timeout_ns: Span = 0", "timeout_ns: Span = 1", "timeout_ns=1"),
        ("    @property\n    def messages", "    def messages", "built an attribute"),
        ("def print_on_abort(pipe: int) -> None: ...", "", "declared not at all, built (pipe)"),
    ],
)
def test_a_stub_that_differs_is_refused(tmp_path: Path, old: str, new: str, fault: str) -> None:
    text = STUB.read_text(encoding="utf-8")
    assert old in text
    changed = tmp_path / "_native.pyi"
    changed.write_text(text.replace(old, new), encoding="utf-8")
    code, lines = compared(changed)
    assert code == 1
    assert any(fault in line for line in lines), lines
