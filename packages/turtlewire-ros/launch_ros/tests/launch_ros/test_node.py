"""Starting nodes: names, parameters, remappings and additions of the scope."""

import os
import sys

import pytest
import yaml

from launch.actions import GroupAction, IncludeLaunchDescription, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import (
    Node,
    PushRosNamespace,
    SetParameter,
    SetParametersFromFile,
    SetRemap,
    SetROSLogDir,
    SetUseSimTime,
)
from launch_ros.descriptions import Parameter, ParameterFile, ParameterValue
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare
from launch_ros.substitutions import Parameter as ParameterSubstitution
from launch_ros.utilities import get_node_name_count

#: Shows its arguments, and the parameter files among them.
SHOW = """#!/usr/bin/env python3
import json, os, sys
arguments = sys.argv[1:]
files = [arguments[at + 1] for at, word in enumerate(arguments) if word == "--params-file"]
texts = [open(path).read() for path in files]
log = os.environ.get("ROS_LOG_DIR")
print(json.dumps({"arguments": arguments, "files": texts, "log": log}))
"""


@pytest.fixture
def show(tmp_path, monkeypatch):
    """A package `shows` with an executable `show`, in its own prefix."""
    (tmp_path / "share/ament_index/resource_index/packages").mkdir(parents=True)
    (tmp_path / "share/ament_index/resource_index/packages/shows").touch()
    (tmp_path / "lib/shows").mkdir(parents=True)
    (tmp_path / "share/shows").mkdir()
    script = tmp_path / "lib/shows/show"
    script.write_text(SHOW)
    script.chmod(0o755)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    return tmp_path


@pytest.fixture
def nodes(launch, show):
    """Launches entities; what each of the nodes found, in the order of their numbers."""

    def start(*entities):
        outcome = launch(*entities)
        assert outcome.status == 0, outcome.text
        seen = {}
        for line in outcome.lines:
            name, bracket, found = line.partition("] ")
            if name.startswith("[show-") and bracket:
                seen[int(name.removeprefix("[show-"))] = yaml.safe_load(found)
        return [seen[number] for number in sorted(seen)]

    return start


def node(**options):
    return Node(package="shows", executable="show", output="screen", **options)


def without_files(arguments):
    return [
        "FILE" if arguments[at - 1] == "--params-file" else word
        for at, word in enumerate(arguments)
    ]


def test_a_bare_node(nodes):
    (seen,) = nodes(node())
    assert seen["arguments"] == ["--ros-args"]


def test_all_kinds_of_arguments_in_their_order(nodes, tmp_path):
    (tmp_path / "params.yaml").write_text("/**: {ros__parameters: {a: 1}}")
    (seen,) = nodes(
        node(
            name="n",
            namespace="ns",
            arguments=["first", ["sec", "ond"]],
            ros_arguments=["--log-level", "debug"],
            parameters=[{"x": 1.5}, str(tmp_path / "params.yaml"), Parameter("p", True)],
            remappings=[("from", "to"), (["a", "b"], LaunchConfiguration("none", default="c"))],
        )
    )
    assert without_files(seen["arguments"]) == (
        [
            "first",
            "second",
            "--ros-args",
            "--log-level",
            "debug",
            "-r",
            "__node:=n",
            "-r",
            "__ns:=/ns",
            "--params-file",
            "FILE",
            "--params-file",
            "FILE",
            "-p",
            "p:=true",
            "-r",
            "from:=to",
            "-r",
            "ab:=c",
        ]
    )
    assert yaml.safe_load(seen["files"][0]) == {"/ns/n": {"ros__parameters": {"x": 1.5}}}


def test_parameter_files_are_removed_at_the_end(nodes):
    (seen,) = nodes(node(name="n", parameters=[{"x": 1}, {"y": 2}]))
    paths = [word for word in seen["arguments"] if "launch_params_" in word]
    assert len(paths) == 2
    assert not any(map(os.path.exists, paths))


def test_parameter_files_of_a_node_that_cannot_be_prepared_are_removed(launch, show, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(show))
    bad = [node(name="n", parameters=[{"x": 1}, {"y": LaunchConfiguration("nothing")}])]
    assert launch(*bad).error == "launch configuration 'nothing' does not exist"
    assert not list(show.glob("launch_params_*"))


def test_values_of_parameters(nodes):
    values = {
        "text": "5",
        "number": 5,
        "float": 1e-7,
        "flag": False,
        "numbers": [1, 2.5],
        "texts": ["a", "1"],
        "empty": "",
        "nested": {"deep": {"er": 1}},
        "substituted": LaunchConfiguration("five"),
        "joined": ["1", LaunchConfiguration("five")],
        "typed": ParameterValue(LaunchConfiguration("five"), value_type=str),
        "float_of_int": ParameterValue(5, value_type=float),
        "texts_of_numbers": ParameterValue([1, 2], value_type=list[str]),
        "numbers_of_text": ParameterValue("[1, 2]", value_type=list[float]),
        ("sub", LaunchConfiguration("five")): "name",
        "unicode": "Schildkröte: {}",
    }
    (seen,) = nodes(SetLaunchConfiguration("five", "5"), node(parameters=[values]))
    assert yaml.safe_load(seen["files"][0]) == {
        "/**": {
            "ros__parameters": {
                "text": "5",
                "number": 5,
                "float": 1e-7,
                "flag": False,
                "numbers": [1.0, 2.5],
                "texts": ["a", "1"],
                "empty": "",
                "nested.deep.er": 1,
                "substituted": 5,
                "joined": 15,
                "typed": "5",
                "float_of_int": 5.0,
                "texts_of_numbers": ["1", "2"],
                "numbers_of_text": [1.0, 2.0],
                "sub5": "name",
                "unicode": "Schildkröte: {}",
            }
        }
    }


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        (
            [{"x": [1, "a"]}],
            "the sequence of the parameter 'x' must hold values of one type, but has int, str",
        ),
        ([{"x": object()}], "the parameter 'x' has a value of type object"),
        ([{"x": ParameterValue("a", value_type=int)}], "invalid literal for int"),
        (
            [{"x": ParameterValue("a", value_type=bool)}],
            "Expected one of 'yes|true|on|no|false|off', got 'a'",
        ),
        ([{"x": ParameterValue("a", value_type=list[int])}], "'a' is not a list of int"),
    ],
)
def test_values_that_parameters_do_not_have(launch, show, parameters, message):
    outcome = launch(node(parameters=parameters))
    assert outcome.status == 1
    assert message in outcome.error


@pytest.mark.parametrize("parameters", ["file.yaml", 3, LaunchConfiguration("x")])
def test_parameters_are_a_list(parameters):
    with pytest.raises(
        TypeError, match="Expecting a list of parameter files or parameter dictionaries"
    ):
        node(parameters=parameters)


def test_a_parameter_file_that_is_not_there_warns(launch, show):
    outcome = launch(node(parameters=["nowhere.yaml"]))
    assert (
        "[WARNING] [launch_ros.actions.node]: Parameter file path is not a file: nowhere.yaml"
        in outcome.lines
    )
    assert outcome.status == 0


def test_parameter_files_with_substitutions(nodes, tmp_path):
    (tmp_path / "params.yaml").write_text("x: $(var five)")
    shared = ParameterFile(str(tmp_path / "params.yaml"), allow_substs=True)
    first, second, plain = nodes(
        SetLaunchConfiguration("five", "5"),
        node(parameters=[shared]),
        node(parameters=[shared]),
        node(parameters=[shared.param_file[0]]),
    )
    assert first["files"] == second["files"] == ["x: 5"]
    assert plain["files"] == ["x: $(var five)"]
    assert plain["arguments"][-1] == str(tmp_path / "params.yaml")
    copies = [seen["arguments"][-1] for seen in (first, second)]
    assert len(set(copies)) == 2
    assert not any(map(os.path.exists, copies))


def test_a_variable_says_whether_a_parameter_file_has_substitutions(nodes, tmp_path):
    (tmp_path / "params.yaml").write_text("x: $(var asked)")
    path = tmp_path / "x.launch.xml"
    path.write_text(
        "<launch><node pkg='shows' exec='show' output='screen'>"
        f"<param from='{tmp_path}/params.yaml' allow_substs='$(var asked)'/></node></launch>"
    )
    found = [
        nodes(SetLaunchConfiguration("asked", asked), IncludeLaunchDescription(str(path)))
        for asked in ("true", "false")
    ]
    assert [node["files"] for (node,) in found] == [["x: true"], ["x: $(var asked)"]]


def test_scope_additions(nodes, tmp_path):
    (tmp_path / "params.yaml").touch()
    inside, outside = nodes(
        GroupAction(
            [
                PushRosNamespace("robot"),
                PushRosNamespace("arm"),
                SetParameter("speed", 2),
                SetUseSimTime(True),
                SetParametersFromFile(str(tmp_path / "params.yaml")),
                SetRemap("a", "b"),
                node(namespace="hand", parameters=[{"x": 1}], remappings=[("c", "d")]),
            ]
        ),
        node(),
    )
    assert without_files(inside["arguments"])[1:] == (
        [
            "-r",
            "__ns:=/robot/arm/hand",
            "-p",
            "speed:=2",
            "-p",
            "use_sim_time:=true",
            "--params-file",
            "FILE",
            "--params-file",
            "FILE",
            "-r",
            "a:=b",
            "-r",
            "c:=d",
        ]
    )
    assert outside["arguments"] == ["--ros-args"]


@pytest.mark.parametrize(
    ("pushed", "own", "expected"),
    [
        ("a", None, "/a"),
        ("/a", "b", "/a/b"),
        ("a/", "/b", "/b"),
        ("a", "", "/a"),
        ("/", "b", "/b"),
        ("", "b", "/b"),
        ("a", "/", "/"),
    ],
)
def test_namespaces(nodes, pushed, own, expected):
    (seen,) = nodes(PushRosNamespace(pushed), node(namespace=own))
    assert seen["arguments"][-1] == f"__ns:={expected}"


def test_log_folder_of_nodes(nodes, tmp_path):
    (seen,) = nodes(SetROSLogDir([str(tmp_path), "/logs"]), node())
    assert seen["log"] == f"{tmp_path}/logs"


def test_names(launch, show):
    named, unnamed = node(name="n", namespace="/ns"), node()
    assert named.node_name == "/<node_name_unspecified>"
    outcome = launch(named, unnamed)
    assert named.node_name == "/ns/n"
    assert named.is_node_name_fully_specified()
    assert unnamed.node_name == "/<node_name_unspecified>"
    assert not unnamed.is_node_name_fully_specified()
    assert get_node_name_count(outcome.context, "/ns/n") == 1


def test_equal_names_are_warned_of(launch, show):
    outcome = launch(node(name="n"), node(name="n"), node(name="n", namespace="other"))
    warnings = [line for line in outcome.lines if line.startswith("[WARNING]")]
    assert len(warnings) == 1
    assert warnings[0].endswith(
        "]: there are now at least 2 nodes with the name /n created within this launch context"
    )


def test_executables_and_packages(launch, show, context):
    assert ExecutableInPackage("show", "shows").perform(context) == str(show / "lib/shows/show")
    assert FindPackagePrefix("shows").perform(context) == str(show)
    assert FindPackageShare("shows").perform(context) == str(show / "share/shows")
    assert FindPackageShare("shows").describe() == "FindPackageShare(pkg='shows')"
    assert launch(node(exec_name="mine", name="n")).text.count("[mine-") >= 3
    missing = launch(Node(package="shows", executable="hide"))
    assert (
        missing.error == f"executable 'hide' not found on the libexec directory '{show}/lib/shows' "
    )
    assert launch(Node(package="nowhere", executable="x")).error.startswith(
        "\"package 'nowhere' not found, searching: ['"
    )


def test_an_executable_without_package(launch, show):
    outcome = launch(
        Node(executable=str(show / "lib/shows/show"), output="screen", arguments=["x"])
    )
    assert '{"arguments": ["x", "--ros-args"]' in outcome.text


def test_python_nodes_run_on_this_interpreter(launch, show):
    (show / "lib/shows/which").write_text("#!/no/such/python3\nimport sys; print(sys.executable)")
    (show / "lib/shows/which").chmod(0o755)
    outcome = launch(Node(package="shows", executable="which", output="screen"))
    assert any(line.endswith(f"] {sys.executable}") for line in outcome.lines)


def test_a_parameter_of_the_scope_as_text(context):
    SetParameter("speed", 2.5).execute(context)
    assert ParameterSubstitution("speed").perform(context) == "2.5"
    assert ParameterSubstitution("none", default="x").perform(context) == "x"
    with pytest.raises(Exception, match="parameter 'none' not found"):
        ParameterSubstitution("none").perform(context)


XML = """
<launch>
  <push_ros_namespace namespace="robot"/>
  <set_parameter name="speed" value="2"/>
  <set_parameter name="label" value="'2'"/>
  <set_use_sim_time value="true"/>
  <set_remap from="a" to="b"/>
  <node pkg="shows" exec="show" name="n" namespace="arm" output="screen"
        args="one 'two words' $(var three 3)" ros_args="--log-level info">
    <param name="int" value="5"/>
    <param name="text" value="'5'"/>
    <param name="typed" value="007" type="str"/>
    <param name="list" value="1;2;3" value-sep=";"/>
    <param name="texts" value="'a', b" value-sep=", "/>
    <param name="substituted" value="$(var five 5)"/>
    <param name="as_text" value="$(var five 5)" type="str"/>
    <param name="group">
      <param name="inner" value="true"/>
      <param name="deeper"><param name="x" value="1.5"/></param>
    </param>
    <remap from="c" to="d"/>
    <env name="ROS_LOG_DIR" value="/mine"/>
  </node>
</launch>
"""
YAML = """
launch:
- push_ros_namespace: {namespace: robot}
- set_parameter: {name: speed, value: 2}
- set_parameter: {name: label, value: "2"}
- set_use_sim_time: {value: true}
- set_remap: {from: a, to: b}
- node:
    pkg: shows
    exec: show
    name: n
    namespace: arm
    output: screen
    args: one 'two words' $(var three 3)
    ros_args: --log-level info
    param:
    - {name: int, value: 5}
    - {name: text, value: "5"}
    - {name: typed, value: "007", type: str}
    - {name: list, value: [1, 2, 3]}
    - {name: texts, value: [a, b]}
    - {name: substituted, value: $(var five 5)}
    - {name: as_text, value: $(var five 5), type: str}
    - name: group
      param: [{name: inner, value: true}, {name: deeper, param: [{name: x, value: 1.5}]}]
    remap: [{from: c, to: d}]
    env: [{name: ROS_LOG_DIR, value: /mine}]
"""


@pytest.mark.parametrize("language", ["xml", "yaml"])
def test_launch_files_in_other_languages(nodes, tmp_path, language):
    path = tmp_path / f"x.launch.{language}"
    path.write_text(XML if language == "xml" else YAML)
    (seen,) = nodes(IncludeLaunchDescription(str(path)))
    assert without_files(seen["arguments"]) == (
        [
            "one",
            "two words",
            "3",
            "--ros-args",
            "--log-level",
            "info",
            "-r",
            "__node:=n",
            "-r",
            "__ns:=/robot/arm",
            "-p",
            "speed:=2",
        ]
        + ["-p", "label:='2'", "-p", "use_sim_time:=true"]
        + ["--params-file", "FILE"] * 8
        + ["-r", "a:=b", "-r", "c:=d"]
    )
    found = {}
    for text in seen["files"]:
        found |= yaml.safe_load(text)["/robot/arm/n"]["ros__parameters"]
    assert found == {
        "int": 5,
        "text": "5",
        "typed": "007",
        "list": [1, 2, 3],
        "texts": ["a", "b"],
        "substituted": 5,
        "as_text": "5",
        "group.inner": True,
        "group.deeper.x": 1.5,
    }
    assert seen["log"] == "/mine"


@pytest.mark.parametrize(
    ("parameter", "error"),
    [
        ("<param name='x'/>", "either a value attribute or nested parameters are needed"),
        ("<param name='x' from='y'/>", "name and from attributes are mutually exclusive"),
        (
            "<param name='x' value='1'><param name='y' value='1'/></param>",
            "nested parameters and value attributes are mutually exclusive",
        ),
        (
            "<param name='x' value='1' type='colour'/>",
            "unknown type 'colour' of a parameter; one of: str, int, float, bool, list_of_str",
        ),
        (
            "<param name='x' value='1' unit='m'/>",
            "Unexpected attribute(s) found in `param`: {'unit'}",
        ),
        (
            "<param from='x' allow_substs='maybe'/>",
            "Attribute 'allow_substs' of Entity 'param' expected to be of type '<class 'bool'>'",
        ),
    ],
)
def test_param_elements_that_are_wrong(launch, tmp_path, parameter, error):
    path = tmp_path / "x.launch.xml"
    path.write_text(f"<launch><node pkg='shows' exec='show'>{parameter}</node></launch>")
    assert error in launch(IncludeLaunchDescription(str(path))).text
