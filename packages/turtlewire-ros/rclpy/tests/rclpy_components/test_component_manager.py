"""Nodes that are loaded into a running process."""

import sys
import threading
import types

import pytest

import rclpy
from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy_components import ComponentManager
from rclpy_components.component_manager import _Component
from std_msgs.msg import String

MODULE = "test_components"


class Talker(Node):
    """Says its parameter once; knows nothing of components."""

    def __init__(self):
        super().__init__("talker")
        self.text = self.declare_parameter("text", "nothing").value
        self.said = self.create_publisher(String, "chatter", 1)
        self.helper = Node("helper")  # the request does not apply to a second node
        self.ran = threading.Event()
        self.thread = None
        self.create_timer(0.001, self.on_timer)
        CREATED.append(self)

    def on_timer(self):
        self.thread = threading.current_thread()
        self.ran.set()

    def destroy_node(self):
        self.helper.destroy_node()
        super().destroy_node()


class Fails(Node):
    def __init__(self):
        raise ValueError("no battery")


class Crashes(Talker):
    def on_timer(self):
        super().on_timer()
        raise ValueError("crashed")


CREATED = []


@pytest.fixture
def manager(monkeypatch):
    module = types.ModuleType(MODULE)
    module.Talker, module.Fails, module.Crashes, module.NoNode = Talker, Fails, Crashes, dict
    monkeypatch.setitem(sys.modules, MODULE, module)
    CREATED.clear()
    rclpy.init(args=["x", "--ros-args", "-r", "__node:=container", "-p", "text:=of the container"])
    manager = ComponentManager()
    executor = SingleThreadedExecutor()
    executor.add_node(manager)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    yield manager
    executor.shutdown()
    thread.join()
    manager.destroy_node()
    rclpy.shutdown()


@pytest.fixture
def call(manager):
    node = Node("caller", use_global_arguments=False)
    executor = SingleThreadedExecutor()
    executor.add_node(node)

    def ask(kind, name, **fields):
        client = node.create_client(kind, f"/container/_container/{name}")
        assert client.wait_for_service(60)
        future = client.call_async(kind.Request(**fields))
        executor.spin_until_future_complete(future, 60)
        return future.result()

    yield ask
    executor.shutdown()
    node.destroy_node()


def load(call, name="Talker", **fields):
    return call(
        LoadNode, "load_node", package_name=MODULE, plugin_name=f"{MODULE}.{name}", **fields
    )


def test_a_component_gets_what_the_request_says(call):
    parameters = [Parameter("text", value="5").to_parameter_msg()]
    response = load(
        call,
        node_name="loud",
        node_namespace="/ns",
        remap_rules=["chatter:=talk"],
        parameters=parameters,
        log_level=10,
    )
    assert response.success, response.error_message
    assert response.full_node_name == "/ns/loud"
    (node,) = CREATED
    assert node.text == "5"
    assert node.said.topic_name == "/ns/talk"
    assert node.helper.get_fully_qualified_name() == "/container"
    assert node.get_logger().get_effective_level() == 10


@pytest.mark.parametrize("plugin", [f"{MODULE}::Talker", f"{MODULE}:Talker"])
def test_a_class_has_the_name_of_a_component_of_cpp(call, plugin):
    response = call(LoadNode, "load_node", package_name=MODULE, plugin_name=plugin)
    assert response.full_node_name == "/talker"


@pytest.mark.parametrize(
    ("plugin", "says"),
    [
        ("no_such_module::Talker", "Load a class of nodes in Python: 'package.module.Class'"),
        (f"{MODULE}::Nobody", f"{MODULE} has Talker, Fails"),
    ],
)
def test_the_log_says_what_can_be_loaded(call, capfd, monkeypatch, plugin, says):
    monkeypatch.setattr(sys.modules[MODULE], "__all__", ["Talker", "Fails"], raising=False)
    assert not call(LoadNode, "load_node", package_name=MODULE, plugin_name=plugin).success
    errors = capfd.readouterr().err
    assert says in errors
    assert "Traceback" not in errors


def test_a_component_has_its_own_name_and_defaults(call):
    assert load(call).full_node_name == "/talker"
    assert CREATED[0].text == "nothing"  # the container's arguments are the container's


def test_components_run_in_threads_of_their_own(call):
    load(call, node_name="a")
    load(call, node_name="b")
    assert all(node.ran.wait(60) for node in CREATED)
    assert [node.thread.name for node in CREATED] == ["a", "b"]


def test_one_that_crashes_leaves_the_others(call):
    load(call, "Crashes", node_name="a")
    load(call, node_name="b")
    assert all(node.ran.wait(60) for node in CREATED)
    listed = call(ListNodes, "list_nodes")
    assert listed.full_node_names == ["/a", "/b"]


def test_a_callback_that_fails_because_the_process_ends_is_no_error(capfd):
    context = rclpy.Context()
    context.init(args=[])
    node = Node("late", context=context)
    publisher = node.create_publisher(String, "chatter", 1)

    def on_timer():
        context.try_shutdown()  # as Ctrl-C does in the main thread, in the middle of a callback
        publisher.publish(String())

    node.create_timer(0.001, on_timer)
    component = _Component(node, context)
    component._thread.join(60)
    assert not component._thread.is_alive()
    assert "Traceback" not in capfd.readouterr().err
    node.destroy_node()


def test_unloading(call):
    first, second = load(call, node_name="a"), load(call, node_name="b")
    assert (first.unique_id, second.unique_id) == (1, 2)
    assert call(UnloadNode, "unload_node", unique_id=1).success
    assert list(call(ListNodes, "list_nodes").unique_ids) == [2]
    again = call(UnloadNode, "unload_node", unique_id=1)
    assert (again.success, again.error_message) == (False, "No node found with unique_id: 1")
    assert load(call).unique_id == 3


@pytest.mark.parametrize(
    ("plugin", "message"),
    [
        (f"{MODULE}.Fails", "ValueError: no battery"),
        (f"{MODULE}.Nobody", "AttributeError: module 'test_components' has no attribute 'Nobody'"),
        ("no_such_module.Talker", "ModuleNotFoundError: No module named 'no_such_module'"),
        (
            f"{MODULE}.NoNode",
            "TypeError: 'test_components.NoNode' creates a dict, which is not a node",
        ),
        ("no_such_module::Talker", "Could not find requested resource in ament index"),
        (f"{MODULE}::Nobody", "Failed to find class with the requested plugin name."),
        (f"{MODULE}::Fails", "ValueError: no battery"),
        (
            "Talker",
            f"ValueError: 'Talker' is not a component of {MODULE}; expected 'package.module.Class'",
        ),
    ],
)
def test_unloadable_files(call, plugin, message):
    response = call(LoadNode, "load_node", package_name=MODULE, plugin_name=plugin)
    assert (response.success, response.error_message) == (False, message)
    assert load(call).success


@pytest.mark.parametrize("package", ["std_msg", "", ".", "rclpy.nothing"])
def test_an_unknown_package_is_rejected(call, capfd, package):
    plugin = f"{MODULE}.Talker"
    response = call(LoadNode, "load_node", package_name=package, plugin_name=plugin)
    assert not response.success
    assert response.error_message == "Could not find requested resource in ament index"
    assert CREATED == []
    assert f"Package '{package}' not found. " in capfd.readouterr().err


def test_an_installed_package_is_accepted(call):
    plugin = f"{MODULE}.Talker"
    assert call(LoadNode, "load_node", package_name="turtlesim_msgs", plugin_name=plugin).success


@pytest.mark.parametrize("plugin", ["no::\x1b[2J", "\x1b[2J", "no\x1b[2J.Talker"])
def test_a_request_does_not_steer_the_terminal(call, capfd, plugin):
    assert not call(LoadNode, "load_node", package_name=MODULE, plugin_name=plugin).success
    errors = capfd.readouterr().err
    assert r"\x1b[2J" in errors
    assert "\x1b" not in errors
