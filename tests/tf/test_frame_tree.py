from __future__ import annotations

import pytest

from turtlewire.tf.frame_tree import FrameTree, Link, read_frame_tree

IDENTITY = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


def tree_of(*pairs):
    return FrameTree(Link(child, parent, "", 1.0, 2.0, 1.0, 1.0) for parent, child in pairs)


def test_figures_of_a_buffer(buffer):
    for second in (1, 2, 3):
        buffer.set_transform("map", "base", second * 10**9, *IDENTITY, authority="robot")
    buffer.set_transform("base", "laser", 0, *IDENTITY, static=True, authority="urdf")
    tree = read_frame_tree(buffer)
    assert tree.links["base"] == Link("base", "map", "robot", 1.5, 3.0, 1.0, 2.0)
    assert tree.links["laser"].is_static
    assert not tree.links["base"].is_static
    assert (tree.roots, tree.loops) == (["map"], [])
    assert tree.children == {"map": ["base"], "base": ["laser"], "laser": []}


def test_an_empty_buffer(buffer):
    tree = read_frame_tree(buffer)
    assert (tree.links, tree.roots, tree.children, tree.loops) == ({}, [], {}, [])


@pytest.mark.parametrize("name", ["a: b", "it's", "- x", "a\nb", "{}", "日本", "'", "null"])
def test_names_that_yaml_would_not_take(buffer, name):
    buffer.set_transform("map", name, 10**9, *IDENTITY)
    buffer.set_transform(name, "next", 10**9, *IDENTITY)
    assert list(read_frame_tree(buffer).children) == ["map", name, "next"]


def test_a_loop_is_cut_before_its_first_frame():
    tree = tree_of(("c", "a"), ("a", "b"), ("b", "c"), ("b", "leaf"), ("world", "robot"))
    assert tree.loops == [["a", "c", "b"]]
    assert tree.roots == ["world", "a"]
    assert tree.children["a"] == ["b"]
    assert tree.children["c"] == []
    assert tree.children["b"] == ["c", "leaf"]


def test_several_loops_and_what_hangs_on_them():
    tree = tree_of(("x", "hanger"), ("y", "x"), ("x", "y"), ("q", "p"), ("p", "q"))
    assert [set(loop) for loop in tree.loops] == [{"x", "y"}, {"p", "q"}]
    reached, waiting = set(), list(tree.roots)
    while waiting:
        frame = waiting.pop()
        assert frame not in reached
        reached.add(frame)
        waiting.extend(tree.children[frame])
    assert reached == {"hanger", "x", "y", "p", "q"}
