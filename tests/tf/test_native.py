"""The C++ tests of the core (native/tests), plain and under the sanitizers."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

NATIVE = Path(__file__).parents[2] / "native"
SANITIZERS = {
    "plain": "",
    "address": "-fsanitize=address,undefined -fno-sanitize-recover=all",
    "thread": "-fsanitize=thread",
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
        pytest.skip("no CMake or no C++ compiler on this machine")
    flags = f"-g -O1 {SANITIZERS[sanitizer]}" if sanitizer != "plain" else ""
    options = ["-DTURTLEWIRE_MODULE=OFF", "-DTURTLEWIRE_TESTS=ON", f"-DCMAKE_CXX_FLAGS={flags}"]
    if sanitizer != "plain":
        options.append("-DCMAKE_BUILD_TYPE=None")
    folder = NATIVE.parent / "build" / "core-tests" / sanitizer  # kept: only changes are compiled
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
    run = subprocess.run(
        [str(folder / "tests" / "test_core"), messages],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.endswith("all passed\n")


@pytest.mark.skipif(not (NATIVE.parent / ".git").exists(), reason="not a clone")
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
