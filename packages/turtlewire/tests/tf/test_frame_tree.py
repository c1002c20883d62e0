from __future__ import annotations

import pytest
import yaml

from turtlewire.tf.frame_tree import FrameLink, FrameTree, read_frame_tree

IDENTITY = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


def tree_of(*pairs):
    return FrameTree(
        FrameLink(child, parent, "", False, 1.0, 2.0, 1.0, 1.0) for parent, child in pairs
    )


def test_figures_of_a_buffer(buffer):
    for second in (1, 2, 3):
        buffer.set_transform("map", "base", second * 10**9, *IDENTITY, sender="robot")
    buffer.set_static_transform("base", "laser", *IDENTITY, sender="urdf")
    tree = read_frame_tree(buffer)
    assert tree.links["base"] == FrameLink("base", "map", "robot", False, 1.5, 3.0, 1.0, 2.0)
    assert tree.links["laser"] == FrameLink("laser", "base", "urdf", True, 10_000.0, 0.0, 0.0, 0.0)
    assert (tree.roots, tree.loops) == (["map"], [])
    assert tree.children == {"map": ["base"], "base": ["laser"], "laser": []}


def test_an_empty_buffer(buffer):
    tree = read_frame_tree(buffer)
    assert (tree.links, tree.roots, tree.children, tree.loops) == ({}, [], {}, [])


def test_figures_are_those_of_tf2s_yaml(buffer):
    buffer.set_transform("map", "base", 10**9, *IDENTITY, sender="robot")
    buffer.set_transform("map", "base", 3 * 10**9, *IDENTITY, sender="another")
    buffer.set_static_transform("base", "laser", *IDENTITY)
    described = yaml.safe_load(buffer.to_yaml())
    links = read_frame_tree(buffer).links
    assert described.keys() == links.keys()
    for child, link in links.items():
        assert described[child] == {
            "parent": link.parent,
            "broadcaster": link.broadcaster,
            "rate": link.rate_hz,
            "most_recent_transform": link.newest,
            "oldest_transform": link.oldest,
            "buffer_length": link.length,
        }


def test_links_whose_samples_are_forgotten_are_left_out(buffer):
    buffer.set_transform("map", "base", 10**9, *IDENTITY)
    buffer.set_static_transform("map", "fixed", *IDENTITY)
    buffer.clear()
    assert list(read_frame_tree(buffer).links) == ["fixed"]


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
