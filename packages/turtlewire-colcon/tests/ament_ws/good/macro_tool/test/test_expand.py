import os

from macro_tool import expand


def test_expand():
    assert os.path.basename(os.getcwd()) == "test"
    assert expand("Hello $NAME", "you" + os.environ["MACRO_SUFFIX"]) == "Hello you!"
