"""ROS 2's rules and texts for names."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.wire import names

DIGIT = "topic name token must not start with a number"
CHARACTERS = (
    "topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'"
)
BRACES = "topic name must not have unmatched (unbalanced) curly braces '{}'"
INSIDE = "substitution name must not contain characters other than alphanumerics or '_'"


@pytest.mark.parametrize(
    ("name", "message", "index"),
    [
        ("", "topic name must not be empty string", 0),
        ("7foo", DIGIT, 0),
        ("/", "topic name must not end with a forward slash", 0),
        ("/foo/", "topic name must not end with a forward slash", 4),
        ("bad topic", CHARACTERS, 3),
        ("/foo-bar", CHARACTERS, 4),
        ("grün", CHARACTERS, 2),
        ("foo/~", "topic name must not have tilde '~' unless it is the first character", 4),
        (
            "~foo",
            "topic name must not have a tilde '~' that is not followed by a forward slash '/'",
            1,
        ),
        ("foo/7bar", DIGIT, 4),
        ("{foo", BRACES, 0),
        ("foo}", BRACES, 3),
        ("a{b{c}}", INSIDE, 3),
        ("{a/b}", INSIDE, 2),
        ("{a-b}", INSIDE, 2),
        ("{4a}", "substitution name must not start with a number", 1),
    ],
)
def test_topic_names_that_are_refused(name: str, message: str, index: int):
    assert names.validate_topic_name(name) == (message, index)


@pytest.mark.parametrize(
    "name", ["a", "/a", "~", "~/a", "{node}/x", "a/{ns}_b", "_hidden", "/a/_b1/c"]
)
def test_topic_names_that_are_allowed(name: str):
    assert names.validate_topic_name(name) is None


@pytest.mark.parametrize(
    ("name", "message", "index"),
    [
        ("", "topic name must not be empty", 0),
        ("a", "topic name must be absolute, it must lead with a '/'", 0),
        ("/a/", "topic name must not end with a '/'", 2),
        ("/a b", "topic name must not contain characters other than alphanumerics, '_', or '/'", 2),
        ("/a//b", "topic name must not contain repeated '/'", 3),
        ("//b", "topic name must not contain repeated '/'", 1),
        ("/a/4b", "topic name must not have a token that starts with a number", 3),
        ("/" + "a" * 247, "topic length should not exceed '255U - 8U'", 246),
    ],
)
def test_full_topic_names_that_are_refused(name: str, message: str, index: int):
    assert names.validate_full_topic_name(name) == (message, index)


@pytest.mark.parametrize(
    ("name", "message", "index"),
    [
        ("", "namespace must not be empty", 0),
        ("a", "namespace must be absolute, it must lead with a '/'", 0),
        ("/a/", "namespace must not end with a '/', unless only a '/'", 2),
        ("/a b", "namespace must not contain characters other than alphanumerics, '_', or '/'", 2),
        ("/a//b", "namespace must not contain repeated '/'", 3),
        ("/4b", "namespace must not have a token that starts with a number", 1),
        ("/" + "a" * 245, "namespace should not exceed 'RMW_NAMESPACE_MAX_NAME_LENGTH'", 244),
    ],
)
def test_namespaces_that_are_refused(name: str, message: str, index: int):
    assert names.validate_namespace(name) == (message, index)


@pytest.mark.parametrize(
    ("name", "message", "index"),
    [
        ("", "node name must not be empty", 0),
        ("a.b", "node name must not contain characters other than alphanumerics or '_'", 1),
        ("/a", "node name must not contain characters other than alphanumerics or '_'", 0),
        ("4a", "node name must not start with a number", 0),
        ("a" * 256, "node name length should not exceed '255'", 254),
    ],
)
def test_node_names_that_are_refused(name: str, message: str, index: int):
    assert names.validate_node_name(name) == (message, index)


def test_allowed_values():
    assert names.validate_full_topic_name("/turtle1/_pose2") is None
    assert names.validate_namespace("/") is None
    assert names.validate_namespace("/a/b") is None
    assert names.validate_node_name("_turtle1") is None


def test_the_longest_names_are_allowed():
    assert names.validate_full_topic_name("/" + "a" * 246) is None
    assert names.validate_namespace("/" + "a" * 244) is None
    assert names.validate_node_name("a" * 255) is None


@pytest.mark.parametrize(
    ("name", "namespace", "expanded"),
    [
        ("pose", "/", "/pose"),
        ("pose", "/ns", "/ns/pose"),
        ("/pose", "/ns", "/pose"),
        ("~", "/ns", "/ns/node"),
        ("~/pose", "/", "/node/pose"),
        ("~/pose", "/ns", "/ns/node/pose"),
        ("{node}/pose", "/ns", "/ns/node/pose"),
        ("/{node}/pose", "/ns", "/node/pose"),
        ("{ns}/pose", "/ns", "/ns/pose"),
        ("{namespace}/pose", "/ns", "/ns/pose"),
    ],
)
def test_expansion(name: str, namespace: str, expanded: str):
    assert names.expand_topic_name(name, "node", namespace) == expanded


def test_an_unknown_substitution_is_named():
    with pytest.raises(ValueError, match=r"^unknown substitution: \{host\}$"):
        names.expand_topic_name("{host}/pose", "node", "/")


def test_dds_names():
    assert names.topic_to_dds("/turtle1/pose") == "rt/turtle1/pose"
    assert names.request_topic("/ns/spawn") == "rq/ns/spawnRequest"
    assert names.reply_topic("/ns/spawn") == "rr/ns/spawnReply"
    assert names.topic_from_dds("ros_discovery_info") is None
    assert names.service_from_dds("rt/spawnRequest") is None
    assert (
        names.type_to_dds("turtlesim/action/RotateAbsolute_SendGoal_Request")
        == "turtlesim::action::dds_::RotateAbsolute_SendGoal_Request_"
    )
    assert names.type_from_dds("HelloWorld") == "HelloWorld"
    assert names.type_to_dds("HelloWorld") == "HelloWorld"
    assert names.service_type("turtlesim/srv/Spawn_Request") == "turtlesim/srv/Spawn"
    assert names.is_hidden("/rotate/_action/status")
    assert not names.is_hidden("/rosout_agg")


token = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,8}", fullmatch=True)
full_name = st.lists(token, min_size=1, max_size=4).map(lambda tokens: "/" + "/".join(tokens))


@given(full_name, token, token)
def test_names_survive_the_way_to_dds_and_back(name: str, package: str, base: str):
    assert names.validate_full_topic_name(name) is None
    assert names.topic_from_dds(names.topic_to_dds(name)) == name
    assert names.service_from_dds(names.request_topic(name)) == name
    assert names.service_from_dds(names.reply_topic(name)) == name
    assert names.service_of_requests(names.request_topic(name)) == name
    assert names.service_of_requests(names.reply_topic(name)) is None
    type_name = f"{package}/msg/{base}"
    assert names.type_from_dds(names.type_to_dds(type_name)) == type_name


@given(st.text(max_size=20))
def test_a_fault_points_into_the_name(name: str):
    for check in (
        names.validate_topic_name,
        names.validate_full_topic_name,
        names.validate_namespace,
        names.validate_node_name,
    ):
        fault = check(name)
        assert fault is None or 0 <= fault.invalid_index <= max(len(name) - 1, 0)
