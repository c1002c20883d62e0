"""Message, service and action classes as ROS 2's generator makes them."""

import copy
import os
import pickle
from array import array

import numpy as np
import pytest
from tests.programs import run_python

from geometry_msgs.msg import PoseWithCovariance, Quaternion, TransformStamped, Vector3
from rcl_interfaces.msg import Log, ParameterValue
from rosidl_parser.definition import BasicType, NamespacedType, UnboundedString
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Byte, Header
from turtlesim.action import RotateAbsolute
from turtlesim.srv import Spawn
from turtlewire import msg
from turtlewire.errors import InterfaceError


def test_repr_is_that_of_ros():
    assert repr(Vector3(x=1.5)) == "geometry_msgs.msg.Vector3(x=1.5, y=0.0, z=0.0)"
    assert (
        repr(Header(frame_id="map"))
        == "std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time(sec=0, nanosec=0), "
        "frame_id='map')"
    )
    assert (
        repr(Spawn.Request(name="t"))
        == "turtlesim.srv.Spawn_Request(x=0.0, y=0.0, theta=0.0, name='t')"
    )
    state = repr(JointState(name=["a"], position=[1, 2]))
    assert state.endswith("name=['a'], position=[1.0, 2.0], velocity=[], effort=[])")
    covariance = repr(PoseWithCovariance()).partition("covariance=")[2]
    assert covariance.replace("\n", "").replace(" ", "") == f"array([{','.join(['0.'] * 36)}]))"


def test_the_constructor_takes_keywords_only_and_refuses_unknown_ones():
    assert Vector3(y=2.0).y == 2.0
    with pytest.raises(TypeError):
        Vector3(1.0)
    with pytest.raises(AssertionError) as caught:
        Vector3(x=1.0, w=2.0, a=0.0)
    assert str(caught.value) == "Invalid arguments passed to constructor: a, w"
    assert caught.value.hint == "The fields are x, y, z."
    assert getattr(caught.value, "__notes__", [caught.value.hint]) == [caught.value.hint]


def test_names_that_are_no_str():
    with pytest.raises(TypeError, match=r"a message, for example 'geo.*/Twist', not NoneType$"):
        msg.get_message(None)
    with pytest.raises(TypeError, match=r"not list$"):
        msg.get_message([])
    with pytest.raises(TypeError, match=r"not the class Vector3$"):
        msg.get_message(Vector3)
    with pytest.raises(TypeError, match=r"a service, for example '.*/Spawn', not int$"):
        msg.get_service(3)
    with pytest.raises(TypeError, match=r"an action, for example '.*/RotateAbsolute', not int$"):
        msg.get_action(3)


@pytest.mark.parametrize("check", [False, True])
def test_slots_have_the_names_of_ros_2(check):
    for name in ("tf2_msgs/msg/TFMessage", "sensor_msgs/msg/Imu", "turtlesim/srv/Spawn_Request"):
        message = msg.get_message(name)(check_fields=check)
        fields = list(message.get_fields_and_field_types())
        assert [slot[1:] for slot in message.__slots__] == fields
        for slot in message.__slots__:
            value = getattr(message, slot[1:])
            assert getattr(message, slot) is value
    imu = msg.get_message("sensor_msgs/msg/Imu")(check_fields=check)
    imu._orientation_covariance[3] = 2.0
    assert imu.orientation_covariance[3] == 2.0
    assert copy.deepcopy(imu) == pickle.loads(pickle.dumps(imu)) == imu


def test_fields_are_plain_slots_that_do_not_take_other_names():
    assert TransformStamped.__slots__ == ("_header", "_child_frame_id", "_transform")
    message = TransformStamped()
    assert not hasattr(message, "__dict__")
    with pytest.raises(
        AttributeError, match="'TransformStamped' object has no attribute 'frame_id'"
    ):
        message.frame_id = "map"


def test_every_message_has_its_own_nested_messages_and_sequences():
    one, other = TransformStamped(), TransformStamped()
    assert one.header is not other.header
    assert one.header.stamp is not other.header.stamp
    assert JointState().position is not JointState().position
    assert PoseWithCovariance().covariance is not PoseWithCovariance().covariance
    assert ParameterValue().string_array_value is not ParameterValue().string_array_value


def test_field_types_are_reported():
    assert TransformStamped.get_fields_and_field_types() == {
        "header": "std_msgs/Header",
        "child_frame_id": "string",
        "transform": "geometry_msgs/Transform",
    }
    header, child, _ = TransformStamped.SLOT_TYPES
    assert header == NamespacedType(["std_msgs", "msg"], "Header")
    assert child == UnboundedString()
    assert (BasicType("double"),) * 3 == Vector3.SLOT_TYPES


def test_defaults_and_constants_are_attributes_of_the_class():
    assert Quaternion().w == Quaternion.W__DEFAULT == 1.0
    assert (
        msg.get_service("type_description_interfaces/srv/GetTypeDescription")
        .Request()
        .include_type_sources
        is True
    )
    assert msg.get_message("sensor_msgs/msg/NavSatStatus")().status == -2
    assert Log.WARN == Log().WARN == 30
    assert msg.get_message("diagnostic_msgs/msg/DiagnosticStatus").WARN == b"\x01"
    assert msg.get_message("visualization_msgs/msg/Marker").ARROW == 0


def test_equality_compares_fields_of_messages_of_one_class():
    assert Vector3(x=1.0) == Vector3(x=1)
    assert Vector3(x=1.0) != Vector3(x=2.0)
    assert Vector3() != msg.get_message("geometry_msgs/msg/Point")()
    assert Vector3() != 0
    assert PoseWithCovariance() == PoseWithCovariance()
    assert PoseWithCovariance() != PoseWithCovariance(covariance=np.ones(36))
    with pytest.raises(TypeError, match="unhashable"):
        hash(Vector3())


def test_numbers_in_bulk_are_converted_at_assignment():
    scan = LaserScan()
    scan.ranges = [1, 2.5]
    assert scan.ranges == array("f", [1.0, 2.5])
    kept = array("f", [3.0])
    scan.ranges = kept
    assert scan.ranges is kept
    scan.ranges = np.linspace(0.0, 1.0, 3)
    assert scan.ranges == array("f", [0.0, 0.5, 1.0])
    scan.ranges = np.array([1.0, 2.0], dtype=np.float32)
    assert scan.ranges.tolist() == [1.0, 2.0]
    scan.ranges = (value for value in (1.0, 2.0))
    assert len(scan.ranges) == 2
    with pytest.raises(TypeError):
        scan.ranges = ["a"]
    image = msg.get_message("sensor_msgs/msg/Image")(data=b"\x01\x02")
    assert image.data == array("B", [1, 2])
    image.data = np.arange(6, dtype=np.uint8).reshape(2, 3)[:, ::2]
    assert image.data.tolist() == [0, 2, 3, 5]
    image.data = np.arange(4).reshape(2, 2)
    assert image.data.tolist() == [0, 1, 2, 3]
    numbers = msg.get_message("std_msgs/msg/Int64MultiArray")(data=np.arange(3))
    assert numbers.data == array("q", [0, 1, 2])
    pose = PoseWithCovariance(covariance=range(36))
    assert pose.covariance.dtype == np.float64
    assert pose.covariance[35] == 35.0


@pytest.mark.parametrize("received", [False, True])
def test_fixed_array_is_one_mutable_numpy_array(received):
    pose = PoseWithCovariance()
    if received:
        pose = msg.deserialize(PoseWithCovariance, msg.serialize(pose))
    assert type(pose.covariance) is np.ndarray
    assert pose.covariance.dtype == np.float64
    assert pose.covariance is pose.covariance
    pose.covariance[7] = 2.5
    assert msg.deserialize(PoseWithCovariance, msg.serialize(pose)).covariance[7] == 2.5
    assert PoseWithCovariance().covariance[7] == 0.0


def test_a_byte_is_bytes_of_length_one():
    assert Byte().data == b"\x00"
    assert msg.deserialize(Byte, msg.serialize(Byte(data=b"\xff"))).data == b"\xff"


def test_copies_are_independent_and_pickles_need_no_ros_package():
    message = JointState(name=["a"], position=[1.0])
    deep = copy.deepcopy(message)
    assert deep == message
    deep.name.append("b")
    deep.header.frame_id = "x"
    assert message == JointState(name=["a"], position=[1.0])
    data = pickle.dumps(message)
    assert pickle.loads(data) == message
    assert b"sensor_msgs.msg" not in data


def test_classes_know_their_names():
    assert msg.type_name(Vector3) == "geometry_msgs/msg/Vector3"
    assert msg.type_name(Spawn) == "turtlesim/srv/Spawn"
    assert msg.type_name(RotateAbsolute.Goal) == "turtlesim/action/RotateAbsolute_Goal"
    assert (Vector3.__module__, Vector3.__name__) == ("geometry_msgs.msg._vector3", "Vector3")
    assert RotateAbsolute.Goal.__module__ == "turtlesim.action._rotate_absolute"
    with pytest.raises(InterfaceError, match="<class 'int'> is not a ROS 2 interface class"):
        msg.type_name(int)


@pytest.mark.parametrize(
    ("name", "module"),
    [
        ("sensor_msgs/msg/PointCloud2", "sensor_msgs.msg._point_cloud2"),
        ("tf2_msgs/msg/TFMessage", "tf2_msgs.msg._tf_message"),
        ("std_msgs/msg/ColorRGBA", "std_msgs.msg._color_rgba"),
        ("std_msgs/msg/UInt8MultiArray", "std_msgs.msg._u_int8_multi_array"),
        ("sensor_msgs/msg/MultiDOFJointState", "sensor_msgs.msg._multi_dof_joint_state"),
    ],
)
def test_modules_are_named_as_by_the_generator_of_ros(name, module):
    assert msg.get_message(name).__module__ == module


def test_services_and_actions_have_their_parts():
    assert msg.get_service("turtlesim/Spawn") is Spawn
    assert Spawn.Request is msg.get_message("turtlesim/srv/Spawn_Request")
    assert list(Spawn.Event.get_fields_and_field_types()) == ["info", "request", "response"]
    assert RotateAbsolute.Impl.SendGoalService.Request.get_fields_and_field_types() == {
        "goal_id": "unique_identifier_msgs/UUID",
        "goal": "turtlesim/RotateAbsolute_Goal",
    }
    assert RotateAbsolute.Impl.GetResultService.Response().result == RotateAbsolute.Result()
    assert RotateAbsolute.Impl.FeedbackMessage().feedback == RotateAbsolute.Feedback()
    assert msg.type_name(RotateAbsolute.Impl.CancelGoalService) == "action_msgs/srv/CancelGoal"
    assert msg.type_name(RotateAbsolute.Impl.GoalStatusMessage) == "action_msgs/msg/GoalStatusArray"
    with pytest.raises(AttributeError, match="type object 'Spawn' has no attribute 'Nope'"):
        _ = Spawn.Nope
    with pytest.raises(NotImplementedError, match="Service classes can not be instantiated"):
        Spawn()
    with pytest.raises(NotImplementedError, match="Action classes can not be instantiated"):
        RotateAbsolute()


def test_kinds_are_not_mixed_up():
    with pytest.raises(InterfaceError, match="'turtlesim/srv/Spawn' is not a message"):
        msg.get_message("turtlesim/srv/Spawn")
    with pytest.raises(InterfaceError, match="'geometry_msgs/msg/Vector3' is not a service"):
        msg.get_service("geometry_msgs/msg/Vector3")
    with pytest.raises(InterfaceError, match="'turtlesim/srv/Spawn' is not an action"):
        msg.get_action("turtlesim/srv/Spawn")


def test_a_class_is_made_once_however_it_is_asked_for():
    assert (
        msg.get_message("geometry_msgs/Vector3")
        is msg.get_message("geometry_msgs/msg/Vector3")
        is Vector3
    )


def test_the_modules_of_packages_list_their_interfaces():
    import std_srvs.srv

    assert dir(std_srvs.srv) == ["Empty", "SetBool", "Trigger"]
    with pytest.raises(AttributeError, match=r"module 'std_srvs\.srv' has no attribute 'Nope'"):
        _ = std_srvs.srv.Nope
    with pytest.raises(ImportError, match=r"cannot import name 'Nope' from 'std_srvs\.srv'"):
        from std_srvs.srv import Nope  # noqa: F401


def test_the_parts_of_services_and_actions_are_imported_by_name():
    from tf2_msgs.action import LookupTransform, LookupTransform_SendGoal_Request
    from turtlesim.srv import Spawn_Event, Spawn_Request

    assert Spawn_Request is Spawn.Request
    assert Spawn_Event is Spawn.Event
    assert LookupTransform_SendGoal_Request is LookupTransform.Impl.SendGoalService.Request
    with pytest.raises(ImportError, match="cannot import name 'Spawn_Goal'"):
        from turtlesim.srv import Spawn_Goal  # noqa: F401


def test_the_private_modules_of_interfaces_are_imported():
    """As ROS 2's generator names them; in a separate process, where nothing is imported yet."""
    code = (
        "from geometry_msgs.msg._pose_stamped import PoseStamped\n"
        "from tf2_msgs.action._lookup_transform import LookupTransform_GetResult_Response\n"
        "import std_msgs.msg._u_int8_multi_array, turtlesim.srv._spawn as spawn\n"
        "from geometry_msgs import msg\n"
        "assert msg.PoseStamped is PoseStamped\n"
        "import std_msgs\n"
        "array = std_msgs.msg._u_int8_multi_array.UInt8MultiArray\n"
        "assert array is std_msgs.msg.UInt8MultiArray\n"
        "assert spawn.Spawn.Request is spawn.Spawn_Request\n"
        "assert spawn.__name__ == spawn.Spawn.__module__ == 'turtlesim.srv._spawn'\n"
        "try:\n"
        "    from turtlesim.srv._spawn import Kill\n"
        "except ImportError:\n"
        "    print('fine')\n"
    )
    done = run_python(code, check=False)
    assert (done.stdout, done.stderr) == ("fine\n", "")


def test_fields_and_field_types_is_there():
    expected = {"linear": "geometry_msgs/Vector3", "angular": "geometry_msgs/Vector3"}
    twist = msg.get_message("geometry_msgs/msg/Twist")
    assert twist._fields_and_field_types == expected
    assert twist()._fields_and_field_types == expected


@pytest.mark.skipif(os.name != "posix", reason="signals are POSIX's")
def test_ctrl_c_caught_during_class_creation_does_not_end_the_process():
    """After a KeyboardInterrupt in ``exec(string)``, CPython ends with -2, whatever the program did
    about it.
    """
    program = """
import os, signal, sys
from turtlewire import msg

def interrupt(frame, event, argument):
    if frame.f_code.co_name == "<module>" and frame.f_back.f_code.co_name == "make_constructor":
        sys.settrace(None)
        os.kill(os.getpid(), signal.SIGINT)

sys.settrace(interrupt)
try:
    msg.get_message("std_msgs/msg/String")
except KeyboardInterrupt:
    print("caught")
"""
    done = run_python(program, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "caught\n", "")
