"""Pages, displays and topics that come and go leave nothing behind."""

import gc
import json
import threading

from websockets.sync.client import connect

from turtlewire import msg
from turtlewire.wire.qos import QoS
from turtlewire_view import session
from turtlewire_view.display_feed import DisplayFeed

from .fake_view import decode_packet

ROUNDS = 20
PATH = "nav_msgs/msg/Path"
IMAGE, OFFERED = "sensor_msgs/msg/Image", 60


def living(kind):
    gc.collect()
    return sum(issubclass(type(each), kind) for each in gc.get_objects())


def path_bytes():
    message = msg.get_message(PATH)()
    message.header.frame_id = "map"
    pose = msg.get_message("geometry_msgs/msg/PoseStamped")()
    message.poses = [pose] * 50
    return msg.serialize(message)


def test_pages_displays_and_topics_that_come_and_go(robot, viewer, open_view_page):
    robot.send("map", "base", (1, 0, 0), 1_800_000_000)
    watcher = open_view_page(viewer)
    watcher.wait_for("frames")
    sessions, threads = living(session.ViewSession), threading.active_count()
    cdr = path_bytes()
    for number in range(ROUNDS):
        topic = f"/path_{number}"
        publisher = robot.publisher(topic, PATH, QoS())
        page = open_view_page(viewer)
        page.wait_for("topics", lambda p, name=topic: name in (t["name"] for t in p["topics"]))
        page.send("add", id="a", kind="path", topic=topic, options={})
        assert robot.wait_for(publisher.is_heard)
        publisher.publish(cdr)
        page.wait_for("display", lambda p: p["id"] == "a")
        if number % 2:
            page.send("remove", id="a")
        page.close()
        assert robot.wait_for(lambda end=publisher: not end.subscription_count())
        publisher.close()
    # The server may still be about to forget the last page.
    left = threading.Event()
    for _ in range(600):
        if living(DisplayFeed) == 0 and living(session.ViewSession) == sessions:
            break
        left.wait(0.1)
    assert living(DisplayFeed) == 0
    assert living(session.ViewSession) == sessions
    assert threading.active_count() <= threads
    watcher.wait_for("topics", lambda p: not any("path_" in t["name"] for t in p["topics"]))


def test_a_page_that_stops_reading_holds_up_nobody(robot, viewer, open_view_page):
    """It is offered far more than any buffer holds, and sees the newest when it reads again."""
    image = msg.get_message(IMAGE)(width=800, height=600, encoding="rgb8", step=2400)
    image.header.frame_id, image.data = "map", bytes(800 * 600 * 3)
    cdr = msg.serialize(image)
    publisher = robot.publisher("/image", IMAGE, QoS())
    watcher = open_view_page(viewer)
    watcher.wait_for("topics", lambda p: "/image" in (t["name"] for t in p["topics"]))
    add = {"type": "add", "id": "a", "kind": "image", "topic": "/image", "options": {}}
    address = f"{viewer.url.replace('http', 'ws', 1)}live"
    with connect(address, max_size=None, max_queue=1) as slow:
        slow.send(json.dumps(add))
        assert robot.wait_for(publisher.is_heard)
        for number in range(OFFERED):
            robot.send("map", "base", (number, 0, 0), 1_800_000_000 + number)
            publisher.publish(cdr)
            watcher.wait_for_places({"map": (0, 0, 0), "base": (number, 0, 0)})
        pictures, place = 0, None
        while place != OFFERED - 1:
            packet = decode_packet(slow.recv(timeout=60))
            pictures += packet["type"] == "display"
            if packet["type"] == "frames" and len(packet["arrays"]["poses"]) == 2:
                place = packet["arrays"]["poses"][1][0]
    assert 0 < pictures < OFFERED / 2


def test_topics_that_tools_have_published_on_do_not_add_up(robot, viewer):
    point = "geometry_msgs/msg/PointStamped"
    cdr = msg.serialize(msg.get_message(point)())
    for number in range(3 * ROUNDS):
        viewer.source.publish(f"/point_{number % (2 * ROUNDS)}", point, cdr)
    last = 3 * ROUNDS % (2 * ROUNDS) - 1
    graph = viewer.source._context.graph
    topics = [end.topic for end in graph.endpoints() if end.topic.startswith("/point_")]
    assert len(topics) <= ROUNDS
    assert f"/point_{last}" in topics
