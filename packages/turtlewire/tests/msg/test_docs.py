"""The examples of docs/interfaces.md, run."""

import doctest
import re
import subprocess
import sys

from tests.places import ROOT

from turtlewire.msg import registry

PAGE = ROOT / "docs" / "interfaces.md"
FILES = {
    "package.xml": "<package format='3'><name>my_interfaces</name></package>",
    "msg/Sphere.msg": "geometry_msgs/Point center\nfloat64 radius 1.0\n",
    "srv/Grow.srv": "Sphere sphere\nfloat64 by\n---\nSphere sphere\n",
}


def test_the_examples_of_the_page_do_what_it_says(tmp_path, monkeypatch):
    monkeypatch.setattr(registry, "_registered", {})
    for name, text in FILES.items():
        path = tmp_path / "my_interfaces" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        for line in text.splitlines() if name != "package.xml" else ():
            assert line in PAGE.read_text()
    (command,) = re.findall(r"```sh\n(.*)\n```", PAGE.read_text())
    assert command.startswith("python ")
    subprocess.run(
        [sys.executable, *command.split()[1:]], cwd=tmp_path, check=True, capture_output=True
    )
    monkeypatch.syspath_prepend(str(tmp_path / "generated"))
    failed, tried = doctest.testfile(str(PAGE), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert failed == 0
    assert tried == 22


def test_the_page_names_every_package():
    page = PAGE.read_text()
    for package in registry.interfaces():
        assert f"`{package}`" in page or package == "my_interfaces"
