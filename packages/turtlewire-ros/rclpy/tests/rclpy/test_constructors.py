"""Endpoints and timers that a program constructs itself, as the nodes of ROS 2 do.

Each program runs in a process of a distribution, because the order of the arguments changed.
"""

import asyncio

import pytest
from tests.programs import OUTCOME, lines_in

from rclpy.context import Context
from rclpy.experimental import AsyncNode
from rclpy.experimental.async_client import AsyncClient
from rclpy.experimental.async_publisher import AsyncPublisher
from rclpy.experimental.async_service import AsyncService
from rclpy.experimental.async_subscription import AsyncSubscription
from rclpy.experimental.async_timer import AsyncTimer
from rclpy.impl.implementation_singleton import package, rclpy_implementation
from rclpy.qos import QoSProfile
from std_msgs.msg import String
from std_srvs.srv import SetBool

from .asyncio_nodes import run

DISTROS = ("jazzy", "kilted", "lyrical")

START = """
import rclpy
from rclpy.client import Client
from rclpy.clock import Clock
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Timer
from std_msgs.msg import String
from std_srvs.srv import SetBool

rclpy.init(args=["program"])
node = rclpy.create_node("node")
group = node.default_callback_group
qos = QoSProfile(depth=3)

def run(entity):
    callback, arguments = entity._take()
    return callback(*arguments)
"""


def said(distro, program):
    return lines_in(distro, OUTCOME + START + program)


@pytest.mark.parametrize("distro", DISTROS)
def test_a_service_and_a_client(distro):
    order = {
        "jazzy": "answer, group, qos",
        "kilted": "answer, group, qos",
        "lyrical": "answer, qos, callback_group=group",
    }[distro]
    program = f"""
def answer(request, response):
    response.message = f"got {{request.data}}"
    return response

with node.handle:
    service_impl = _rclpy.Service(node.handle, SetBool, "switch", qos.get_c_qos_profile())
    client_impl = _rclpy.Client(node.handle, SetBool, "switch", qos.get_c_qos_profile())
service = Service(service_impl, SetBool, "switch", {order}, on_destroy=lambda _: print("gone"))
client = Client(node.context, client_impl, SetBool, "switch", qos, callback_group=group)
print(service.service_name, group.has_entity(service), group.has_entity(client))
print(client.wait_for_service(60))
future = client.call_async(SetBool.Request(data=True))
run(service)
run(client)
print(future.result().message)
service.destroy()
"""
    assert said(distro, program) == ["/switch True True", "True", "got True", "gone"]


@pytest.mark.parametrize("distro", DISTROS)
def test_a_publisher_and_a_subscription(distro):
    order = {
        "jazzy": "heard.append, group, qos, False, events",
        "kilted": "heard.append, group, qos, False, events",
        "lyrical": "heard.append, qos, False, callback_group=group, event_callbacks=events",
    }[distro]
    program = f"""
heard = []
events = SubscriptionEventCallbacks(matched=print)
with node.handle:
    subscription_impl = _rclpy.Subscription(node.handle, String, "t", qos.get_c_qos_profile())
    publisher_impl = _rclpy.Publisher(node.handle, String, "t", qos.get_c_qos_profile())
subscription = Subscription(
    subscription_impl, String, "t", {order}, on_destroy=lambda _: print("gone")
)
publisher = Publisher(publisher_impl, String, "t", qos, SubscriptionEventCallbacks(), group)
publisher.publish(String(data="hello"))
run(subscription)
print(subscription.topic_name, heard[0].data, group.has_entity(subscription))
print(len(subscription.event_handlers))
subscription.destroy()
print(outcome(lambda: subscription.handle))
"""
    (first, handlers, gone, after) = said(distro, program)
    assert first == "/t hello True"
    # By default, a handler also warns of incompatible policies.
    assert int(handlers) >= 2
    assert (gone, after.partition(":")[0]) == ("gone", "InvalidHandle")


@pytest.mark.parametrize("distro", DISTROS)
def test_a_timer(distro):
    order = {
        "jazzy": "tick, group, 0, Clock()",
        "kilted": "tick, group, 0, Clock()",
        "lyrical": "tick, 0, Clock(), callback_group=group",
    }[distro]
    program = f"""
ticks = []
tick = lambda: ticks.append(1)
timer = Timer({order}, autostart=False, on_destroy=lambda _: print("gone"))
print(timer.is_canceled(), group.has_entity(timer))
timer.reset()
run(timer)
print(ticks)
timer.destroy()
"""
    assert said(distro, program) == ["True True", "[1]", "gone"]


@pytest.mark.parametrize(
    ("distro", "parameter"),
    [("jazzy", "cancel_request"), ("kilted", "cancel_request"), ("lyrical", "goal_handle")],
)
def test_the_default_of_a_cancel_callback(distro, parameter):
    program = f"""
from rclpy.action.server import default_cancel_callback
print(default_cancel_callback({parameter}=None).name)
"""
    assert said(distro, program) == ["REJECT"]


def test_structures_of_the_c_library():
    from rclpy.duration import Duration

    assert package == "rclpy"
    assert Duration(seconds=1, nanoseconds=5).get_c_duration().nanoseconds == 1_000_000_005
    assert isinstance(Duration().get_c_duration(), rclpy_implementation.rcl_duration_t)
    profile = QoSProfile(depth=3, deadline=Duration(seconds=2))
    made = profile.get_c_qos_profile()
    profile.depth = 4
    assert made.to_dict()["depth"] == 3
    assert QoSProfile(**made.to_dict()) == QoSProfile(depth=3, deadline=Duration(seconds=2))


def test_a_goal_handle_adds_its_goal_to_the_server(node):
    from action_msgs.msg import GoalInfo
    from example_interfaces.action import Fibonacci
    from rclpy.action.server import ActionServer, ServerGoalHandle

    with_server = ActionServer(node, Fibonacci, "f", lambda goal: Fibonacci.Result())
    info = GoalInfo()
    info.goal_id.uuid[0] = 7
    handle = ServerGoalHandle(with_server, info, Fibonacci.Goal(order=3))
    assert (handle.request.order, handle.goal_id, handle.status) == (3, info.goal_id, 1)
    handle.executing()
    handle.succeed()
    assert not handle.is_active
    handle.destroy()
    with_server.destroy()


def test_endpoints_of_asyncio_in_a_task_group(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    from rclpy.experimental._async_entity import TaskGroup

    gone = []

    async def main(context):
        node = AsyncNode("node", context=context)
        qos = QoSProfile(depth=3)
        handle, c_qos = node.handle, qos.get_c_qos_profile()
        heard, ticks = asyncio.Queue(), asyncio.Queue()

        async def answer(request, response):
            response.success = request.data
            return response

        async with TaskGroup() as group:
            impl = rclpy_implementation.Subscription(handle, String, "t", c_qos)
            subscription = AsyncSubscription(
                impl, String, "t", heard.put, qos, gone.append, False, False, group
            )
            impl = rclpy_implementation.Publisher(handle, String, "t", c_qos)
            publisher = AsyncPublisher(impl, String, "t", qos, gone.append)
            publisher.publish(String(data="hello"))
            assert (await heard.get()).data == "hello"

            impl = rclpy_implementation.Service(handle, SetBool, "s", c_qos)
            service = AsyncService(impl, SetBool, "s", answer, qos, gone.append, tg=group)
            impl = rclpy_implementation.Client(handle, SetBool, "s", c_qos)
            client = AsyncClient(context, impl, SetBool, "s", qos, gone.append, group)
            await client.wait_for_service()
            assert (await client.call(SetBool.Request(data=True))).success

            timer = AsyncTimer(
                1_000_000, node.get_clock(), context, lambda: ticks.put(1), True, gone.append, group
            )
            await ticks.get()
            made = [subscription, publisher, service, client, timer]
            for each in made:
                each.destroy()
        assert gone == made
        node.destroy_node()

    with Context() as context:
        run(main(context))
