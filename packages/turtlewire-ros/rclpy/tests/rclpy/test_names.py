"""Name checks and the errors that they raise."""

import re

import pytest

from rclpy import exceptions
from rclpy.expand_topic_name import expand_topic_name
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.validate_parameter_name import validate_parameter_name
from rclpy.validate_topic_name import validate_topic_name


def test_good_names():
    assert validate_node_name("my_node")
    assert validate_namespace("/")
    assert validate_namespace("/my_ns/x2")
    assert validate_topic_name("~/a/{node}")
    assert validate_topic_name("chatter", is_service=True)
    assert validate_full_topic_name("/my_ns/chatter")
    assert validate_parameter_name("a.b")


@pytest.mark.parametrize(
    ("check", "error", "text"),
    [
        (
            lambda: validate_node_name("bad-name"),
            exceptions.InvalidNodeNameException,
            (
                "Invalid node name: node name must not contain characters other than alphanumerics "
                "or '_':\n  'bad-name'\n      ^"
            ),
        ),
        (
            lambda: validate_node_name(""),
            exceptions.InvalidNodeNameException,
            "Invalid node name: node name must not be empty:\n  ''\n   ^",
        ),
        (
            lambda: validate_namespace("ns"),
            exceptions.InvalidNamespaceException,
            "Invalid namespace: namespace must be absolute, it must lead with a '/':\n  'ns'\n   ^",
        ),
        (
            lambda: validate_topic_name("a/"),
            exceptions.InvalidTopicNameException,
            "Invalid topic name: topic name must not end with a forward slash:\n  'a/'\n    ^",
        ),
        (
            lambda: validate_topic_name("a/", is_service=True),
            exceptions.InvalidServiceNameException,
            "Invalid service name: topic name must not end with a forward slash:\n  'a/'\n    ^",
        ),
        (
            lambda: validate_full_topic_name("a"),
            exceptions.InvalidTopicNameException,
            (
                "Invalid topic name: topic name must be absolute, it must lead with a '/':\n  "
                "'a'\n  "
                " ^"
            ),
        ),
        (
            lambda: validate_full_topic_name("a", is_service=True),
            exceptions.InvalidServiceNameException,
            (
                "Invalid service name: topic name must be absolute, it must lead with a '/':\n  "
                "'a'\n   ^"
            ),
        ),
        (
            lambda: validate_parameter_name(""),
            exceptions.InvalidParameterException,
            "Invalid parameter name: ",
        ),
    ],
)
def test_bad_names(check, error, text):
    with pytest.raises(error) as caught:
        check()
    assert str(caught.value) == text


def test_the_parts_of_the_error():
    with pytest.raises(exceptions.NameValidationException) as caught:
        validate_topic_name("a?b")
    error = caught.value
    assert (error.name_type, error.name, error.invalid_index) == ("topic name", "a?b", 1)
    assert error.error_msg.startswith("topic name must not contain characters other than")


@pytest.mark.parametrize(
    ("names", "text"),
    [
        (("a b", "node", "/ns"), "topic name 'a b' is invalid"),
        (("a/{what}", "node", "/ns"), "topic name 'a/{what}' is invalid"),
        (("a", "no de", "/ns"), "node name 'no de' is invalid"),
        (("a", "node", "ns"), "node namespace 'ns' is invalid"),
    ],
)
def test_bad_expansions(names, text):
    with pytest.raises(ValueError, match=f"^{re.escape(text)}: "):
        expand_topic_name(*names)


def test_hidden_names():
    assert topic_or_service_is_hidden("/_secret")
    assert topic_or_service_is_hidden("fibonacci/_action/status")
    assert not topic_or_service_is_hidden("/rosout_")
