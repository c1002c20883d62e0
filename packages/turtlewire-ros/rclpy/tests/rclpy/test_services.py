"""Clients and services, on both middlewares."""

import math

import pytest

from example_interfaces.srv import AddTwoInts
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.exceptions import InvalidServiceNameException
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile, qos_profile_services_default
from std_msgs.msg import Int32
from std_srvs.srv import SetBool
from turtlewire.wire.base import RequestId

pytestmark = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])


def add(request, response):
    response.sum = request.a + request.b
    return response


def ask(executor, client, a, b):
    future = client.call_async(AddTwoInts.Request(a=a, b=b))
    executor.spin_until_future_complete(future, timeout_sec=60)
    assert future.done()
    return future.result().sum


def test_request_and_response(node, executor):
    service = node.create_service(AddTwoInts, "add", add)
    client = node.create_client(AddTwoInts, "add")
    assert client.wait_for_service(timeout_sec=60)
    assert client.service_is_ready()
    assert ask(executor, client, 2, 3) == 5
    assert (service.service_name, client.service_name) == ("/add", "/add")
    assert (service.srv_name, client.srv_name) == ("add", "add")
    assert (service.srv_type, client.srv_type) == (AddTwoInts, AddTwoInts)
    assert service.qos_profile == client.qos_profile == qos_profile_services_default
    assert service.logger_name == client.logger_name == "tested"
    assert service in list(node.services)
    assert client in list(node.clients)


def test_responses_find_their_requests(node, executor, context):
    node.create_service(AddTwoInts, "add", add)
    clients = [node.create_client(AddTwoInts, "add") for _ in range(2)]
    for client in clients:
        assert client.wait_for_service(timeout_sec=60)
    futures = [
        (number, clients[number % 2].call_async(AddTwoInts.Request(a=number, b=100)))
        for number in range(8)
    ]
    for number, future in futures:
        executor.spin_until_future_complete(future, timeout_sec=60)
        assert future.result().sum == number + 100
    assert [client._pending for client in clients] == [{}, {}]


def test_wait_for_service_ends_when_the_service_comes_or_the_time_is_over(
    later, node, executor, context
):
    client = node.create_client(AddTwoInts, "add")
    assert not client.service_is_ready()
    assert not client.wait_for_service(timeout_sec=0)
    assert not client.wait_for_service(timeout_sec=0.05)
    assert not client.wait_for_service(timeout_sec=-0.5)  # what is left after a deadline
    later(node.create_service, AddTwoInts, "add", add)
    assert client.wait_for_service(timeout_sec=math.inf)
    assert client.wait_for_service(timeout_sec=-0.5)
    assert ask(executor, client, 1, 1) == 2


def test_wait_for_service_raises_on_an_invalid_context(later, node, context):
    """Else the loop of the tutorial's client would go on forever after SIGTERM."""
    client = node.create_client(AddTwoInts, "add")
    text = "^failed to check service availability: rcl node's context is invalid$"
    later(context.shutdown)
    with pytest.raises(RCLError, match=text):
        client.wait_for_service()
    with pytest.raises(RCLError, match=text):
        client.wait_for_service(timeout_sec=1.0)
    with pytest.raises(RCLError, match=text):
        client.service_is_ready()


def test_done_callbacks_of_a_response_run_on_the_executor(node, executor, spin_until):
    node.create_service(AddTwoInts, "add", add)
    client = node.create_client(AddTwoInts, "add")
    assert client.wait_for_service(timeout_sec=60)
    sums = []
    client.call_async(AddTwoInts.Request(a=1, b=2)).add_done_callback(
        lambda future: sums.append(future.result().sum)
    )
    spin_until(lambda: sums)
    assert sums == [3]


def test_blocking_call_from_another_thread(node, executor, spinning):
    node.create_service(AddTwoInts, "add", add)
    client = node.create_client(AddTwoInts, "add")
    spinning(executor)
    assert client.wait_for_service(timeout_sec=60)
    assert client.call(AddTwoInts.Request(a=3, b=4)).sum == 7
    nobody = node.create_client(AddTwoInts, "nobody")
    assert nobody.call(AddTwoInts.Request(), timeout_sec=0.05) is None


def test_a_shutdown_ends_a_blocking_call(later, context, node):
    client = node.create_client(AddTwoInts, "nobody")
    later(context.shutdown)
    with pytest.raises(ExternalShutdownException):
        client.call(AddTwoInts.Request())


def test_a_cancelled_request_is_forgotten(node):
    client = node.create_client(AddTwoInts, "nobody")
    future = client.call_async(AddTwoInts.Request())
    future.cancel()
    assert client._pending == {}


def test_wrong_types(node, executor):
    client = node.create_client(AddTwoInts, "add")
    for wrong in (SetBool.Request(), AddTwoInts.Response(), None):
        with pytest.raises(TypeError):
            client.call_async(wrong)
    with pytest.raises(AttributeError, match=r"This might be a ROS 1 message type"):
        node.create_client(int, "add")
    with pytest.raises(RuntimeError, match="The service type provided is not valid"):
        node.create_service(Int32, "add", add)
    service = node.create_service(AddTwoInts, "add", lambda request, response: None)
    with pytest.raises(TypeError):
        service.send_response(AddTwoInts.Request(), RequestId(1, 1))
    assert client.wait_for_service(timeout_sec=60)
    client.call_async(AddTwoInts.Request())
    with pytest.raises(TypeError):
        executor.spin_once(timeout_sec=60)


def test_service_exception_leaves_spin_without_an_answer(node, executor):
    node.create_service(AddTwoInts, "add", lambda request, response: 1 / 0)
    client = node.create_client(AddTwoInts, "add")
    assert client.wait_for_service(timeout_sec=60)
    future = client.call_async(AddTwoInts.Request())
    with pytest.raises(ZeroDivisionError):
        executor.spin_until_future_complete(future, timeout_sec=60)
    executor.spin_once(timeout_sec=0.05)
    assert not future.done()


@pytest.mark.parametrize("name", ["", "9lives", "a//b", "a/", "with space", "~x"])
def test_names_are_checked(node, name):
    with pytest.raises(InvalidServiceNameException, match=r"^Invalid service name: "):
        node.create_client(AddTwoInts, name)
    with pytest.raises(InvalidServiceNameException):
        node.create_service(AddTwoInts, name, add)


def test_quality_of_service_and_destruction(node):
    profile = QoSProfile(depth=3)
    client = node.create_client(AddTwoInts, "add", qos_profile=profile)
    assert client.qos_profile == profile
    assert node.destroy_client(client)
    assert not node.destroy_client(client)
    for use in (
        client.service_is_ready,
        lambda: client.call_async(AddTwoInts.Request()),
        lambda: client.service_name,
    ):
        with pytest.raises(
            InvalidHandle, match="cannot use Destroyable because destruction was requested"
        ):
            use()


def test_a_malformed_request_is_told_once_and_the_service_lives(node, executor, capfd):
    node.create_service(AddTwoInts, "add", add)
    client = node.create_client(AddTwoInts, "add")
    assert client.wait_for_service(timeout_sec=60)
    for _ in range(3):
        client._wire.send_request(b"\x00\x01\x00\x00\x01")
    assert ask(executor, client, 1, 2) == 3
    assert capfd.readouterr().err.count("Ignoring a malformed request to service '/add'") == 1


def test_a_pending_request_has_its_future(node, executor):
    node.create_service(AddTwoInts, "add", add)
    client = node.create_client(AddTwoInts, "add")
    assert client.wait_for_service(timeout_sec=60)
    future = client.call_async(AddTwoInts.Request())
    (number,) = client._pending
    assert client.get_pending_request(number) is future
    executor.spin_until_future_complete(future, timeout_sec=60)
    with pytest.raises(KeyError):
        client.get_pending_request(number)
