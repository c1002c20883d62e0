"""Compares installed packages with the surface of a real ROS 2 Jazzy.

    python tests/surface/compare.py rclpy tf2 …    # names of tests/golden/surface.json

prints each difference and `N of M equal`. A call that is written for ROS 2 must work here: the
parameters have ROS 2's names, places and defaults. Further optional parameters, annotations and
further names do not count.
"""

from __future__ import annotations

import json
import re
import sys
from dataclasses import asdict, dataclass, field
from pathlib import Path

from capture import surface

GOLDEN = Path(__file__).parents[1] / "golden" / "surface.json"


@dataclass
class Comparison:
    """The numbers of compared names and members, and the differences.

    `differences` maps a dotted name to what differs and the number of entries which that spoils:
    a class that is absent lacks its members, too.
    """

    total: int = 0
    differences: dict[str, tuple[str, int]] = field(default_factory=dict)

    @property
    def equal(self):
        return self.total - sum(weight for _, weight in self.differences.values())

    def compare(self, name, real, here):
        """Compares what two modules hold under a name; `here` is None if there is nothing."""
        members = real.get("members", {})
        self.total += 1 + len(members)
        if here is None:
            self.differences[name] = ("absent", 1 + len(members))
            return
        if "same as" in real:
            return
        if not same_kind(real, here):
            ours = here.get("signature") or here["kind"]
            self.differences[name] = (f"{real.get('signature')} is {ours}", 1)
        for member, there in members.items():
            ours = here.get("members", {}).get(member)
            if ours is None:
                self.differences[f"{name}.{member}"] = ("absent", 1)
            elif not same_member(there, ours):
                self.differences[f"{name}.{member}"] = (f"{there} is {ours}", 1)


def compare(golden):
    """Compares all packages of one name."""
    real = json.loads(GOLDEN.read_text(encoding="utf-8"))[golden]
    here = {}
    for package in sorted({module.partition(".")[0] for module in real}):
        here.update(surface(package))
    result = Comparison()
    for module, names in real.items():
        for name, entry in names.items():
            ours = here.get(module, {}).get(name)
            if ours and "same as" in ours:
                home, _, own_name = ours["same as"].rpartition(".")
                ours = here.get(home, {}).get(own_name) or {"kind": f"an alias of {home}"}
            result.compare(f"{module}.{name}", entry, ours)
    return result


def same_kind(real, here):
    wanted = real.get("signature")
    if not fits(wanted, here.get("signature")):
        return False
    return here["kind"] == real["kind"] or real["kind"] not in ("class", "function", "value")


def same_member(real, here):
    if "(" in real and "(" in here and real.partition("(")[0] == here.partition("(")[0]:
        return fits(real, here)
    unknown = real in ("other", "None") or real.endswith("None")
    both_properties = real.startswith("property") and here.startswith("property")
    return unknown or both_properties or masked(real) == masked(here)


def fits(real, here):
    """Return True if a call for the one signature also works with the other."""
    if real is None or real.endswith("None") or masked(real) == masked(here):
        return True
    if here is None or "(" not in here or real.startswith("async") != here.startswith("async"):
        return False
    theirs, ours = parameters(real), parameters(here)
    order, our_order = positional(theirs), positional(ours)
    if any(name.startswith("**") for name, _ in ours) and len(our_order) <= len(order):
        return True
    if our_order[: len(order)] != order:
        return False
    wanted, given = dict(theirs), dict(ours)
    return all(
        name in given and (not default or given[name] == default)
        for name, default in wanted.items()
        if is_name(name)
    ) and all(default or not is_name(name) or name in wanted for name, default in ours)


def is_name(parameter):
    return parameter != "/" and not parameter.startswith("*")


def positional(listed):
    """Names of the parameters before the first that begins with a star."""
    found = []
    for name, _ in listed:
        if name.startswith("*"):
            break
        if name != "/":
            found.append(name)
    return found


def parameters(text):
    """Pairs of name and default, the default empty if there is none."""
    inner = masked(text)
    found, depth, now = [], 0, ""
    for character in inner[inner.index("(") + 1 : inner.rindex(")")] + ",":
        depth += (character in "([{") - (character in ")]}")
        if character == "," and not depth:
            name, _, default = now.strip().partition("=")
            found.append((name, default))
            now = ""
        else:
            now += character
    return [each for each in found if each[0]]


def masked(text):
    """Return the `repr` of a default without addresses and other process-specific parts."""
    return re.sub(r"<[^>]*>|(?<=argv=)\[.*\]", "<…>", text or "")


def main(words):
    if words[:1] == ["--json"]:
        print(json.dumps(asdict(compare(words[1]))))
        return
    for golden in words:
        result = compare(golden)
        for name, (difference, _) in result.differences.items():
            print(f"{name}: {difference}")
        print(f"{golden}: {result.equal} of {result.total} equal")


if __name__ == "__main__":
    main(sys.argv[1:])
