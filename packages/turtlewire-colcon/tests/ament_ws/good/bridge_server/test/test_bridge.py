from bridge_msgs.srv import Topics
from bridge_server.capabilities.topics import topics
from bridge_tools import shorten


def test_topics():
    assert topics(["/b", "/a"]) == Topics.Response(topics=["/a", "/b"])
    assert shorten("/a/b") == "b"
