"""How a CMakeLists.txt is read: no CMake, no colcon, no processes."""

from __future__ import annotations

import os
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire_colcon.cmake.evaluate import evaluate_package
from turtlewire_colcon.cmake.syntax import CMakeError, parse_commands
from turtlewire_colcon.cmake.tool import main as tool
from turtlewire_colcon.package_lookup import PackageLookup
from turtlewire_colcon.plan_install import PlanInstaller

MANIFEST = "<package><name>robot</name><version>1.2.3</version><depend>std_msgs</depend></package>"
HEAD = "cmake_minimum_required(VERSION 3.8)\nproject(robot)\nfind_package(ament_cmake REQUIRED)\n"


@pytest.fixture
def evaluate(tmp_path):
    """The plan of a package with this text after its first three lines, and its variables."""
    source = tmp_path / "robot"
    source.mkdir()
    (source / "package.xml").write_text(MANIFEST)

    def of(body: str, *arguments: str, **files: str):
        for name, text in files.items():
            path = source / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        (source / "CMakeLists.txt").write_text(f"{HEAD}{body}\n")
        environment = {"HOME": "/home/me", "AMENT_PREFIX_PATH": ""}
        plan, run = evaluate_package(
            source, tmp_path / "build", tmp_path / "prefix", "lib/py", environment, arguments
        )
        return plan, run.variables

    return of


def value(evaluate, body: str) -> str:
    return evaluate(body)[1].get("X", "not set")


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("set(X a)", "a"),
        ('set(X a b "c d")', "a;b;c d"),
        ("set(X [[${not} replaced]])", "${not} replaced"),
        ("set(X [=[a]]b]=])", "a]]b"),
        ("set(X [[two\\\nlines]])", "two\\\nlines"),
        ('set(X "a\\"b\\\\c\\${d}")', 'a"b\\c${d}'),
        ('set(X "two\\\nlines")', "twolines"),
        ("set(X a#comment\n)", "a"),
        ("set(X a #[[ a long\n comment ]] b)", "a;b"),
        ('set(X -Da="b c")', '-Da="b c"'),
        ("set(a b)\nset(b_c d)\nset(X ${${a}_c})", "d"),
        ('set(X "$ENV{HOME}/x")', "/home/me/x"),
        ("set(X 1)\nset(X)", "not set"),
        ("set(X 1)\nunset(X)", "not set"),
        ('set(X first CACHE STRING "doc")\nset(X second CACHE STRING "doc")', "first"),
        ('option(X "doc" ON)', "ON"),
        ('set(A 1)\ncmake_dependent_option(X "doc" yes "A;NOT B" no)', "yes"),
        ('set(B 1)\ncmake_dependent_option(X "doc" yes "A;NOT B" no)', "no"),
        ("ament_get_python_install_dir(X)", "lib/py"),
        ("SET(X ${PROJECT_NAME}-${PROJECT_VERSION})", "robot-1.2.3"),
        ("list(APPEND X a b)\nlist(APPEND X c)\nlist(REMOVE_ITEM X b)", "a;c"),
        ("set(l a b c)\nlist(LENGTH l X)", "3"),
        ("set(l a b c)\nlist(GET l 0 -1 X)", "a;c"),
        ("set(l a b)\nlist(FIND l b X)", "1"),
        ("set(l a b)\nlist(FIND l c X)", "-1"),
        ('set(l a b)\nlist(JOIN l ", " X)', "a, b"),
        ('set(X x.cpp y.py)\nlist(FILTER X EXCLUDE REGEX ".*\\\\.cpp$")', "y.py"),
        ('set(X x.cpp y.py)\nlist(FILTER X INCLUDE REGEX ".*\\\\.cpp$")', "x.cpp"),
        ("set(X b a b)\nlist(REMOVE_DUPLICATES X)\nlist(SORT X)\nlist(REVERSE X)", "b;a"),
        ("set(X a b)\nlist(TRANSFORM X PREPEND msg/)\nlist(TRANSFORM X APPEND .msg)",
         "msg/a.msg;msg/b.msg"),
        ("set(l a b c d)\nlist(SUBLIST l 1 2 X)", "b;c"),
        ("set(l a b c d)\nlist(SUBLIST l 1 0 X)", ""),
        ("set(l a b c d)\nlist(SUBLIST l 3 -1 X)", "d"),
        ("set(l a b c d)\nlist(SUBLIST l 3 2 X)", "d"),
        ("set(X a b c)\nlist(INSERT X 0 x)\nlist(INSERT X 4 y)\nlist(INSERT X -1 z)",
         "x;a;b;c;z;y"),
        ('string(TOUPPER "abc" X)', "ABC"),
        ('string(REPLACE "a" "b" X "banana")', "bbnbnb"),
        ('string(REGEX REPLACE "([a-z]+)-([0-9]+)" "\\\\2:\\\\1" X "ab-12")', "12:ab"),
        ('string(REGEX MATCH "[0-9]+" X "ab-12")', "12"),
        ("string(CONCAT X a b c)", "abc"),
        ("set(X a)\nstring(APPEND X b)", "ab"),
        ('math(EXPR X "2 * (3 + 4) - 1")', "13"),
        ('math(EXPR X "7 / 2")', "3"), ('math(EXPR X "-7 / 2")', "-3"),
        ('math(EXPR X "7 / -2")', "-3"), ('math(EXPR X "-6 / 3")', "-2"),
        ('math(EXPR X "-7 % 2")', "-1"), ('math(EXPR X "7 % -2")', "1"),
        ('math(EXPR X "+3 + ~1")', "1"), ('math(EXPR X "1 << 3 | 9 >> 1")', "12"),
        ('math(EXPR X "6 & 3 ^ 7")', "5"), ('math(EXPR X "08 + 0 + 0x10 + 100")', "124"),
        ('foreach(i 1 2 3)\n  set(X "${X}${i}")\nendforeach()', "123"),
        ('foreach(i RANGE 3)\n  set(X "${X}${i}")\nendforeach()', "0123"),
        ('foreach(i RANGE 0)\n  set(X "${X}${i}")\nendforeach()', "0"),
        ('foreach(i RANGE -1)\n  set(X "${X}${i};")\nendforeach()', "0;-1;"),
        ('foreach(i RANGE 1 6 4)\n  set(X "${X}${i}")\nendforeach()', "15"),
        ('foreach(i RANGE 2 5 3)\n  set(X "${X}${i}")\nendforeach()', "25"),
        ('foreach(i RANGE 3 1)\n  set(X "${X}${i}")\nendforeach()', "321"),
        ('foreach(i RANGE 6 1 -4)\n  set(X "${X}${i}")\nendforeach()', "62"),
        ('set(i before)\nforeach(i 1 2)\nendforeach()\nset(X "${i}")', "before"),
        ('foreach(i 1 2)\nendforeach()\nset(X "[${i}]")', "[]"),
        ('set(l a b)\nforeach(i IN LISTS l ITEMS c)\n  set(X "${X}${i}")\nendforeach()', "abc"),
        (("foreach(i a b c)\n  if(i STREQUAL b)\n    continue()\n  endif()\n"
         '  set(X "${X}${i}")\nendforeach()'), "ac"),
        (("foreach(i a b c)\n  if(i STREQUAL b)\n    break()\n  endif()\n"
         '  set(X "${X}${i}")\nendforeach()'), "a"),
        ('set(n 0)\nwhile(n LESS 3)\n  math(EXPR n "${n}+1")\nendwhile()\nset(X ${n})', "3"),
        (("function(f a)\n  set(X ${a}-${ARGN}-${ARGC} PARENT_SCOPE)\nendfunction()\n"
         "f(1 2 3)"), "1-2;3-3"),
        ("function(f)\n  set(X inside)\nendfunction()\nset(X outside)\nf()", "outside"),
        (("function(f)\n  set(X 1 PARENT_SCOPE)\n  return()\n  set(X PARENT_SCOPE)\nendfunction()\n"
         "f()"), "1"),
        ("macro(m a)\n  set(X ${a}${ARGN})\nendmacro()\nm(1 2)", "12"),
        (('macro(m)\n  cmake_parse_arguments(ARG "FLAG" "ONE" "MANY" ${ARGN})\nendmacro()\n'
         "m(rest FLAG ONE 1 MANY 2 3)\n"
         "set(X ${ARG_FLAG} ${ARG_ONE} ${ARG_MANY} ${ARG_UNPARSED_ARGUMENTS})"), "TRUE;1;2;3;rest"),
        (('set(P_ONE before)\ncmake_parse_arguments(P "FLAG" "ONE" "" a)\n'
         'set(X "${P_FLAG} [${P_ONE}]")'), "FALSE []"),
        (('function(f a)\n  cmake_parse_arguments(PARSE_ARGV 1 P "" "ONE" "MANY")\n'
         '  set(X "${a};${P_ONE};${P_MANY};${P_UNPARSED_ARGUMENTS}" PARENT_SCOPE)\nendfunction()\n'
         "f(1 rest ONE 2 MANY 3 4)"), "1;2;3;4;rest"),
        ("get_filename_component(X /a/b.c.d NAME_WE)", "b"),
        ("get_filename_component(X /a/b.c.d NAME_WLE)", "b.c"),
        ("get_filename_component(X /a/b.c.d NAME)", "b.c.d"),
        ("get_filename_component(X /a/b.c.d EXT)", ".c.d"),
        ("get_filename_component(X /a/b.c.d LAST_EXT)", ".d"),
        ("get_filename_component(X /a/b.c.d DIRECTORY)", "/a"),
        ('string(SUBSTRING "abcdef" 1 3 X)', "bcd"), ('string(SUBSTRING "abc" 1 0 X)', ""),
        ('string(SUBSTRING "abc" 1 -1 X)', "bc"), ('string(SUBSTRING "abc" 3 -1 X)', ""),
        ('string(SUBSTRING "abc" 2 5 X)', "c"),
        ("string(FIND abcabc b X)", "1"), ("string(FIND abcabc b X REVERSE)", "4"),
        ('string(REGEX MATCHALL "[a-z]1" X a1 b1c1)', "a1;b1;c1"),
        ("return()\nset(X 1)", "not set"),
        ("set(X a b c)\nlist(REMOVE_AT X 0 -1)", "b"),
        ('set(X "a \\"b c\\" d")\nseparate_arguments(X)', "a;b c;d"),
        (("execute_process(COMMAND ${CMAKE_COMMAND} -E echo a b OUTPUT_VARIABLE X "
         "OUTPUT_STRIP_TRAILING_WHITESPACE)"), "a b"),
        ("execute_process(COMMAND no-such-program RESULT_VARIABLE X)\nif(X)\nset(X no)\nendif()",
         "no"),
    ],
)  # fmt: skip
def test_values(evaluate, body, expected):
    assert value(evaluate, body) == expected


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("ON", True), ("0", False), ("2.5", True), ("no_such_variable", False), ('"text"', False),
        ("YES AND NOT OFF", True), ("OFF OR ON", True), ("NOT ON OR ON", True),
        ("(ON OR ON) AND OFF", False), ("(ON OR OFF) AND ON", True), ("ON OR ON AND OFF", True),
        ("DEFINED PROJECT_NAME", True), ("DEFINED nothing", False), ("DEFINED ENV{HOME}", True),
        ('PROJECT_NAME STREQUAL "robot"', True), ('"${PROJECT_NAME}" STREQUAL robot', True),
        ('PROJECT_NAME MATCHES "^rob"', True), ("PROJECT_NAME MATCHES cat", False),
        ("PROJECT_VERSION VERSION_LESS 1.10", True), ("1.2 VERSION_EQUAL 1.2.0", True),
        ("PROJECT_VERSION VERSION_GREATER_EQUAL 2", False),
        ("2a.1 VERSION_EQUAL 2", True), ("1.2-rc3 VERSION_EQUAL 1.2", True),
        ("1 VERSION_LESS 1.0.1", True), ("v1 VERSION_LESS 1", True), ("v1 VERSION_EQUAL 0", True),
        ("3 LESS 3", False), ("3 LESS_EQUAL 3", True), ("3 GREATER_EQUAL 3", True),
        ("3 GREATER 3", False), ("b STRLESS b", False), ("b STRGREATER_EQUAL b", True),
        ("3 LESS 10", True), ("3 EQUAL 3.0", True), ("3 GREATER x", False),
        ("b IN_LIST letters", True), ("z IN_LIST letters", False),
        ('EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/package.xml"', True), ("EXISTS nothing", False),
        ('IS_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"', True), ("TARGET lib", True),
        ('IS_ABSOLUTE "${CMAKE_CURRENT_SOURCE_DIR}"', True), ("IS_ABSOLUTE a/b", False),
        ("robot_SOURCE_DIR STREQUAL CMAKE_CURRENT_SOURCE_DIR", True),
        ("PROJECT_BINARY_DIR STREQUAL robot_BINARY_DIR", True),
        ("TARGET nothing", False), ("COMMAND ament_package", True), ("COMMAND nothing", False),
        ('CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang"', False),
        ("std_msgs_FOUND", True), ("nobody_has_this_FOUND", False),
    ],
)  # fmt: skip
def test_conditions(evaluate, condition, holds):
    body = (
        "set(letters a b)\nadd_library(lib INTERFACE)\nfind_package(std_msgs)\n"
        "find_package(nobody_has_this QUIET)\n"
        f"if({condition})\n  set(X 1)\nelse()\n  set(X 0)\nendif()"
    )
    assert value(evaluate, body) == str(int(holds))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('if(aXb MATCHES "(a)(q)?X(b)")\nendif()', "aXb|a||b|3"),
        ('if(aXb MATCHES "(a)X(q)?b")\nendif()', "aXb|a|||1"),
        ('if(ab MATCHES "(a)(b)")\nendif()\nif(zz MATCHES "z")\nendif()', "z||||0"),
        ('if(ab MATCHES "(a)(b)")\nendif()\nif(zz MATCHES "y")\nendif()', "||||0"),
        ('string(REGEX MATCH "a(.)" Y "ab")', "ab|b|||1"),
        ('string(REGEX MATCH "a(.)" Y "ab")\nstring(REGEX MATCH "q" Y "ab")', "||||0"),
    ],
)
def test_the_groups_of_the_last_match(evaluate, body, expected):
    parts = "|".join(f"${{CMAKE_MATCH_{part}}}" for part in (0, 1, 2, 3, "COUNT"))
    assert value(evaluate, f'{body}\nset(X "{parts}")') == expected


def test_elseif(evaluate):
    body = (
        "if(OFF)\nset(X 1)\nelseif(ON)\nset(X 2)\nelseif(ON)\nset(X 3)\nelse()\nset(X 4)\nendif()"
    )
    assert value(evaluate, body) == "2"


@pytest.mark.parametrize(
    ("body", "line", "text"),
    [
        ("set(X", 4, "the parenthesis that opens here is never closed"),
        ("if(ON)\nset(X 1)", 4, "if() has no endif()"),
        ("\nendif()", 5, "endif() closes nothing"),
        ("set X", 4, "expected '(' after 'set'"),
        ("5", 4, "expected a command, got '5'"),
        ("foreach(i a)\nendif()", 4, "foreach() has no endforeach()"),
        ("list(COOK l)", 4, "list(COOK) is not known here"),
        ("list(GET l 5 X)", 4, "wrong arguments: list(GET l 5 X)"),
        ("if(ON AND)\nendif()", 4, "a condition ends too early"),
        ("if(ON ON)\nendif()", 4, "unexpected 'ON' in a condition"),
        ('if(a MATCHES "(")\nendif()', 4, "'(' is not a regular expression"),
        ("foreach(i RANGE)\nendforeach()", 4, "foreach(RANGE) takes a last number"),
        ("foreach(i RANGE 1 2 1 1)\nendforeach()", 4, "foreach(RANGE) takes a last number"),
        ("foreach(i RANGE a)\nendforeach()", 4, "foreach(RANGE) takes whole numbers"),
        ("foreach(i RANGE 3 1 1)\nendforeach()", 4, "steps of 1 lead from 3 not to 1"),
        ("foreach(i RANGE 1 3 -1)\nendforeach()", 4, "steps of -1 lead from 1 not to 3"),
        ('math(EXPR X "1 / 0")', 4, "cannot calculate '1 / 0'"),
        ('math(EXPR X "1 % 0")', 4, "cannot calculate '1 % 0'"),
        ('math(EXPR X "1 << -1")', 4, "cannot calculate '1 << -1'"),
        ("math(EXPR X \"__import__('os')\")", 4, "cannot calculate"),
        ("function(f a)\nendfunction()\nf()", 6, "f() takes 1 arguments (a), got 0"),
        ("function(f)\n  f()\nendfunction()\nf()", 5, "f() calls itself without end"),
        ('message(FATAL_ERROR no "${PROJECT_NAME}")', 4, "norobot"),
        ("add_subdirectory(nowhere)", 4, "add_subdirectory(): there is no file"),
        ("file(WRITE ${CMAKE_SOURCE_DIR}/x y)", 4, "is not in the build folder"),
        ("configure_file(a.in a)", 4, "configure_file(): there is no file"),
        ("install(FILES a)", 4, "install(FILES) has no DESTINATION"),
        ("install(FILES a DESTINATION ../up)", 4, "is outside of the install folder"),
        ("install(DIRECTORY a DESTINATION b PATTERN)", 4, "install(): PATTERN needs a value"),
        ("add_library()", 4, "add_library() needs a name"),
        ("install()", 4, "install() is not known here"),
        ("install(SCRIPT a.cmake)", 4, "install(SCRIPT) is not known here"),
        ("ament_python_install_package(robot)", 4, "there is no folder"),
        ("ament_python_install_package(robot PACKAGE_DIR .)", 4, "/__init__.py"),
        ("ament_environment_hooks(a.sh)", 4, "there is no file"),
        ("rosidl_generate_interfaces(robot A.msg)", 4, "A.msg is not a msg/….msg, srv/….srv"),
        ("rosidl_generate_interfaces(robot msg/A.txt)", 4, "msg/A.txt is not a msg/….msg, srv/"),
        ("rosidl_generate_interfaces(robot C:/a/msg/A.msg)", 4, "C:/a/msg/A.msg"),
        ("rosidl_generate_interfaces(robot)", 4, "names no files"),
        ("xacro_add_files(a.xacro)", 4, "xacro_add_files(): there is no file"),
        ("xacro_add_files(package.xml)", 4, "name the output, or the file .xacro"),
        ("include(nope)", 4, "include(): there is no module in CMAKE_MODULE_PATH and no file"),
        ("include(nope.cmake)", 4, "include(): there is no file"),
        ("project(other)\nament_package()", 5, "is of 'robot', and project() of 'other'"),
        ("catkin_package()", 4, "is of ROS 1, whose packages do not run here"),
    ],
)  # fmt: skip
def test_errors_name_file_and_line(evaluate, tmp_path, body, line, text):
    with pytest.raises(CMakeError) as raised:
        evaluate(body)
    message = str(raised.value)
    assert message.startswith(f"{tmp_path / 'robot' / 'CMakeLists.txt'}:{line}: ")
    assert text in message


@given(st.text(alphabet='ab(){}[]="\\#;$ \n', max_size=40))
def test_any_text_is_read_or_refused(text):
    try:
        commands = parse_commands(text, "f")
    except CMakeError:
        return
    assert all(command.name.isidentifier() for command in commands)


def test_installed_files(evaluate, tmp_path):
    plan, _ = evaluate(
        'install(DIRECTORY "meshes/" urdf DESTINATION "share/${PROJECT_NAME}"\n'
        '  PATTERN "*.blend" EXCLUDE)\n'
        "INSTALL(PROGRAMS walk.py DESTINATION lib/${PROJECT_NAME} RENAME walk\n"
        "  PERMISSIONS OWNER_READ OWNER_EXECUTE) # walks\n"
        "install(FILES a DESTINATION ${CMAKE_INSTALL_PREFIX}/share/x OPTIONAL)\n"
        "install(TARGETS a b EXPORT c)\n"
    )
    source = tmp_path / "robot"
    directory, program, file = plan.installs
    assert directory.kind == "DIRECTORY"
    assert directory.sources == (f"{source}/meshes/", f"{source}/urdf")
    assert directory.destination == "share/robot"
    assert [rule.excludes for rule in directory.rules] == [True]
    assert (program.kind, program.destination, program.rename) == ("PROGRAMS", "lib/robot", "walk")
    assert program.sources == (f"{source}/walk.py",)
    assert (file.destination, file.optional) == ("share/x", True)


def test_descriptions_of_plugins_are_installed_and_registered(evaluate, tmp_path):
    plan, _ = evaluate(
        "pluginlib_export_plugin_description_file(rqt_gui plugin.xml)\n"
        "pluginlib_export_plugin_description_file(rviz_common plugin.xml)\n"
        "pluginlib_export_plugin_description_file(rqt_gui more/other.xml)\n"
    )
    source = tmp_path / "robot"
    assert [(install.sources, install.destination) for install in plan.installs] == [
        ((f"{source}/plugin.xml",), "share/robot"),
        ((f"{source}/plugin.xml",), "share/robot"),
        ((f"{source}/more/other.xml",), "share/robot/more"),
    ]
    content = "share/robot/plugin.xml\nshare/robot/more/other.xml\n"
    assert plan.resources == [
        ("rviz_common__pluginlib__plugin", "robot", "share/robot/plugin.xml\n"),
        ("rqt_gui__pluginlib__plugin", "robot", content),
    ]


def test_globs(evaluate, tmp_path):
    _, variables = evaluate(
        'file(GLOB a RELATIVE ${CMAKE_CURRENT_LIST_DIR} "msg/*.msg")\n'
        'file(GLOB_RECURSE b "*.msg")\nfile(GLOB c "*/A.msg")',
        **{"msg/A.msg": "int32 a\n", "msg/C.msg": "int32 c\n"},
    )  # fmt: skip
    folder = tmp_path / "robot" / "msg"
    assert variables["a"] == "msg/A.msg;msg/C.msg"
    assert variables["b"] == f"{folder / 'A.msg'};{folder / 'C.msg'}"
    assert variables["c"] == str(folder / "A.msg")


def test_interfaces(evaluate, tmp_path):
    other = tmp_path / "other" / "msg"
    other.mkdir(parents=True)
    (other / "O.msg").touch()
    plan, _ = evaluate(
        f'rosidl_generate_interfaces(${{PROJECT_NAME}} msg/A.msg "{other.parent}:msg/O.msg"\n'
        "  DEPENDENCIES std_msgs ADD_LINTER_TESTS LIBRARY_NAME x SKIP_INSTALL)",
        **{"msg/A.msg": "int32 a\n"},
    )
    (interfaces,) = plan.interfaces
    assert interfaces.files == (
        ("msg/A.msg", tmp_path / "robot" / "msg" / "A.msg"),
        ("msg/O.msg", other / "O.msg"),
    )
    assert not interfaces.installed


def test_a_missing_package_is_an_error_where_it_is_needed(evaluate):
    plan, _ = evaluate("find_package(nobody_has_this_msgs REQUIRED)\nfind_package(neither QUIET)")
    (line,) = plan.missing
    assert line.split("CMakeLists.txt")[1] == (
        ":4: there is no package 'nobody_has_this_msgs'; add it to the workspace, source a "
        "workspace that has it, or install it"
    )
    with pytest.raises(CMakeError, match=r"'nobody_has_this_msgs'[^$]*list\(COOK\) is not"):
        evaluate("find_package(nobody_has_this_msgs REQUIRED)\nlist(COOK l)")
    plan, _ = evaluate("find_package(urdf REQUIRED)\nfind_package(urdf_of_nobody REQUIRED)")
    assert [":5: there is no package 'urdf_of_nobody'" in line for line in plan.missing] == [True]
    plan, _ = evaluate("if(BUILD_TESTING)\n  find_package(nobody_has_this_msgs REQUIRED)\nendif()")
    assert plan.missing == []


def test_the_source_of_a_well_known_package_is_named(evaluate):
    plan, _ = evaluate("find_package(nav2_msgs REQUIRED)\nfind_package(vision_msgs REQUIRED)")
    (line,) = plan.missing
    assert ": there is no package 'nav2_msgs'; nav2_msgs does not come with turtlewire." in line
    assert "git clone -b jazzy https://github.com/ros-navigation/navigation2" in line
    body = "rosidl_generate_interfaces(robot msg/A.msg DEPENDENCIES px4_msgs)"
    plan, _ = evaluate(body, **{"msg/A.msg": "int8 a\n"})
    assert "git clone -b main https://github.com/PX4/px4_msgs" in plan.missing[0]


def test_the_nearest_package_is_named(tmp_path):
    markers = tmp_path / "share/ament_index/resource_index/packages"
    markers.mkdir(parents=True)
    (markers / "walker_msgs").touch()
    lookup = PackageLookup({"AMENT_PREFIX_PATH": f"{tmp_path}{os.pathsep}{tmp_path}/none"})
    assert lookup.advice("walke_mgs").startswith(" (Did you mean: walker_msgs")
    assert lookup.advice("x").startswith("; add it")


@pytest.mark.parametrize(
    "body",
    [
        "add_executable(walker src/walker.cpp)",
        "add_library(walker SHARED src/walker.cpp)",
        "add_library(walker src/walker.cpp)",
        "pybind11_add_module(walker src/walker.cpp)",
        'rclcpp_components_register_nodes(walker "a::B")',
        "ament_auto_add_library(walker src/walker.cpp)",
        "externalproject_add(walker URL x)",
    ],
)  # fmt: skip
def test_a_compiled_target_is_left_out_by_name(evaluate, body):
    plan, _ = evaluate(body)
    errors, (line,) = plan.verdict()
    assert errors == []
    assert line.endswith(
        "CMakeLists.txt:4: turtlewire compiles no C++, so walker is left out; the rest of the "
        "package is installed"
    )


@pytest.mark.parametrize(("count", "rest"), [(4, " are"), (5, " and 1 more are")])
def test_many_compiled_targets_are_one_line(evaluate, count, rest):
    targets = "\n".join(f"add_executable(t{number} a.cpp)" for number in range(count))
    _, (line,) = evaluate(targets)[0].verdict()
    assert f"so t0, t1, t2, t3{rest} left out" in line


def test_the_executable_of_a_component_is_left_out_with_its_library(evaluate):
    plan, _ = evaluate('rclcpp_components_register_node(lib PLUGIN "a::B" EXECUTABLE talker)')
    assert [target.name for target in plan.compiled] == ["lib", "talker"]


def test_faults_beside_cpp_are_warnings(evaluate):
    plan, _ = evaluate(
        "add_executable(walker a.cpp)\ncompile_shaders(a b)\n"
        "find_package(unknown_cpp_library REQUIRED)\n"
        'message(FATAL_ERROR "needs CUDA")\n'
        "install(PROGRAMS a.py DESTINATION lib/${PROJECT_NAME})"
    )
    errors, warnings = plan.verdict()
    assert errors == []
    lines = [line.split("CMakeLists.txt:")[1].split(":")[0] for line in warnings]
    assert lines == ["4", "7", "6", "5"]
    assert [install.kind for install in plan.installs] == ["PROGRAMS"]


@pytest.mark.parametrize(
    "body",
    [
        "rosidl_generate_interfaces(robot msg/None.msg)",
        "ament_python_install_package(nowhere)",
        "catkin_package()",
        "ament_python_install_package()",
    ],
)
def test_faults_in_the_python_part_stay_errors_beside_cpp(evaluate, body):
    with pytest.raises(CMakeError, match=body.partition("(")[0]):
        evaluate(f"add_executable(walker a.cpp)\n{body}")


def test_the_standards_that_packages_ask_for_are_there(evaluate):
    # The lines are nav2_package()'s, with which every package of Nav2 begins.
    body = (
        'if(NOT "cxx_std_17" IN_LIST CMAKE_CXX_COMPILE_FEATURES)\n'
        '  message(FATAL_ERROR "cxx_std_17 could not be found.")\nendif()\n'
        "if(CMAKE_CXX_COMPILER_ID MATCHES GNU)\n  set(X gnu)\nendif()"
    )
    assert value(evaluate, body) == "gnu"


def test_files_of_the_build_folder_are_missing_beside_cpp(evaluate, tmp_path):
    body = (
        "add_library(walker SHARED a.cpp)\ngenerate_export_header(walker)\n"
        "install(FILES ${CMAKE_CURRENT_BINARY_DIR}/walker_export.h DESTINATION include)\n"
        "install(FILES package.xml DESTINATION share/doc)"
    )
    plan, run = evaluate(body)[0], None
    assert plan.verdict()[0] == []
    prefix = tmp_path / "prefix"
    installer = PlanInstaller(plan, run, tmp_path / "robot", prefix, prefix / "lib/py")
    installer.install()
    (line,) = installer.warnings
    assert "install(FILES): there is no" in line
    assert line.endswith("walker_export.h")
    assert (prefix / "share/doc/package.xml").is_file()
    index = prefix / "share/ament_index/resource_index/turtlewire_compiled_targets/robot"
    assert index.read_text() == "walker"


def test_a_file_that_has_to_exist(evaluate):
    evaluate('assert_file_exists(package.xml "no manifest")\nstamp(package.xml)')
    with pytest.raises(CMakeError, match="no mesh"):
        evaluate('assert_file_exists(mesh.stl "no mesh")')


@pytest.mark.parametrize(
    "body",
    [
        "add_library(headers INTERFACE)\ntarget_link_libraries(headers INTERFACE a::b)",
        "add_library(a::b ALIAS headers)",
        "if(BUILD_TESTING)\n  add_executable(a a.cpp)\n  who_knows_this()\nendif()",
        "if(BUILD_TESTING AND NOT WIN32)\n  ament_add_gtest(b b.cpp)\nendif()",
        "ament_export_dependencies(std_msgs)\nament_export_targets(x HAS_LIBRARY_TARGET)",
        "set_target_properties(a PROPERTIES B C)\ntarget_compile_features(a PUBLIC cxx_std_17)",
        "include(CTest)\ninclude(GNUInstallDirs)",
        "include(CheckIncludeFile)\ncheck_include_file(a.h HAVE_A)\nFetchContent_Declare(a URL b)",
    ],
)  # fmt: skip
def test_targets_without_compilation_pass(evaluate, body):
    assert evaluate(body)[0].verdict() == ([], [])


def test_interfaces_and_a_python_package_of_one_name_are_an_error(evaluate):
    plan, _ = evaluate(
        "rosidl_generate_interfaces(robot msg/A.msg)\nament_python_install_package(robot)",
        **{"msg/A.msg": "int32 a\n", "robot/__init__.py": ""},
    )
    ((line,), _) = plan.verdict()
    assert line.endswith(
        ":5: rosidl_generate_interfaces also generates a Python package robot; rename one of them"
    )


def test_hooks_that_ament_names_are_left_out(evaluate):
    assert (
        evaluate('ament_environment_hooks("${ament_cmake_package_templates_PATH}")')[0].hooks == []
    )


def test_an_unknown_command_is_an_error(evaluate):
    errors, _ = evaluate("make_coffee(now)")[0].verdict()
    assert (
        errors[0]
        .split("CMakeLists.txt")[1]
        .startswith(":4: the command make_coffee() is not known; ")
    )


def test_definitions_of_the_command_line(evaluate):
    body = (
        'set(FAST OFF CACHE BOOL "doc")\nif(BUILD_TESTING)\n  add_test(NAME a COMMAND b)\nendif()'
    )
    plan, variables = evaluate(body, "-DFAST:BOOL=ON", "-DBUILD_TESTING=OFF", "--trace")
    assert variables["FAST"] == "ON"
    assert plan.tests == []


def test_tests(evaluate, tmp_path):
    plan, _ = evaluate(
        "add_executable(compiled a.cpp)\nif(BUILD_TESTING)\n"
        "  ament_add_pytest_test(one test/test_one.py TIMEOUT 90 ENV A=1 B=2)\n"
        "  add_launch_test(test/two.py ARGS a:=b)\n"
        "  ament_add_test(three COMMAND echo hello WORKING_DIRECTORY test)\n"
        "  add_test(NAME four COMMAND compiled)\n"
        "  add_test(NAME of_a_target COMMAND $<TARGET_FILE:compiled>)\n"
        "  ament_add_test(without_command)\n"
        "  ament_add_pytest_test(five test/test_one.py SKIP_TEST)\n"
        '  add_launch_test(test/two.py TARGET six RUNNER "${x_DIR}/run_test_isolated.py")\n'
        "  ament_add_ros_isolated_pytest_test(seven test/test_one.py)\n"
        "  ament_add_ros_isolated_gtest(eight a.cpp)\nendif()",
        **{"test/test_one.py": "", "test/two.py": ""},
    )
    folder = tmp_path / "robot"
    assert [(test.name, test.kind, test.words) for test in plan.tests] == [
        ("one", "pytest", (f"{folder}/test/test_one.py",)),
        ("test_two.py", "launch", (f"{folder}/test/two.py", "a:=b")),
        ("three", "command", ("echo", "hello")),
        ("six", "launch", (f"{folder}/test/two.py",)),
        ("seven", "pytest", (f"{folder}/test/test_one.py",)),
    ]
    assert [test.name for test in plan.tests if test.isolated] == ["six", "seven"]
    assert plan.tests[0].environment == {"A": "1", "B": "2"}
    assert [test.timeout for test in plan.tests] == [90, 60, 60, 60, 60]
    assert plan.tests[2].folder == os.path.join(folder, "test")


@pytest.mark.parametrize(
    "command", ["ament_add_pytest_test(one test/nope.py)", "add_launch_test(test/nope.py)"]
)
def test_a_test_whose_file_is_missing_is_an_error(evaluate, tmp_path, command):
    with pytest.raises(CMakeError, match=r"CMakeLists.txt:4: .*there is no file .*/test/nope.py"):
        evaluate(command)


def test_a_subfolder_has_its_own_variables(evaluate, tmp_path):
    plan, variables = evaluate(
        "set(X outside)\nadd_subdirectory(sub)",
        **{"sub/CMakeLists.txt": "set(X inside)\ninstall(FILES a DESTINATION share)\n"
           "set(SEEN ${X} PARENT_SCOPE)\n"},
    )  # fmt: skip
    assert (variables["X"], variables["SEEN"]) == ("outside", "inside")
    assert plan.installs[0].sources == (str(tmp_path / "robot" / "sub" / "a"),)


def test_steps_tests_and_code_that_runs_last(evaluate, tmp_path):
    plan, _ = evaluate(
        "add_custom_command(OUTPUT a.txt COMMAND ${CMAKE_COMMAND} -E touch a.txt COMMENT x)\n"
        "add_custom_target(all_of_it ALL DEPENDS a.txt COMMAND echo a > b.txt)\n"
        "add_custom_target(when_asked COMMAND echo never)\n"
        "add_custom_command(TARGET compiled POST_BUILD COMMAND echo never)\n"
        'install(CODE "message(hello)")\nadd_test(NAME plain COMMAND true)\n'
        'file(GENERATE OUTPUT g.txt CONTENT "generated")'
    )
    assert [step.words for step in plan.steps] == [
        (sys.executable, "-m", "turtlewire_colcon.cmake.tool", "-E", "touch", "a.txt"),
        ("sh", "-c", "echo a > b.txt"),
    ]
    build = tmp_path / "build"
    assert plan.steps[0].folder == str(build)
    assert [text for text, _ in plan.install_code] == ["message(hello)"]
    assert (plan.tests[0].folder, plan.tests[0].timeout) == (str(build), 1500)
    assert (build / "g.txt").read_text() == "generated"


def test_cmake_e_commands(tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for words in (
        ["make_directory", "a/b"],
        ["touch", "a/b/c"],
        ["copy", "a/b/c", "d"],
        ["copy_directory", "a", "e"],
        ["create_symlink", "d", "link"],
        ["create_symlink", "e", "link"],
        ["rm", "-rf", "a", "d"],
        ["env", "WHO=me", "--unset=HOME", "sh", "-c", "echo $WHO $HOME"],
    ):
        assert tool(["-E", *words]) == 0
    assert sorted(path.as_posix() for path in tmp_path.rglob("*")) == [
        f"{tmp_path}/{name}" for name in ("e", "e/b", "e/b/c", "link")
    ]
    assert os.readlink("link") == "e"
    assert tool(["-E", "copy", "nothing", "x"]) == 1
    assert tool(["--build", "."]) == 1
    output = capfd.readouterr()
    assert output.out == "me\n"
    assert "cmake -E copy nothing x: " in output.err
    assert "cmake --build .: only cmake -E " in output.err
