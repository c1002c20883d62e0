"""scripts/setup: installing, compiling, unchanged parts, and output."""

from __future__ import annotations

import importlib
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from tests.places import COLCON, ENGINE, SCRIPTS, TOOLS
from tests.programs import run_python

SETUP = TOOLS / "setup.py"


@pytest.fixture
def module(monkeypatch, tmp_path):
    """Imports a module of tools/; what programs print goes to a file of this test."""
    monkeypatch.syspath_prepend(TOOLS)
    monkeypatch.setattr(importlib.import_module("setup_steps"), "LOG", tmp_path / "setup.log")
    return importlib.import_module


@pytest.fixture
def steps(module):
    return module("setup_steps")


@pytest.fixture
def setup(module, monkeypatch, tmp_path):
    """The script, which only notes what it is to do."""
    spec = importlib.util.spec_from_file_location("setup_script", SETUP)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    script.calls = []
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.setattr(module("setup_venv"), "uv_to_use", lambda: None)
    monkeypatch.setattr(module("setup_venv"), "pip", lambda *words, **_: script.calls.append(words))
    wait_for_turn = script.wait_for_turn
    for name, value in (
        ("wait_for_turn", lambda _checkout: wait_for_turn(tmp_path)),  # a set-up may run here
        ("core_key", lambda: "key"),
        ("provide_core", lambda key: script.calls.append(("core", key))),
        ("usable", lambda _stamp, _wanted: True),
        ("STAMP", tmp_path / "stamp.json"),
        ("CORE", tmp_path / "core.so"),
    ):
        monkeypatch.setattr(script, name, value)
    return script


def test_nothing_is_done_twice(setup, capsys):
    setup.main(["workspace"])
    (_install, *words), core = setup.calls
    assert words.count("-e") == len(setup.distributions())
    assert str(ENGINE) in words
    assert core == ("core", "key")
    for extras in (["workspace"], []):
        capsys.readouterr()
        setup.main(extras)
        assert capsys.readouterr().err == "[setup] nothing to do: .venv is up to date\n"
    assert len(setup.calls) == 2  # although there is no core: it does not compile


def test_a_venv_whose_python_is_gone_is_made_anew(setup, monkeypatch, tmp_path):
    setup.main([])
    assert setup.missing([])[1] == {}
    (tmp_path / "python").symlink_to(tmp_path / "removed")
    monkeypatch.setattr(setup, "PYTHON", tmp_path / "python")
    assert setup.missing([])[0] == {}
    assert setup.missing([])[1]


@pytest.mark.parametrize(
    ("stamp", "expected"),
    [
        ({}, True),  # by hand, or by an interrupted set-up
        ({"python": "3", "distributions": ["a"]}, True),
        ({"python": "3", "distributions": ["b"]}, False),
        ({"python": "3"}, False),
        ({"python": "4", "distributions": ["a"]}, False),
    ],
)
def test_another_python_or_other_distributions_need_a_new_venv(module, stamp, expected):
    spec = importlib.util.spec_from_file_location("setup_itself", SETUP)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    assert script.usable(stamp, {"python": "3", "distributions": ["a"]}) == expected


def test_ci_installs_what_is_locked_first(setup, monkeypatch):
    monkeypatch.setenv("CI", "true")
    setup.main(["test"])
    locked, (_install, *words), _core = setup.calls
    assert locked == ("install", "--require-hashes", "-r", str(TOOLS / "locks" / "ci.txt"))
    assert words.count("-e") == len(setup.distributions())


def test_extras_alone_compile_nothing(setup):
    setup.main([])
    setup.calls.clear()
    setup.main(["workspace"])
    setup.main(["lint"])
    assert setup.calls == [
        ("install", "turtlewire-colcon[workspace]"),
        (
            "install",
            "turtlewire-colcon[workspace]",
            "--group",
            f"{setup.ROOT / 'pyproject.toml'}:lint",
        ),
    ]
    assert json.loads(setup.STAMP.read_text())["extras"] == ["lint", "workspace"]


def test_changed_sources_are_installed_with_the_extras_there_are(setup, monkeypatch):
    setup.main(["workspace"])
    setup.calls.clear()
    monkeypatch.setattr(setup, "fingerprint", lambda: "other")
    setup.main([])
    (words,) = setup.calls  # the core is not compiled again
    assert f"{COLCON}[workspace]" in words
    assert words.count("-e") == len(setup.distributions())


def test_a_changed_launch_file_of_a_prefix_is_installed(setup, monkeypatch, tmp_path):
    for name in ("ROOT", "ROS", "ENGINE", "LEARNING"):
        monkeypatch.setattr(setup, name, tmp_path)
    monkeypatch.setattr(setup, "distributions", lambda: [tmp_path])
    monkeypatch.setattr(setup, "packages", list)
    launch_file = tmp_path / "prefix" / "share" / "p" / "launch" / "p.launch.py"
    launch_file.parent.mkdir(parents=True)
    launch_file.write_text("old")
    before = setup.fingerprint()
    launch_file.write_text("new")
    assert setup.fingerprint() != before


def test_changed_native_sources_install_no_package(setup, monkeypatch):
    setup.main([])
    setup.calls.clear()
    monkeypatch.setattr(setup, "core_key", lambda: "other")
    setup.main([])
    assert setup.calls == [("core", "other")]


def test_a_deleted_core_is_compiled_again(setup):
    setup.CORE.touch()
    setup.main([])
    setup.calls.clear()
    setup.main([])
    assert setup.calls == []
    setup.CORE.unlink()
    setup.main([])
    assert setup.calls == [("core", "key")]


def test_an_interrupted_compilation_is_taken_up_again(setup, monkeypatch):
    def interrupted(_key):
        raise KeyboardInterrupt

    provide = setup.provide_core
    monkeypatch.setattr(setup, "provide_core", interrupted)
    assert setup.run([]) == 130
    setup.calls.clear()
    monkeypatch.setattr(setup, "provide_core", provide)
    assert setup.run([]) == 0
    assert setup.calls == [("core", "key")]


def test_a_full_disk_is_one_line(setup, monkeypatch, capfd):
    def full(*_, **__):
        raise OSError(28, "No space left on device", "somewhere")

    monkeypatch.setattr(setup, "install", full)
    assert setup.run([]) == 1
    *_, said = capfd.readouterr().err.splitlines()
    assert said == "[setup] [Errno 28] No space left on device: 'somewhere'"


def test_an_old_python_is_refused_before_it_reads_the_rest():
    code = "import runpy, sys; sys.version_info = (3, 9, 18); sys.version = '3.9.18 (main)'; "
    code += f"runpy.run_path({str(SETUP)!r}, run_name='__main__')"
    done = run_python(code, check=False)
    assert done.returncode == 1
    assert "is Python 3.9.18; 3.10 or newer is needed (PYTHON=python3.12" in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_python_that_is_not_there_is_one_line():
    done = subprocess.run(
        [SCRIPTS / "setup"],
        env={**os.environ, "PYTHON": "python3.not-there"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "there is no python3.not-there on the PATH" in done.stderr
    assert "apt install python3;" in done.stderr
    assert done.stderr.count("\n") == 1


#: What a person types, and no helper of these.
TYPED = sorted(
    path.name
    for path in SCRIPTS.iterdir()
    if path.is_file() and "." not in path.name and path.name != "interruptible"
)


def typed(folder, name, *words, **streams):
    """Type a script's name in a copy of the scripts, with a Python that has no turtlewire."""
    if not (folder / "scripts").exists():
        shutil.copytree(SCRIPTS, folder / "scripts")
        shutil.copytree(TOOLS, folder / "tools")
    (folder / "benchmarks").mkdir(exist_ok=True)
    (folder / "benchmarks" / "bench_one.py").write_text("def rows():")
    environment = {**os.environ, "PYTHON": sys._base_executable}
    environment.pop("PYTHONUNBUFFERED", None)
    return subprocess.run(
        [folder / "scripts" / name, *words],
        env=environment,
        stdout=streams.get("stdout", subprocess.PIPE),
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("name", TYPED)
def test_the_help_of_a_script_does_nothing_else(tmp_path, name):
    for word in ("-h", "--help"):
        done = typed(tmp_path, name, word)
        assert (done.returncode, done.stderr) == (0, "")
        assert done.stdout.startswith(f"usage: scripts/{name} ")
        assert done.stdout.count("\n") > 2
    assert {path.name for path in tmp_path.iterdir()} == {"benchmarks", "scripts", "tools"}


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="/dev/full is of Linux")
@pytest.mark.parametrize("name", TYPED)
def test_the_help_of_a_script_on_a_full_disk_is_one_line(tmp_path, name):
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = typed(tmp_path, name, "--help", stdout=full)
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert "No space left on device" in line


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("lint --fxi", "there is no '--fxi'; usage: scripts/lint [-h] [--fix]"),
        ("lock --check", "there is no '--check'; usage: scripts/lock [-h]"),
        ("npm-tools audit", "there is no 'audit'; usage: scripts/npm-tools [-h]"),
        ("peers jazzy", "there is no 'jazzy'; usage: scripts/peers [-h]"),
        ("picture galery", "there is no 'galery'; usage: scripts/picture [-h] [gallery]"),
        ("smoke 3.12", "there is no '3.12'; usage: scripts/smoke [-h]"),
        ("demo --chek", "Did you mean: --check"),
        ("demo --secnods=3", "Did you mean: --seconds"),
        ("docs --serv", "Did you mean: --serve"),
        ("demo --seconds=abc", "abc is not a time to wait for; give a positive number"),
        ("docs 8000", "unrecognized arguments: 8000"),
        ("docs --port=65536", "65536 is not a port; give a number from 0 to 65535"),
        ("lesson --prot=1", "Did you mean: --port"),
        ("page-audit veiw", "sliders, class, lesson, site, site's page"),
        ("soak --minutes", "argument --minutes: expected one argument"),
        ("soak --minutes=0", "--minutes is between 0.5 and 10000, got 0"),
        ("soak --minutes=-1", "--minutes is between 0.5 and 10000, got -1"),
        ("soak --minutes=nan", "--minutes is between 0.5 and 10000, got nan"),
        ("soak --minute=1", "Did you mean: --minutes"),
        ("bench tf_bufer", "there is no benchmark 'tf_bufer'; scripts/bench --help lists them"),
        ("setup --halp", "Did you mean: --help"),
        ("bundle --no-demoo", "unrecognized arguments: --no-demoo"),
    ],
)
def test_a_script_refuses_a_word_that_it_does_not_know(tmp_path, command, told):
    done = typed(tmp_path, *command.split())
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].endswith(told)
    assert not (tmp_path / ".venv").exists()


class TestPip:
    """The source of the pip in .venv."""

    @pytest.fixture
    def venv(self, module, monkeypatch):
        """A Python as Debian's python3 without python3-venv: no ensurepip, no pip, and no uv."""
        made = module("setup_venv")
        monkeypatch.setattr(made, "find_spec", lambda _name: None)
        monkeypatch.setattr(made, "outer_pip_version", lambda: (0, 0))
        self.programs = {"apt"}
        monkeypatch.setattr(
            made.shutil, "which", lambda name: f"/bin/{name}" if name in self.programs else None
        )
        return made

    def test_ensurepip_comes_first(self, venv, monkeypatch):
        monkeypatch.setattr(venv, "find_spec", lambda _name: "found")
        assert venv.pip_command() == [str(venv.PYTHON), "-m", "ensurepip"]

    def test_uv_does_as_well(self, venv):
        self.programs.add("uv")
        assert venv.pip_command() == [
            *("/bin/uv", "pip", "install", "--python", str(venv.PYTHON), "pip")
        ]

    @pytest.mark.parametrize(
        ("user", "programs", "lists", "told"),
        [
            (0, {"apt"}, ["x_Packages.lz4"], "this line, then|apt install python3-venv"),
            (0, {"apt"}, [], "this line, then|apt update && apt install python3-venv"),
            (7, {"apt", "sudo"}, ["x_Packages"], "this line, then|sudo apt install python3-venv"),
            (
                *(7, {"apt", "sudo"}, []),
                "this line, then|sudo apt update && sudo apt install python3-venv",
            ),
            (7, {"apt"}, ["x_Packages"], "this line as root, then|apt install python3-venv"),
        ],
    )
    def test_otherwise_the_command_is_printed(
        self, setup, venv, monkeypatch, tmp_path, capfd, user, programs, lists, told
    ):
        (tmp_path / "lists").mkdir()
        for name in lists:
            (tmp_path / "lists" / name).touch()
        monkeypatch.setattr(sys.modules["setup_steps"], "APT_LISTS", tmp_path / "lists")
        monkeypatch.setattr(venv.os, "geteuid", lambda: user)
        default = "/usr/bin/python3"
        told_to = venv.how_to_get_pip
        monkeypatch.setattr(venv, "how_to_get_pip", lambda *_: told_to(default, default))
        self.programs = programs
        monkeypatch.setattr(setup, "usable", lambda _stamp, _wanted: False)
        monkeypatch.setattr(setup, "make_venv", lambda _pip: setup.calls.append("made"))
        assert setup.run([]) == 1
        said = capfd.readouterr().err.splitlines()
        sentence, line = told.split("|")
        assert said[0].startswith("[setup] Python's venv package is missing; type ")
        assert sentence in said[0]
        assert said[1:4] == ["", f"    {line}", ""]
        assert setup.calls == []

    def test_a_python_beside_the_default_has_a_package_of_its_own(self, venv):
        default = "/usr/bin/python3.13"
        assert "apt install python3-venv" in venv.how_to_get_pip(default, default)
        assert "apt install python3.12-venv" in venv.how_to_get_pip("/usr/bin/python3.12", default)

    @pytest.mark.parametrize(
        ("python", "programs"), [("/usr/local/bin/python3", {"apt"}), ("/usr/bin/python3", set())]
    )
    def test_apt_is_not_named_where_it_cannot_help(self, venv, python, programs):
        self.programs = programs
        told = venv.how_to_get_pip(python, "/usr/bin/python3")
        assert told.startswith(f"{python} has no ensurepip")
        assert "apt" not in told

    def test_the_pip_of_this_python_does_as_well(self, venv, monkeypatch):
        self.programs.add("uv")
        monkeypatch.setattr(venv, "outer_pip_version", lambda: (22, 3))
        assert venv.pip_command()[:3] == [sys.executable, "-m", "pip"]
        monkeypatch.setattr(venv, "outer_pip_version", lambda: (22, 2))
        assert venv.pip_command()[0] == "/bin/uv"


class TestUv:
    """When uv installs the packages instead of pip."""

    @pytest.fixture
    def venv(self, module, monkeypatch):
        made = module("setup_venv")
        self.told, self.run = "", []
        monkeypatch.delenv("CI", raising=False)
        monkeypatch.setattr(made.shutil, "which", lambda name: f"/bin/{name}")
        monkeypatch.setattr(
            made, "run_python", lambda *_: subprocess.CompletedProcess((), 0, self.told, "")
        )
        monkeypatch.setattr(made, "checked", lambda words, _settings: self.run.append(words))
        monkeypatch.setattr(made, "pip", lambda *words, settings: self.run.append(words))
        return made

    def test_it_takes_the_same_words(self, venv):
        venv.install(["test", "workspace"], only_extras=False)
        (words,) = self.run
        assert words[:5] == ["/bin/uv", "pip", "install", "--python", str(venv.PYTHON)]
        assert words.count("-e") == words.count("--reinstall-package") == len(venv.distributions())
        assert words[words.index("--group") + 1] == f"{venv.ROOT / 'pyproject.toml'}:test"

    def test_extras_leave_the_packages_alone(self, venv):
        venv.install(["workspace"], only_extras=True)
        assert self.run[0][5:] == ["turtlewire-colcon[workspace]"]

    def test_without_it_pip_installs(self, venv, monkeypatch):
        monkeypatch.setattr(venv.shutil, "which", lambda _name: None)
        venv.install([], only_extras=True)
        assert self.run == [("install", "turtlewire-colcon")]

    @pytest.mark.parametrize(
        ("told", "names"),
        [
            ("global.extra-index-url='file:///x'\n:env:.cert='/y'\n", "(cert, extra-index-url)"),
            (":env:.find-links='/wheels'\n", "(find-links)"),
            ("install.index-url='file:///x?a=b'\n", "(index-url)"),
        ],
    )
    def test_settings_of_pip_that_it_does_not_read_keep_pip(self, venv, capfd, told, names):
        self.told = told
        venv.install([], only_extras=True)
        assert self.run == [("install", "turtlewire-colcon")]
        assert names in capfd.readouterr().err

    def test_other_settings_of_pip_do_not(self, venv, capfd):
        self.told = "global.timeout='60'\n:env:.disable-pip-version-check='1'\n"
        venv.install([], only_extras=True)
        assert self.run[0][0] == "/bin/uv"
        assert capfd.readouterr().err == ""


class TestCore:
    """The compiled core, which a second checkout of the same sources does not compile again."""

    @pytest.fixture
    def core(self, module, monkeypatch, tmp_path):
        made = module("setup_core")
        self.compiled, self.content = [], b"core"
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
        monkeypatch.setattr(made, "pip", self.pip)
        self.module = made.MODULE
        self.checkout(made, monkeypatch, tmp_path / "one")
        return made

    def pip(self, *words):
        """Writes a wheel, as pip does."""
        assert words[0] == "wheel"
        self.compiled.append(words)
        folder = Path(words[words.index("-w") + 1])
        with zipfile.ZipFile(folder / "turtlewire-0.1.0-py3-none-any.whl", "w") as wheel:
            wheel.writestr("turtlewire/__init__.py", "")
            if self.content is not None:
                wheel.writestr(f"turtlewire/{self.module}", self.content)

    @staticmethod
    def checkout(core, monkeypatch, folder):
        folder.mkdir()
        monkeypatch.setattr(core, "CORE", folder / core.MODULE)

    def test_another_checkout_does_not_compile_it_again(self, core, monkeypatch, tmp_path, capfd):
        core.provide_core("key")
        assert core.CORE.read_bytes() == b"core"
        self.checkout(core, monkeypatch, tmp_path / "two")
        self.content = b"other"
        core.provide_core("key")
        assert core.CORE.read_bytes() == b"core"
        assert len(self.compiled) == 1
        assert f"is taken from {tmp_path / 'cache' / 'turtlewire' / 'core'}" in (
            capfd.readouterr().err
        )
        core.provide_core("another key")
        assert core.CORE.read_bytes() == b"other"
        assert len(self.compiled) == 2

    def test_a_compilation_that_fails_leaves_none(self, core, capfd):
        core.CORE.write_bytes(b"of older sources")
        self.content = None
        core.provide_core("key")
        assert not core.CORE.exists()
        assert "does not compile here (see " in capfd.readouterr().err
        self.content = b"core"
        core.provide_core("key")
        assert core.CORE.read_bytes() == b"core"

    def test_without_a_compiler_it_is_said_what_to_type(self, core, monkeypatch, capfd):
        core.CORE.write_bytes(b"of older sources")
        monkeypatch.setattr(core.shutil, "which", lambda name: f"/bin/{name}")
        core.provide_core("")
        assert not core.CORE.exists()
        assert self.compiled == []
        said = capfd.readouterr().err
        assert "apt install g++ python3-dev\n" in said
        monkeypatch.setattr(core.shutil, "which", lambda _name: None)
        core.provide_core("")
        assert "install a C++ compiler and Python's headers" in capfd.readouterr().err

    def test_a_cache_that_cannot_be_written_keeps_the_core_here(self, core, tmp_path, capfd):
        (tmp_path / "cache").write_text("no folder")
        core.provide_core("key")
        assert core.CORE.read_bytes() == b"core"
        assert "is not kept for other checkouts: " in capfd.readouterr().err

    def test_most_recently_used_are_kept(self, core, tmp_path):
        folder = tmp_path / "cache" / "turtlewire" / "core"
        for number in range(core.KEPT):
            core.provide_core(f"key {number}")
            os.utime(folder / f"key {number}", (number, number))
        core.provide_core("key 0")  # which is now the one that was used last
        core.provide_core("one more")
        assert {path.name for path in folder.iterdir()} == {
            *("key 0", "one more"),
            *(f"key {number}" for number in range(2, core.KEPT)),
        }

    @pytest.fixture
    def sources(self, core, monkeypatch, tmp_path):
        """A copy of what the key is made of; a compiler that tells its version."""
        monkeypatch.setattr(core, "ENGINE", tmp_path)
        monkeypatch.setattr(core, "compiler_version", lambda: "c++ 1")
        monkeypatch.setattr(core.sysconfig, "get_path", lambda _name: str(tmp_path))
        (tmp_path / "Python.h").touch()
        for folder in ("bindings", "core", "cyclone", "tests"):
            assert (ENGINE / "native" / folder).is_dir()
            (tmp_path / "native" / folder).mkdir(parents=True)
        (tmp_path / "native" / "CMakeLists.txt").touch()
        (tmp_path / "pyproject.toml").write_text("[build-system]\nx = 1\n[project]\ny = 1\n")
        return tmp_path

    @pytest.mark.parametrize(
        ("file", "text", "counts"),
        [
            ("native/core/new.cpp", "int changed;", True),
            ("native/bindings/new.hpp", "int changed;", True),
            ("native/cyclone/new.cpp", "", True),
            ("native/tests/new.cpp", "int changed;", False),  # built elsewhere
            ("native/CMakeLists.txt", "# changed", True),
            ("pyproject.toml", "[build-system]\nx = 2\n[project]\ny = 1\n", True),
            ("pyproject.toml", "[build-system]\nx = 1\n[project]\ny = 2\n", False),
        ],
    )
    def test_all_that_is_compiled_counts(self, core, sources, file, text, counts):
        before = core.core_key()
        assert before
        (sources / file).write_text(text)
        assert (core.core_key() != before) == counts

    def test_compiler_flags_and_python_count(self, core, sources, monkeypatch):
        keys = [core.core_key()]
        for name in ("CXXFLAGS", "SKBUILD_CMAKE_BUILD_TYPE"):
            monkeypatch.setenv(name, "-O0")
            keys.append(core.core_key())
        monkeypatch.setattr(core, "compiler_version", lambda: "c++ 2")
        keys.append(core.core_key())
        monkeypatch.setattr(core, "MODULE", "_native.another-python.so")
        keys.append(core.core_key())
        assert len({*keys}) == 5

    def test_without_compiler_or_headers_there_is_no_key(self, core, sources, monkeypatch):
        (sources / "Python.h").unlink()
        assert core.core_key() == ""
        (sources / "Python.h").touch()
        monkeypatch.setattr(core, "compiler_version", lambda: "")
        assert core.core_key() == ""

    @pytest.mark.parametrize(
        ("script", "version"), [("echo c++ 12", "c++ 12\n"), ("echo install me; exit 1", "")]
    )
    def test_a_stub_that_prints_install_advice_is_not_a_compiler(
        self, core, monkeypatch, tmp_path, script, version
    ):
        program = tmp_path / "my-c++"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        monkeypatch.setenv("CXX", str(program))
        assert core.compiler_version() == version


@pytest.mark.parametrize(
    ("home", "cache"), [("/var/x", "/var/x/turtlewire"), ("", None), ("relative", None)]
)
def test_the_cache_is_where_the_user_has_it(module, monkeypatch, home, cache):
    monkeypatch.setenv("XDG_CACHE_HOME", home)
    expected = Path(cache) if cache else Path.home() / ".cache" / "turtlewire"
    assert module("distributions").cache_folder() == expected


def test_a_stage_says_how_long_it_took(steps, capfd):
    with steps.stage("installing"):
        assert capfd.readouterr().err == "[setup] installing ...\n"
    assert capfd.readouterr().err == "[setup] ... done in 0 s\n"


def test_failures_are_named(steps, capfd):
    with pytest.raises(steps.SetupError, match=f"this failed, see above and {steps.LOG}: "):
        steps.checked([sys.executable, "-c", "import sys; print('why'); sys.exit(3)"])
    assert capfd.readouterr().err == "why\n"


def test_of_much_output_the_end_is_shown_and_all_is_kept(steps, capfd):
    code = "for line in range(1000): print(line)\nraise SystemExit(3)"
    with pytest.raises(steps.SetupError):
        steps.checked([sys.executable, "-c", code])
    shown = [str(line) for line in range(1000 - steps.SHOWN_LINES, 1000)]
    assert capfd.readouterr().err.split() == shown
    assert steps.LOG.read_text().count("\n") == 1000


def printing(text: str, status: int) -> list[str]:
    """A command that stands for pip."""
    return [
        sys.executable,
        "-c",
        f"import sys; print({text!r}, file=sys.stderr); sys.exit({status})",
    ]


def test_a_missing_network_is_one_line(setup, steps, monkeypatch, capfd):
    text = (
        "WARNING: Retrying (…) after connection broken by 'NewConnectionError(…)'\nERROR: No match"
    )
    monkeypatch.setattr(setup, "install", lambda *_, **__: steps.checked(printing(text, 1)))
    assert setup.run([]) == 1
    *_, said = capfd.readouterr().err.splitlines()
    assert said.startswith("[setup] no network: ")
    assert "Retrying" not in said
    monkeypatch.setattr(setup, "install", lambda *_, **__: None)
    assert setup.run([]) == 0  # the folder is not locked any more


def test_warnings_of_a_pip_that_succeeds_are_not_shown(steps, capfd):
    steps.checked(printing("WARNING: Location '/wheels' is ignored", 0))
    assert capfd.readouterr().err == ""


def test_an_unknown_extra_is_refused_with_those_there_are(setup, capfd):
    with pytest.raises(SystemExit) as ended:
        setup.run(["tset"])
    assert ended.value.code == 2
    assert "there is no extra 'tset'; choose from test, lint, workspace" in capfd.readouterr().err
    assert setup.calls == []


#: The set-up with a pip that tells when it runs, and complains at length when it is interrupted.
SLOW_PIP = f"""
import os, pathlib, runpy, subprocess, sys
sys.path.insert(0, {str(TOOLS)!r})
import setup_steps as steps
steps.LOG = pathlib.Path(sys.argv[1])
pip = "import os, sys, time; os.write(int(sys.argv[1]), b'pip runs'); time.sleep(600)"
told, tell = os.pipe()
start = subprocess.Popen
subprocess.Popen = lambda command, **options: start(
    [*command, str(tell)], pass_fds=[tell], **options)
steps.show_progress = lambda text: text and print(os.read(told, 100).decode(), flush=True)
script = runpy.run_path({str(SETUP)!r})
run = script["run"]
run.__globals__["main"] = lambda extras: steps.checked([sys.executable, "-c", pip])
sys.exit(run([]))
"""


def test_ctrl_c_while_pip_runs_is_one_line(run, tmp_path):
    words = (sys.executable, "-c", SLOW_PIP, str(tmp_path / "log"))
    program = run(SCRIPTS / "interruptible", *words, terminal=True)
    program.wait_for("pip runs")
    program.type("\x03")
    assert program.wait() == 130
    assert "[setup] interrupted; the next run continues" in program.text
    assert "Traceback" not in program.text
    assert program.survivors() == []


def test_ctrl_c_while_python_starts_is_silent(run, tmp_path):
    (tmp_path / "sitecustomize.py").write_text("print('starting', flush=True)\nwhile True: pass\n")
    command = ["env", f"PYTHONPATH={tmp_path}", sys.executable, "-c", ""]
    program = run(SCRIPTS / "interruptible", *command, terminal=True)
    program.wait_for("starting")
    program.type("\x03")
    assert program.wait() == 130
    assert program.text.replace("^C", "").split() == ["starting"]
    assert program.survivors() == []


@pytest.mark.parametrize("status", [0, 3])
def test_an_interruptible_program_keeps_its_status_and_its_input(run, status):
    code = f"import sys; print(input()); sys.exit({status})"
    program = run(SCRIPTS / "interruptible", sys.executable, "-c", code, terminal=True)
    program.type("hello\r")
    assert program.wait() == status
    assert program.text.split()[-1] == "hello"


def test_a_terminal_shows_that_it_goes_on(run, tmp_path):
    """The last line that the program printed, without what would steer the terminal."""
    program = "import time; print('one\\nDownloading \\x1b[2Jtwo'); time.sleep(1.5)"
    code = f"import pathlib, sys; sys.path.insert(0, {str(TOOLS)!r}); import setup_steps as s; "
    code += f"s.LOG = pathlib.Path({str(tmp_path / 'log')!r}); "
    code += f"s.checked([sys.executable, '-c', {program!r}]); print('ready')"
    program = run(sys.executable, "-c", code, terminal=True)
    program.wait_for("ready")
    assert "[setup] 1 s Downloading [2Jtwo" in program.text
