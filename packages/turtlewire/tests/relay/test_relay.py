"""`turtlewire relay` as a separate process, between two networks that this process is in."""

import signal
import threading
from contextlib import contextmanager

import pytest
from tests.needs import needs_cyclone_dds
from tests.places import TURTLEWIRE

from turtlewire import msg
from turtlewire.errors import WireError
from turtlewire.relay.routes import ServiceRoute, TopicRoute
from turtlewire.relay.side import End, Mark, Side, parse_end
from turtlewire.testing import reserved_domain
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.local.bus import bus_of
from turtlewire.wire.qos import Durability, History, Liveliness, QoS, Reliability

pytestmark = needs_cyclone_dds

LONG = 60_000_000_000
CYCLONE, ZENOH = "rmw_cyclonedds_cpp", "rmw_zenoh_cpp"
#: A type that is installed nowhere.
SECRET = TypeId("secret_msgs/msg/Secret", "RIHS01_" + "5e" * 32)
ASK = ServiceTypes(
    "secret_msgs/srv/Ask",
    TypeId("secret_msgs/srv/Ask_Request", "RIHS01_" + "a1" * 32),
    TypeId("secret_msgs/srv/Ask_Response", "RIHS01_" + "a2" * 32),
    lambda _: "RIHS01_" + "a3" * 32,
)
TF = TypeId("tf2_msgs/msg/TFMessage", msg.type_hash("tf2_msgs/msg/TFMessage"))
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)


def cdr(text):
    return b"\x00\x01\x00\x00" + text.encode().ljust(12)


class Network:
    """One end: a node of this process there, and what it receives."""

    def __init__(self, end, name):
        self.end = end
        self.context = open_context(end.domain_id, middleware=end.middleware)
        self.graph = self.context.graph
        self.node = self.context.create_node(name)

    def wait_for(self, predicate):
        assert self.graph.wait_for(predicate, LONG), self.graph.endpoints()

    def subscribe(self, topic, type_id=SECRET, qos=QoS()):  # noqa: B008 - a named tuple
        return Received(self, self.node.create_subscription(topic, type_id, qos))

    def publish(self, topic, type_id=SECRET, qos=QoS()):  # noqa: B008
        """A publisher that has a subscription of the relay."""
        publisher = self.node.create_publisher(topic, type_id, qos)
        self.wait_for(lambda: self.relays(topic, "subscription"))
        # The relay's and those of this network: all must be matched before the first message.
        known = len(self.graph.endpoints_of(topic, "subscription"))
        self.wait_for(lambda: publisher.subscription_count() >= known)
        return publisher

    def relays(self, topic, kind):
        """The endpoints that relays have here."""
        return [
            end
            for end in self.graph.endpoints_of(topic, kind)
            if end.node is not None and end.node.enclave.startswith("/turtlewire_relay/")
        ]

    def answer(self, service, types=ASK):
        """Serve with an echo, on a thread."""
        server = self.node.create_service(service, types, QoS())
        wait_set = self.context.create_wait_set()
        wait_set.attach(server)

        def serve():
            while wait_set.wait():
                for request_id, request in server.take():
                    server.send_response(request_id, request[:4] + request[4:].swapcase())

        threading.Thread(target=serve, daemon=True).start()

    def call(self, service, request, types=ASK):
        """The response to a request."""
        client = self.node.create_client(service, types, QoS())
        self.wait_for(client.is_ready)
        wait_set = self.context.create_wait_set()
        wait_set.attach(client)
        number = client.send_request(request)
        assert wait_set.wait(LONG) == [client]
        ((found, response),) = client.take()
        wait_set.close()
        client.close()
        assert found == number
        return response


class Received:
    """A subscription, and the wait for what comes next."""

    def __init__(self, network, subscription):
        self.subscription = subscription
        self._wait_set = network.context.create_wait_set()
        self._wait_set.attach(subscription)
        self._waiting = []

    def next(self):
        while not self._waiting:
            assert self._wait_set.wait(LONG) == [self.subscription]
            self._waiting += [data for data, _ in self.subscription.take()]
        return self._waiting.pop(0)


@contextmanager
def joined(near, far):
    networks = Network(near, "near"), Network(far, "far")
    yield networks
    for network in networks:
        network.context.close()


@pytest.fixture(params=[CYCLONE, ZENOH])
def networks(request, other_domain):
    """Two networks: the near one on Cyclone DDS."""
    with (
        reserved_domain() as domain,
        joined(End(CYCLONE, domain), End(request.param, other_domain)) as both,
    ):
        yield both


@pytest.fixture
def relay(run):
    """Starts a relay, and waits until it is up."""

    def start(near, far, *words):
        program = run(TURTLEWIRE, "relay", "--from", near.end, "--to", far.end, *words)
        program.wait_for("relay between")
        return program

    return start


def test_unknown_messages_pass_in_both_directions(networks, relay):
    near, far = networks
    relay(near, far)
    for sender, receiver in ((near, far), (far, near)):
        received = receiver.subscribe("/secret")
        publisher = sender.publish("/secret")
        for number in range(100):
            publisher.publish(cdr(f"message {number}"))
            assert received.next()[:16] == cdr(f"message {number}")
        publisher.close()
        received.subscription.close()


def test_unknown_services_are_called_in_both_directions(networks, relay):
    near, far = networks
    relay(near, far)
    near.answer("/near/ask")
    far.answer("/far/ask")
    for number in range(10):
        assert far.call("/near/ask", cdr(f"near {number}"))[:16] == cdr(f"NEAR {number}")
        assert near.call("/far/ask", cdr(f"far {number}"))[:16] == cdr(f"FAR {number}")


def test_publishers_keep_their_qos(networks, relay):
    near, far = networks
    qos = QoS(
        depth=3,
        reliability=Reliability.BEST_EFFORT,
        durability=Durability.TRANSIENT_LOCAL,
        deadline_ns=300_000_000,
        lifespan_ns=5_000_000_000,
        liveliness=Liveliness.AUTOMATIC,
        liveliness_lease_ns=7_000_000_000,
    )
    near.node.create_publisher("/offered", SECRET, qos)
    everything = QoS(history=History.KEEP_ALL)
    near.node.create_publisher("/everything", SECRET, everything)
    relay(near, far)
    for topic, kept in (("/offered", qos), ("/everything", everything)):
        far.wait_for(lambda topic=topic: far.relays(topic, "publisher"))
        (copy,) = far.relays(topic, "publisher")
        assert policies(copy) == policies(near.graph.endpoints_of(topic, "publisher")[0])
        assert (copy.node.name, policies(copy)[:2]) == ("near", (kept.history, kept.reliability))


def policies(endpoint):
    """The QoS; a middleware does not announce the depth that is not used."""
    qos = endpoint.qos
    depth = qos.depth if qos.history == History.KEEP_LAST else 0
    return qos.history, qos.reliability, depth, *qos[3:]


def test_late_subscriptions_get_what_each_publisher_sent_before(networks, relay):
    near, far = networks
    for name in ("one", "two"):
        near.node.create_publisher("/latched", SECRET, LATCHED).publish(cdr(name))
    relay(near, far)
    for _ in range(2):  # the second finds the relay's publishers
        received = far.subscribe("/latched", SECRET, LATCHED._replace(depth=2))
        assert {received.next()[:16], received.next()[:16]} == {cdr("one"), cdr("two")}


def test_nothing_is_received_that_no_one_wants(networks, relay):
    near, far = networks
    publisher = near.node.create_publisher("/secret", SECRET, QoS())
    relay(near, far)
    far.wait_for(lambda: far.relays("/secret", "publisher"))
    assert not near.relays("/secret", "subscription")
    received = far.subscribe("/secret")
    near.wait_for(publisher.is_heard)
    publisher.publish(cdr("wanted"))
    assert received.next()[:16] == cdr("wanted")
    received.subscription.close()
    near.wait_for(lambda: not near.relays("/secret", "subscription"))


def test_endpoints_go_with_those_they_stand_for(networks, relay):
    near, far = networks
    relay(near, far)
    near.answer("/ask")
    publisher = near.node.create_publisher("/secret", SECRET, QoS())
    assert far.call("/ask", cdr("up"))[:16] == cdr("UP")
    far.wait_for(lambda: far.relays("/secret", "publisher"))
    publisher.close()
    far.wait_for(lambda: not far.relays("/secret", "publisher"))
    near.node.close()
    far.wait_for(lambda: "/ask" not in far.graph.service_names_and_types())
    far.wait_for(lambda: "near" not in [node.name for node in far.graph.nodes()])


def test_names_are_in_the_namespace_at_the_far_end(networks, relay):
    near, far = networks
    relay(near, far, "--namespace", "robot1")
    near.answer("/ask")
    assert far.call("/robot1/ask", cdr("up"))[:16] == cdr("UP")
    received = far.subscribe("/robot1/secret")
    near.publish("/secret").publish(cdr("there"))
    assert received.next()[:16] == cdr("there")
    commands = near.subscribe("/command")
    far.publish("/robot1/command").publish(cdr("back"))
    assert commands.next()[:16] == cdr("back")
    assert "/robot1" in [node.namespace for node in far.graph.nodes() if node.name == "near"]
    far.node.create_publisher("/elsewhere", SECRET, QoS())
    far.node.create_publisher("/robot1/marker", SECRET, QoS())
    near.wait_for(lambda: near.relays("/marker", "publisher"))
    assert not near.relays("/elsewhere", "publisher")


def transforms(*frames):
    """The bytes of a message, from pairs of parent and child."""
    message = msg.get_message(TF.name)()
    for parent, child in frames:
        transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
        transform.header.frame_id, transform.child_frame_id = parent, child
        message.transforms.append(transform)
    return msg.serialize(message)


def frames_of(data):
    message = msg.deserialize(msg.get_message(TF.name), data)
    return [(each.header.frame_id, each.child_frame_id) for each in message.transforms]


def test_frames_get_a_prefix_and_lose_it(networks, relay):
    near, far = networks
    relay(near, far, "--namespace", "robot1", "--frame-prefix", "robot1/")
    near.node.create_publisher("/tf_static", TF, LATCHED).publish(transforms(("base", "laser")))
    received = far.subscribe("/tf_static", TF, LATCHED)
    assert frames_of(received.next()) == [("robot1/base", "robot1/laser")]
    received = near.subscribe("/tf", TF)
    publisher = far.publish("/tf", TF)
    publisher.publish(transforms(("world", "robot2/base")))
    publisher.publish(transforms(("world", "robot1/map"), ("robot1/map", "robot1/odom")))
    assert frames_of(received.next()) == [("map", "odom")]


def test_names_that_ros_does_not_allow_end_no_relay(networks, relay):
    """Programs on plain DDS, and nodes on Zenoh, may have any name."""
    near, far = networks
    bare = QoS(avoid_ros_namespace_conventions=True)
    near.node.create_publisher("rt/2words", SECRET, bare)
    near.node.create_subscription("rq/2wordsRequest", ASK.request, bare)
    near.node.create_publisher(f"/{'x' * 240}", SECRET, QoS())  # too long within the namespace
    near.context.create_node("two#words").create_publisher("/odd_owner", SECRET, QoS())
    program = relay(near, far, "--namespace", "/robot1")
    far.wait_for(lambda: far.relays("/robot1/odd_owner", "publisher"))
    received = far.subscribe("/robot1/secret")
    near.publish("/secret").publish(cdr("there"))
    assert received.next()[:16] == cdr("there")
    told = program.text
    for name in ("/2words", "service /2words", "xxx"):
        assert f"{name} is not carried: topic " in told


def test_of_two_relays_one_waits_for_the_end_of_the_other(networks, relay):
    near, far = networks
    first = relay(near, far)
    received = far.subscribe("/secret")
    publisher = near.publish("/secret")
    publisher.publish(cdr("first"))
    assert received.next()[:16] == cdr("first")
    second = relay(far, near)
    second.wait_for("another relay carries the same: this one waits for its end")
    publisher.publish(cdr("once"))
    publisher.publish(cdr("twice"))
    assert [received.next()[:16] for _ in range(2)] == [cdr("once"), cdr("twice")]
    first.process.send_signal(signal.SIGINT)
    assert first.wait() == 0
    second.wait_for("/secret")
    far.wait_for(lambda: far.relays("/secret", "publisher"))
    near.wait_for(publisher.is_heard)
    publisher.publish(cdr("second"))
    assert received.next()[:16] == cdr("second")


def test_relays_of_different_names_do_not_feed_each_other(networks, relay):
    near, far = networks
    relay(near, far)
    relay(near, far, "--namespace", "again")
    plain, again = far.subscribe("/secret"), far.subscribe("/again/secret")
    back = near.subscribe("/secret")
    publisher = near.node.create_publisher("/secret", SECRET, QoS())
    near.wait_for(lambda: len(near.relays("/secret", "subscription")) == 2)
    near.wait_for(lambda: publisher.subscription_count() == 3)
    for text in ("one", "two", "three"):
        publisher.publish(cdr(text))
        for received in (plain, again, back):
            assert received.next()[:16] == cdr(text)
    for topic in ("/secret", "/again/secret"):
        far.wait_for(lambda topic=topic: far.relays(topic, "publisher"))
        assert len(far.graph.endpoints_of(topic, "publisher")) == 1
    assert not near.relays("/secret", "publisher")


def test_both_ends_can_be_one_network(other_domain, relay):
    end = End(CYCLONE, other_domain)
    with joined(end, end) as (near, far):
        relay(near, far, "--namespace", "copy")
        received, copied = near.subscribe("/secret"), near.subscribe("/copy/secret")
        publisher = far.publish("/secret")
        for text in ("one", "two", "three"):
            publisher.publish(cdr(text))
            assert (received.next()[:16], copied.next()[:16]) == (cdr(text), cdr(text))
        near.answer("/ask")
        assert far.call("/copy/ask", cdr("up"))[:16] == cdr("UP")
        topics = near.graph.topic_names_and_types()
        assert not [name for name in topics if name.startswith("/copy/copy")]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleanly(networks, relay, number):
    near, far = networks
    program = relay(near, far)
    near.answer("/ask")
    assert far.call("/ask", cdr("up"))[:16] == cdr("UP")
    program.process.send_signal(number)
    assert program.wait() == 0
    far.wait_for(lambda: not far.graph.service_names_and_types())
    assert "Traceback" not in program.text


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--from", "fastdds:3", "--to", "zenoh:0"], "are reached with cyclonedds:3"),
        (["--from", "cyclone:3", "--to", "zenoh:0"], "'cyclone:3' is not cyclonedds:DOMAIN or"),
        (["--from", "zenoh", "--to", "zenoh:0"], "after the colon, as in zenoh:0"),
        (["--from", "zenoh:233", "--to", "zenoh:0"], "expected a domain from 0 to 232"),
        (["--from", "zenoh:0", "--to", "zenoh:0"], "both ends are zenoh:0: add --namespace NS"),
        (["--from", "zenoh:0", "--to", "zenoh:1", "--namespace", "1a"], "'1a': namespace must not"),
        (["--from", "zenoh:0"], "the following arguments are required: --to"),
    ],
)
def test_wrong_words_are_explained(run, words, told):
    program = run(TURTLEWIRE, "relay", *words)
    assert (program.wait(), told in " ".join(program.text.split())) == (2, True), program.text


def test_a_network_that_cannot_be_joined_is_one_line(run):
    variables = {"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_STRATEGY": "Enforce"}
    words = ("--from", "cyclonedds:0", "--to", "cyclonedds:1")
    program = run(TURTLEWIRE, "relay", *words, environment=variables)
    assert program.wait() == 2
    assert program.text.startswith("turtlewire relay: ")
    assert "Traceback" not in program.text


class HandledByTheTest(Side):
    """An end on the in-process middleware whose handlers the test calls."""

    def __init__(self, domain_id):
        super().__init__(End("local", domain_id), Mark([]))
        self.handlers = []

    def serve(self, entity, handle):
        self.handlers.append(handle)


@pytest.fixture
def sides(other_domain):
    with reserved_domain() as domain:
        both = HandledByTheTest(domain), HandledByTheTest(other_domain)
        yield both
        for side in both:
            side.close()


def test_a_message_that_cannot_be_sent_is_the_only_one_lost(sides, capfd):
    near, far = sides
    publishers = [near.node.create_publisher("/secret", SECRET, QoS()) for _ in range(2)]
    received = far.node.create_subscription("/secret", SECRET, QoS())
    nodes = [far.node_for(name, far.look()) for name in ("/a", "/b")]
    owners = dict(zip((publisher.gid for publisher in publishers), nodes, strict=True))
    route = TopicRoute(near, far, ("/secret", "/secret"), SECRET, None)
    route.update(
        near.graph.endpoints_of("/secret", "publisher"),
        far.graph.endpoints_of("/secret", "subscription"),
        set(),
        lambda publisher: owners[publisher.gid],
    )
    nodes[0].close()
    for publisher in publishers:
        publisher.publish(cdr(f"from {publishers.index(publisher)}"))
    near.handlers[0]()
    assert [data for data, _ in received.take()] == [cdr("from 1")]
    (line,) = capfd.readouterr().err.splitlines()
    assert line.endswith(f"{far.end}: publish on /secret: the publisher is closed")
    route.close()


def test_a_response_that_cannot_be_sent_is_the_only_one_lost(sides, capfd):
    near, far = sides
    server = near.node.create_service("/ask", ASK, QoS())
    client = far.node.create_client("/ask", ASK, QoS())
    route = ServiceRoute(near, far, "/ask", ASK)
    assert route.offer("/ask", far.node)
    sent = [client.send_request(cdr(name)) for name in ("a", "b")]
    carry_responses, carry_requests = near.handlers[0], far.handlers[0]
    carry_requests()
    for request_id, request in server.take():
        server.send_response(request_id, request)
    bus = bus_of(far.end.domain_id)

    def fail_once(_sender, _message):
        bus.tamper = None
        raise WireError("not sent")

    bus.tamper = fail_once
    carry_responses()
    assert client.take() == [(sent[1], cdr("b"))]
    assert capfd.readouterr().err.endswith(f"{far.end}: not sent\n")
    route.close()


def test_ends_have_two_spellings():
    assert parse_end("rmw_cyclonedds_cpp:0") == parse_end("cyclonedds:0") == End(CYCLONE, 0)
    assert str(parse_end("zenoh:232")) == "zenoh:232"
