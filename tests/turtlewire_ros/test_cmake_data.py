"""Which CMakeLists.txt only install files, and what they install."""

from __future__ import annotations

import os

import pytest

from turtlewire_ros.cmake_data import Install, install_files, read_installs

HEAD = "cmake_minimum_required(VERSION 3.8)\nproject(robot)\nfind_package(ament_cmake REQUIRED)\n"


def read(body: str) -> list[Install] | None:
    return read_installs(f"{HEAD}{body}\nament_package()\n")


@pytest.mark.parametrize(
    ("body", "installs"),
    [
        ("", []),
        (
            "install(DIRECTORY launch urdf\n  DESTINATION share/${PROJECT_NAME}\n)",
            [Install("DIRECTORY", ("launch", "urdf"), "share/robot")],
        ),
        (
            (
                'install(DIRECTORY "meshes/" DESTINATION "share/${PROJECT_NAME}/meshes"\n'
                '  PATTERN "*.blend" EXCLUDE)'
            ),
            [Install("DIRECTORY", ("meshes/",), "share/robot/meshes", ("*.blend",))],
        ),
        (
            "INSTALL(PROGRAMS scripts/walk.py DESTINATION lib/${PROJECT_NAME}) # walks",
            [Install("PROGRAMS", ("scripts/walk.py",), "lib/robot")],
        ),
        (
            (
                "if(BUILD_TESTING)\n  find_package(ament_lint_auto)\n"
                "  if(A)\n add_test(x)\n endif()\nendif()"
            ),
            [],
        ),
    ],
)
def test_what_is_installed(body, installs):
    assert read(body) == installs


@pytest.mark.parametrize(
    "body",
    [
        "add_executable(a a.cpp)",
        "ament_python_install_package(${PROJECT_NAME})",
        "if(WIN32)\nendif()",
        "install(TARGETS a DESTINATION lib)",
        "install(DIRECTORY a)",
        "install(DIRECTORY a DESTINATION /etc)",
        "install(DIRECTORY ../a DESTINATION share)",
        "install(FILES ${FILES} DESTINATION share)",
        "install(DIRECTORY a DESTINATION share FILES_MATCHING PATTERN *.py)",
        "install(DIRECTORY a DESTINATION share USE_SOURCE_PERMISSIONS",
        "catkin_package(",
        "set(A 1)",
    ],
)
def test_anything_else_is_for_cmake(body):
    assert read(body) is None


def test_files_are_copied_as_cmake_does(tmp_path):
    source, prefix = tmp_path / "source", tmp_path / "prefix"
    for name in ("urdf/a.urdf", "urdf/old/b.urdf", "urdf/a.bak", "meshes/c.stl", "bin/walk.py"):
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        (source / name).write_text(name)
    install_files(
        [
            Install("DIRECTORY", ("urdf",), "share/robot", ("*.bak",)),
            Install("DIRECTORY", ("meshes/",), "share/robot/shapes"),
            Install("PROGRAMS", ("bin/walk.py",), "lib/robot"),
        ],
        source,
        prefix,
    )
    files = sorted(path.relative_to(prefix) for path in prefix.rglob("*") if path.is_file())
    assert [path.as_posix() for path in files] == [
        "lib/robot/walk.py",
        "share/robot/shapes/c.stl",
        "share/robot/urdf/a.urdf",
        "share/robot/urdf/old/b.urdf",
    ]
    assert os.access(prefix / "lib/robot/walk.py", os.X_OK)
    with pytest.raises(FileNotFoundError):
        install_files([Install("FILES", ("gone",), "share")], source, prefix)
