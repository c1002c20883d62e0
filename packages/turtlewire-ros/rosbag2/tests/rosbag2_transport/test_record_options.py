"""Every option of `ros2 bag record`: topics, messages, splitting, compression, storage."""

import argparse
import dataclasses
import re
from datetime import timedelta

import pytest
from tests.needs import needs_cyclone_dds

from builtin_interfaces.msg import Time
from rclpy.qos import QoSProfile, ReliabilityPolicy
from ros2bag.verb import record
from ros2cli.arguments import add_arguments
from rosbag2_interfaces import srv
from rosbag2_py import RecordOptions, StorageOptions
from rosbag2_transport.topic_filter import TopicFilter
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from turtlewire.bag import open_bag

from .conftest import DEEP, end

BEST_EFFORT = ReliabilityPolicy.BEST_EFFORT
STRING, EVENT = "std_msgs/msg/String", "example_interfaces/srv/AddTwoInts_Event"
TOPICS = {
    "/a": STRING,
    "/ab": STRING,
    "/number": "std_msgs/msg/Int32",
    "/_hidden": STRING,
    "/unpublished": STRING,
    "/leaf": STRING,
    "/add/_service_event": EVENT,
    "/sub/_service_event": EVENT,
}


def parsed(words):
    """The arguments of the verb."""
    parser = argparse.ArgumentParser()
    add_arguments(parser, record.ARGUMENTS)
    return parser.parse_args(words.split())


def changed(options):
    """The attributes that differ from the defaults."""
    default = type(options)(uri="") if isinstance(options, StorageOptions) else type(options)()
    return {
        field.name: value
        for field in dataclasses.fields(options)
        if (value := getattr(options, field.name)) != getattr(default, field.name)
    }


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("-a", {"all_topics": True, "all_services": True}),
        ("--all-topics", {"all_topics": True}),
        ("--all-services", {"all_services": True}),
        ("--topics /a b", {"topics": ["/a", "/b"]}),
        ("--services /add sub", {"services": ["/add/_service_event", "/sub/_service_event"]}),
        ("--actions /fib count", {"actions": ["/fib", "/count"]}),
        ("--all-actions", {"all_actions": True}),
        ("-e x --exclude-actions fib", {"regex": "x", "exclude_actions": ["/fib"]}),
        (f"--static-topics-path {__file__}", {"static_topics_uri": __file__}),
        ("--topic-types a/msg/B", {"topic_types": ["a/msg/B"]}),
        ("-e x", {"regex": "x"}),
        ("-e x --exclude-regex y", {"regex": "x", "exclude_regex": "y"}),
        ("-e x --exclude-topics a", {"regex": "x", "exclude_topics": ["/a"]}),
        ("-e x --exclude-topic-types a/msg/B", {"regex": "x", "exclude_topic_types": ["a/msg/B"]}),
        (
            "-e x --exclude-services /add",
            {"regex": "x", "exclude_service_events": ["/add/_service_event"]},
        ),
        ("-e x --include-unpublished-topics", {"regex": "x", "include_unpublished_topics": True}),
        ("-e x --include-hidden-topics", {"regex": "x", "include_hidden_topics": True}),
        ("-e x --no-discovery", {"regex": "x", "is_discovery_disabled": True}),
        ("-e x -p 7", {"regex": "x", "topic_polling_interval": timedelta(milliseconds=7)}),
        ("-e x --ignore-leaf-topics", {"regex": "x", "ignore_leaf_topics": True}),
        ("-e x -f cdr", {"regex": "x", "rmw_serialization_format": "cdr"}),
        ("-e x --disable-keyboard-controls", {"regex": "x", "disable_keyboard_controls": True}),
        ("-e x --start-paused", {"regex": "x", "start_paused": True}),
        ("-e x --use-sim-time", {"regex": "x", "use_sim_time": True}),
        ("-e x --compression-queue-size 9", {"regex": "x", "compression_queue_size": 9}),
        ("-e x --compression-threads 3", {"regex": "x", "compression_threads": 3}),
        (
            "-e x --compression-threads-priority -1",
            {"regex": "x", "compression_threads_priority": -1},
        ),
        (
            "-e x --compression-mode file --compression-format zstd",
            {"regex": "x", "compression_mode": "file", "compression_format": "zstd"},
        ),
    ],
)
def test_words_become_options_of_the_recording(words, expected):
    options = record._record_options(parsed(words))
    found = changed(options)
    if "compression_mode" not in expected:
        assert found.pop("compression_mode") == "none"
    assert found == expected


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("-o b", {"uri": "b"}),
        ("-o b -s sqlite3", {"uri": "b", "storage_id": "sqlite3"}),
        ("-o b -b 5000", {"uri": "b", "max_bagfile_size": 5000}),
        ("-o b -d 5", {"uri": "b", "max_bagfile_duration": 5}),
        ("-o b --max-cache-size 5", {"uri": "b", "max_cache_size": 5}),
        ("-o b --max-cache-duration 5", {"uri": "b", "max_cache_duration": 5}),
        ("-o b -d 5 --max-bag-files 3", {"max_bagfile_duration": 5, "max_bag_files": 3}),
        ("-o b --snapshot-mode", {"uri": "b", "snapshot_mode": True}),
        ("-o b --custom-data k=v w=x=y", {"uri": "b", "custom_data": {"k": "v", "w": "x=y"}}),
        ("-o b --storage-preset-profile resilient", {"storage_preset_profile": "resilient"}),
    ],
)
def test_words_become_options_of_the_storage(words, expected):
    found = changed(record._storage_options(parsed(words)))
    defaults = {
        "uri": "b",
        "storage_id": "mcap",
        "max_cache_size": 100 << 20,
        "storage_preset_profile": "none",
    }
    assert found == defaults | expected


@pytest.mark.parametrize(
    ("words", "error", "warning"),
    [
        ("", "Need to specify at least one option out of --all, --all-topics, --all-services", ""),
        ("-a --topics /a", None, "--all or --all-topics will override --topics"),
        ("-a --topic-types a/msg/B", None, "--all or --all-topics will override --topic-types"),
        ("-a --services /a", None, "--all or --all-services will override --services"),
        ("-a -e x", None, "--all, --all-topics or --all-services will override --regex"),
        ("-a -o {folder}", "Output folder '{folder}' already exists.", ""),
        (
            "-a --use-sim-time --no-discovery",
            "--use-sim-time and --no-discovery both set, but are incompatible settings. The /clock",
            "",
        ),
        (
            "-a --compression-format zstd",
            "Invalid choice: Cannot specify compression format without a compression mode.",
            "",
        ),
        ("--services /a --exclude-regex x", "--exclude-regex argument requires either --all", ""),
        ("-a --max-bag-files 2", "--max-bag-files argument requires either --max-bag-size", ""),
        ("-a --max-bag-files 2 -d 1", None, ""),
        ("--services /a --exclude-services x", "--exclude-services argument requires", ""),
        ("--topics /a --exclude-topic-types x", "--exclude-topic-types argument requires", ""),
    ],
)
def test_words_that_do_not_fit_together(words, error, warning, tmp_path, capsys):
    args = parsed(words.format(folder=tmp_path))
    found = record.validate_parsed_arguments(args, args.output)
    told = f"[ERROR] [ros2bag]: {error}".format(folder=tmp_path)
    assert found is None if error is None else found.startswith(told)
    assert capsys.readouterr().out == (f"[WARN] [ros2bag]: {warning}\n" if warning else "")


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"all_topics": True}, "/a /ab /number /leaf"),
        ({"all_topics": True, "include_hidden_topics": True}, "/a /ab /number /leaf /_hidden"),
        (
            {"all_topics": True, "include_unpublished_topics": True},
            "/a /ab /number /leaf /unpublished",
        ),
        ({"all_topics": True, "ignore_leaf_topics": True}, "/a /ab /number"),
        ({"all_topics": True, "exclude_topics": ["/a"]}, "/ab /number /leaf"),
        ({"all_topics": True, "exclude_topic_types": [STRING]}, "/number"),
        ({"all_topics": True, "exclude_regex": "a"}, "/number"),
        ({"topics": ["/a", "/nope"]}, "/a"),
        ({"topic_types": ["std_msgs/msg/Int32"]}, "/number"),
        ({"regex": "b"}, "/ab /number /sub"),  # found anywhere in the name
        ({"regex": "^/a", "exclude_regex": "dd"}, "/a /ab"),
        ({"all_services": True}, "/add /sub"),
        ({"services": ["/add/_service_event"]}, "/add"),
        ({"all_services": True, "exclude_service_events": ["/add/_service_event"]}, "/sub"),
        ({"all_topics": True, "all_services": True}, "/a /ab /number /leaf /add /sub"),
    ],
)
def test_choice(options, expected):
    told = []
    chosen = TopicFilter(RecordOptions(**options), lambda *words: told.append(words))
    taken = {
        topic.removesuffix("/_service_event")
        for topic, type_name in TOPICS.items()
        for _ in range(2)
        if chosen.takes(
            topic, [type_name], published=topic != "/unpublished", heard=topic != "/leaf"
        )
    }
    assert taken == set(expected.split())
    assert len(told) == len(set(told))  # each once, although asked twice


def test_it_tells_once_what_it_waits_for(peer, bag_verb):
    from example_interfaces.srv import AddTwoInts

    peer.publisher("/chatter")
    peer.publisher("/_hidden")
    peer.listen("/only_heard")
    peer.node.create_service(AddTwoInts, "/add", lambda _request, response: response)
    recorder = bag_verb(
        *("record", "-o", "out", "--disable-keyboard-controls", "-e", "xyz"),
        *("--topics", "/chater", "/only_heard", "/_hidden"),
        *("--services", "/add", "/ad", "--topic-types", "std_msgs/msg/Sting"),
    )
    recorder.wait_for("No topic or service matches 'xyz' yet")
    peer.publisher("/later")
    for text in (
        "Topic '/chater' has no publisher; it is recorded from its first publisher on",
        "Did you mean: /chatter",
        "Topic '/only_heard' has no publisher; it is recorded from its first publisher on.",
        "Topic '/_hidden' is hidden: give --include-hidden-topics to record it.",
        "Service '/add' publishes no events: switch its introspection on",
        "There is no service '/ad' yet. Did you mean: /add",
        "No topic has the type 'std_msgs/msg/Sting' yet. Did you mean: std_msgs/msg/String",
    ):
        recorder.wait_for(text.replace(".", r"\."))
        assert recorder.text.count(text) == 1
    publisher = peer.publisher("/chater")  # there it is
    recorder.wait_for("Subscribed to topic '/chater'")
    peer.heard(publisher)
    assert end(recorder) == 0
    assert recorder.text.count("'/chater' has no publisher") == 1


@needs_cyclone_dds  # on Zenoh, all QoS fit
def test_simulated_time_splits_compression_and_overrides(peer, bag_verb, tmp_path):
    (tmp_path / "qos.yaml").write_text(
        "/word: {reliability: reliable, history: keep_last, depth: 30}\n"
        "/lossy: {reliability: reliable, depth: 3}\n"
    )
    word, clock = peer.publisher("/word"), peer.node.create_publisher(Clock, "/clock", DEEP)
    lossy = peer.publisher("/lossy", QoSProfile(depth=1, reliability=BEST_EFFORT))
    recorder = bag_verb(
        *("record", "-o", "out", "--topics", "/word", "/lossy", "--use-sim-time", "-d", "10"),
        *("--compression-mode", "file", "--compression-format", "zstd", "--node-name", "black_box"),
        *("--custom-data", "place=lab", "--qos-profile-overrides-path", "qos.yaml"),
        *("--disable-keyboard-controls", "--max-cache-size", "0", "--log-level", "info"),
    )
    recorder.wait_for(r"\[black_box\]: use_sim_time set, waiting for /clock")
    recorder.wait_for("The QoS override for '/lossy' does not match a publisher")
    recorder.wait_for("All requested topics are subscribed")
    peer.heard(word)
    peer.heard(clock)
    word.publish(String(data="before the clock runs"))
    assert word.wait_for_all_acked()
    for _ in range(20):  # a busy machine needs several attempts
        peer.call(srv.IsPaused, "/black_box/is_paused")
    seconds = [100, 105, 111, 122]
    for second in seconds:
        for _ in range(3):
            clock.publish(Clock(clock=Time(sec=second)))
            # Answered by the thread that takes the clock's messages.
            peer.call(srv.IsPaused, "/black_box/is_paused")
        word.publish(String(data=f"at {second}"))
        assert word.wait_for_all_acked()
        peer.call(srv.IsPaused, "/black_box/is_paused")
    recorder.wait_for("Sim time /clock found, starting recording")
    assert lossy.get_subscription_count() == 0
    assert end(recorder) == 0
    assert recorder.text.count("Compressing file: ") == 3
    with open_bag(tmp_path / "out") as bag:
        assert bag.metadata.paths == [f"out_{number}.mcap.zstd" for number in range(3)]
        assert bag.metadata.custom_data == {"place": "lab"}
        # A file begins with the message that is too late for the one before.
        assert [file.message_count for file in bag.metadata.files] == [2, 1, 1]
        found = [(m.decode().data, m.log_time_ns // 10**9) for m in bag.messages("/word")]
    assert found == [(f"at {second}", second) for second in seconds]


@pytest.mark.parametrize(
    ("option", "told"),
    [
        ("--topics", "'/bad name' cannot be the name of a topic: topic name must not contain"),
        ("--services", "'/bad name' cannot be the name of a service: service name must not"),
    ],
)
def test_a_name_that_cannot_be_is_refused(bag_verb, tmp_path, option, told):
    recorder = bag_verb("record", "-o", "out", "--disable-keyboard-controls", option, "/bad name")
    recorder.wait_for(told)
    assert recorder.wait() == 1
    assert not (tmp_path / "out").exists()


def test_each_file_is_told_when_it_is_compressed_also_at_the_end(bag_verb, tmp_path, peer):
    word = peer.publisher("/word")
    recorder = bag_verb(
        *("record", "-o", "out", "--topics", "/word", "--disable-keyboard-controls"),
        *("--max-bag-size", "2000", "--compression-mode", "file", "--compression-format", "zstd"),
    )
    recorder.wait_for("All requested topics are subscribed")
    peer.heard(word)
    for _ in range(40):
        word.publish(String(data="x" * 1000))
    assert word.wait_for_all_acked()
    assert end(recorder) == 0
    with open_bag(tmp_path / "out") as bag:
        files = [path.removesuffix(".zstd") for path in bag.metadata.paths]
    told = re.findall(r"Compressing file: .*/(out_\d+\.mcap)\s", recorder.text + "\n")
    assert told == files
