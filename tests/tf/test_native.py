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


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("sanitizer", SANITIZERS)
def test_core(sanitizer: str, tmp_path: Path) -> None:
    if shutil.which("cmake") is None or (
        shutil.which("g++") is None and shutil.which("clang++") is None
    ):
        pytest.skip("no CMake or no C++ compiler on this machine")
    flags = f"-g -O1 {SANITIZERS[sanitizer]}" if sanitizer != "plain" else ""
    options = ["-DTURTLEWIRE_MODULE=OFF", "-DTURTLEWIRE_TESTS=ON", f"-DCMAKE_CXX_FLAGS={flags}"]
    if sanitizer != "plain":
        options.append("-DCMAKE_BUILD_TYPE=None")
    subprocess.run(
        ["cmake", "-S", str(NATIVE), "-B", str(tmp_path), *options], check=True, capture_output=True
    )
    subprocess.run(
        ["cmake", "--build", str(tmp_path), "--parallel", "2"], check=True, capture_output=True
    )
    messages = "20000" if sanitizer == "thread" else "1000000"
    environment = {
        **os.environ,
        "TSAN_OPTIONS": "halt_on_error=1",
        "ASAN_OPTIONS": "detect_leaks=1",
    }
    run = subprocess.run(
        [str(tmp_path / "tests" / "test_core"), messages],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.endswith("all passed\n")
