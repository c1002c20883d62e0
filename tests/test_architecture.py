"""The claims of ARCHITECTURE.md: directions of imports, remaining import cycles, `__all__`.

`tools/architecture.py` reads the imports, those for type checkers and inside functions included.
"""

import ast
import configparser
import importlib
import re
from fnmatch import fnmatch

import architecture
import columns
import import_contracts
import prose
import pytest
from tests.needs import HAS_CYCLONE_DDS
from tests.places import ROOT, ROS, SCRIPTS

#: Modules that lie in circles, by room: rclpy's pairs, which ROS 2's surface wants. Lower a number
#: when circles end; raise none.
IN_CIRCLES = {"rclpy": 6}
#: Packages of the engine whose modules have no `__all__` of their own names.
WITHOUT_LISTS = ("cli", "doctor", "msg", "net", "relay", "terminal", "web", "wire")
LISTING = {"turtlewire.terminal.posix_keyboard"}
#: Need what is not installed where the tests run: colcon, a terminal.
NOT_IMPORTED = {"turtlewire_colcon.colcon_ament"}


@pytest.fixture(scope="module")
def house():
    return architecture.House(ROOT)


@pytest.mark.slow
def test_circles_of_imports_only_become_fewer(house):
    found = dict.fromkeys(IN_CIRCLES, 0)
    for circle in house.circles("run", "late", "type"):
        for name in circle:
            found[architecture.room(name)] = found.get(architecture.room(name), 0) + 1
    grown = {name: count for name, count in found.items() if count > IN_CIRCLES.get(name, 0)}
    assert not grown, f"modules in circles of imports; see {house.circles('run', 'late', 'type')}"


def test_the_turtlewire_command_is_not_imported_from_outside(house):
    cli = "turtlewire.cli"
    assert [
        (found.source, found.target)
        for found in house.imports
        if found.target.startswith(cli) and not found.source.startswith(cli)
    ] == []


def test_one_module_writes_svg(house):
    writers = {
        name
        for name, path in house.paths.items()
        if "<svg xmlns" in path.read_text(encoding="utf-8")
    }
    assert writers == {"turtlewire.tf.svg"}


def test_no_circle_at_import_time(house):
    assert house.circles("run") == []


def test_a_circle_is_found_whatever_the_kind_of_its_imports(tmp_path):
    package = tmp_path / "packages" / "some" / "src" / "pkg"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    (package / "a.py").write_text("from pkg import b\n")
    (package / "b.py").write_text("def f():\n    from .c import g\n")
    (package / "c.py").write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import pkg.a\n"
    )
    house = architecture.House(tmp_path)
    assert house.circles("run", "late", "type") == [["pkg.a", "pkg.b", "pkg.c"]]
    assert house.circles("run", "late") == []
    assert [found.kind for found in house.imports] == ["run", "late", "type"]


def test_import_linter_knows_every_package(house):
    contracts = import_contracts.contracts()
    packages = sorted({name.partition(".")[0] for name in house.paths})
    assert contracts["importlinter"]["root_packages"].split() == packages
    layers = contracts["importlinter:contract:ros"]["layers"].replace(":", " ").split()
    assert sorted(layers) == packages


def test_import_linter_forbids_circles_with_three_exceptions():
    contracts = configparser.ConfigParser()
    contracts.read(ROOT / ".importlinter")
    circles = contracts["importlinter:contract:circles"]
    assert circles["type"] == "acyclic_siblings"
    assert circles["ancestors"].split() == ["*", "**"]
    assert circles["ignore_imports"].split("\n")[1:] == [
        "rclpy.** -> rclpy.**",
        "turtlewire.tf.buffer -> turtlewire.bag.*",
        "turtlewire.tf.buffer -> turtlewire.trajectory.*",
        "turtlewire.trajectory.trajectory -> turtlewire.bag.*",
    ]


def public(tree):
    """Names that the module itself defines and that begin without an underscore, and `__all__`."""
    defined, exported = set(), None
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            defined.add(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = {target.id for target in targets if isinstance(target, ast.Name)}
            if "__all__" in names:
                exported = ast.literal_eval(node.value)
            elif not (isinstance(node.value, ast.Call) and "TypeVar" in ast.dump(node.value.func)):
                defined |= names
    return {name for name in defined if not name.startswith("_")}, exported


def test_public_names_of_a_module_are_in_its_all(house):
    forgotten = {}
    for name, tree in house.trees.items():
        defined, exported = public(tree)
        if exported is not None and (missing := defined - set(exported)):
            forgotten[name] = sorted(missing)
    assert forgotten == {}


def test_all_lists_only_what_a_module_hands_on(house):
    """On ROS 2's shelves, and in these packages of the engine.

    The names that a module itself defines are public without a list.
    """
    engine = tuple(f"turtlewire.{each}." for each in WITHOUT_LISTS)
    repeated = []
    for name, tree in house.trees.items():
        path = house.paths[name]
        is_judged = ROS in path.parents or name.startswith(engine)
        if is_judged and path.name != "__init__.py" and name not in LISTING:
            own = {
                node.name
                for node in tree.body
                if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef))
            }
            exported = public(tree)[1]
            if exported and own.issuperset(exported):
                repeated.append(name)
    assert repeated == []


def test_names_in_all_exist(house):
    missing = []
    cannot = () if HAS_CYCLONE_DDS else ("turtlewire.wire.cyclone.",)
    for name, tree in house.trees.items():
        exported = public(tree)[1]
        if exported and name not in NOT_IMPORTED and not name.startswith(cannot):
            module = importlib.import_module(name)
            missing += [f"{name}.{each}" for each in exported if not hasattr(module, each)]
    assert missing == []


def listed_modules(house, package):
    """The modules in the table of a package's docstring; ``log_*`` stands for several."""
    docstring = ast.get_docstring(house.trees[package]) or ""
    rows = re.findall(r"^(`[\w*]+`(?:, `[\w*]+`)*)  ", docstring, re.MULTILINE)
    return re.findall(r"`([\w*]+)`", "".join(rows))


def mapped(house):
    """Packages whose modules are listed: all top packages, the engine's rooms, and some more."""
    rooms = {name for name in house.paths if name.count(".") < 2 and name.startswith("turtlewire.")}
    tops = {name.partition(".")[0] for name in house.paths} | rooms
    packages = {name for name, path in house.paths.items() if path.name == "__init__.py"}
    return sorted(each for each in packages if each in tops or listed_modules(house, each))


def test_the_docstring_of_a_package_lists_its_modules(house):
    wrong = {}
    for package in mapped(house):
        listed = listed_modules(house, package)
        inside = sorted(
            name.removeprefix(f"{package}.")
            for name in house.paths
            if name.rpartition(".")[0] == package
        )
        missing = [name for name in inside if not any(fnmatch(name, each) for each in listed)]
        gone = [each for each in listed if not any(fnmatch(name, each) for name in inside)]
        if missing or gone:
            wrong[package] = missing + gone
    assert wrong == {}


def test_a_line_may_have_a_hundred_characters():
    assert not columns.too_long("a.py", "x " * 50)
    assert columns.too_long("a.py", "x " * 50 + "y")
    assert columns.too_long("tests/a.py", "'" + "x " * 50 + "'")
    assert columns.too_long("page.md", "word " * 21)
    assert not columns.too_long("page.md", "| a row " * 20 + "|")
    assert not columns.too_long("a.py", "call(" + "x, " * 30 + ")  # noqa: S102 - a reason")
    assert "tools/columns.py" in (SCRIPTS / "lint").read_text()


@pytest.mark.parametrize(
    "docstring",
    [
        "Whether it is open.",
        "Return the names of those of the node.",
        "Return None if there is none.",
        "Publish the transforms anew.",
        "Return the path, which is no bag.",
        "Call :mod:`missing_module.py`, or missing_module.py.",
        "Read it.\n\n    Raises:\n        ValueError: It ends before it begins.\n    ",
    ],
)
def test_prose_lint_rejects_a_docstring(docstring):
    source = f'def read():\n    """{docstring}"""\n'
    assert list(prose.faults_of(source, set()))


@pytest.mark.parametrize(
    "docstring",
    [
        "Return True if the bag is open, or False if there is no bag.",
        "Read setup.py.\n\n    Raises:\n        ValueError: ``end`` is before ``start``.\n    ",
    ],
)
def test_prose_lint_accepts_a_docstring(docstring):
    source = f'def read():\n    """{docstring}"""\n'
    assert not list(prose.faults_of(source, {"setup.py"}))


def test_prose_lint_checks_comments_and_test_names():
    assert list(prose.faults_of("x = 1  # nobody knows, thus it waits for ever\n", set()))
    assert not list(prose.faults_of("x = 1  # the file is not a bag\n", set()))
    names = {"what_is_refused": 1, "a" * 66: 1, "a" * 65: 0, "unknown_option_is_rejected": 0}
    for name, faults in names.items():
        found = list(prose.faults_of_tests(f"def test_{name}():\n    pass\n"))
        assert len(found) == faults, name
