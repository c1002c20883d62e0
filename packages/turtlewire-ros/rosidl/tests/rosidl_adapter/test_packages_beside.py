"""`rosidl_parser`, `rpyutils` and `osrf_pycommon`, which launch files and tools import."""

import pathlib
import sys

import pytest

import rpyutils
from rosidl_parser import definition
from rosidl_parser.definition import (
    Annotation,
    BasicType,
    IdlContent,
    IdlFile,
    IdlLocator,
    Include,
    Member,
    Message,
    NamedType,
    NamespacedType,
    Structure,
)
from rosidl_pycommon.interface_base_classes import BaseAction, BaseImpl, BaseMessage, BaseService
from std_msgs.msg import String
from std_srvs.srv import SetBool
from turtlesim.action import RotateAbsolute


def message(name):
    return Message(
        Structure(NamespacedType(("p", "action"), name), [Member(BasicType("int8"), "a")])
    )


def test_an_action_implies_services_and_a_message():
    parts = [message(f"Go_{part}") for part in ("Goal", "Result", "Feedback")]
    action = definition.Action(NamespacedType(("p", "action"), "Go"), *parts)
    assert action.send_goal_service.namespaced_type.name == "Go_SendGoal"
    request = action.send_goal_service.request_message.structure
    assert [member.name for member in request.members] == ["goal_id", "goal"]
    assert request.members[1].type == parts[0].structure.namespaced_type
    response = action.get_result_service.response_message.structure
    assert [str(member.type) for member in response.members] == ["int8", "p/Go_Result"]
    event = action.send_goal_service.event_message.structure
    assert event.namespaced_type.name == "Go_SendGoal_Event"
    assert event.members[1].type.maximum_size == 1
    assert action.feedback_message.structure.namespaced_type.name == "Go_FeedbackMessage"
    assert [include.locator for include in action.implicit_includes] == [
        "builtin_interfaces/msg/Time.idl",
        "unique_identifier_msgs/msg/UUID.idl",
    ]


def test_annotations_and_files(tmp_path):
    member = Member(NamedType("double__3"), "x")
    member.annotations += [
        Annotation("verbatim", {"language": "comment", "text": "one\ntwo"}),
        Annotation("unit", {"value": "m"}),
        Annotation("key", {}),
        Annotation("key", {}),
    ]
    assert member.get_comment_lines() == ["one", "two"]
    assert member.get_annotation_value("unit") == {"value": "m"}
    assert member.has_annotation("unit")
    assert not member.has_annotation("key")
    assert member.has_annotations("key")
    structure = Structure(NamespacedType(("p", "msg"), "M"), [member])
    assert structure.has_any_member_with_annotation("unit")
    content = IdlContent()
    content.elements += [Include("a.idl"), Message(structure)]
    file = IdlFile(IdlLocator(tmp_path, pathlib.Path("msg/M.idl")), content)
    assert file.content.get_elements_of_type(Include) == content.elements[:1]
    assert file.locator.get_absolute_path() == tmp_path / "msg" / "M.idl"
    assert BasicType("int8") != NamedType("int8")
    assert NamedType("a") == NamedType("a")


def test_a_library_that_is_broken_names_the_page_that_helps(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    suffix = ".pyd" if sys.platform == "win32" else ".so"
    (tmp_path / f"no_library{suffix}").write_bytes(b"")
    with pytest.raises(ImportError, match="failed to be imported while being present"):
        rpyutils.import_c_library("no_library")
    with pytest.raises(ImportError, match="No module named 'not_there_at_all'"):
        rpyutils.import_c_library("not_there_at_all")
    assert rpyutils.import_c_library("json").loads("1") == 1


# The library leaves its pipes to the garbage collector.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_processes_of_osrf_pycommon():
    from osrf_pycommon.process_utils import execute_process, which
    from osrf_pycommon.terminal_color import format_color, remove_ansi_escape_sequences

    assert which(sys.executable)
    *lines, status = execute_process([sys.executable, "-c", "print('hello')"])
    assert status == 0
    assert b"".join(lines).strip() == b"hello"
    assert remove_ansi_escape_sequences(format_color("@{gf}green@|")).strip() == "green"


# The base classes of interfaces.


def test_interfaces_have_their_bases():
    assert isinstance(String(), BaseMessage)
    assert isinstance(SetBool.Request(), BaseMessage)
    assert issubclass(RotateAbsolute.Goal, BaseMessage)
    assert issubclass(SetBool, BaseService)
    assert issubclass(RotateAbsolute, BaseAction)
    assert issubclass(RotateAbsolute.Impl, BaseImpl)
    assert not issubclass(SetBool, BaseMessage)
    assert RotateAbsolute.Impl.SendGoalService.Request().goal_id is not None
