"""Callback groups alone; test_executors.py checks that executors respect them."""

import gc

import pytest

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup


class Something:
    pass


def test_a_mutually_exclusive_group_admits_one():
    group = MutuallyExclusiveCallbackGroup()
    first, second = Something(), Something()
    group.add_entity(first)
    group.add_entity(second)
    assert group.can_execute(first)
    assert group.beginning_execution(first)
    assert not group.can_execute(second)
    assert not group.beginning_execution(second)
    assert not group.beginning_execution(first)
    with pytest.raises(RuntimeError, match="does not hold"):
        group.ending_execution(second)
    group.ending_execution(first)
    assert group.beginning_execution(second)


def test_a_reentrant_group_admits_all():
    group = ReentrantCallbackGroup()
    entity = Something()
    group.add_entity(entity)
    assert group.beginning_execution(entity)
    assert group.can_execute(entity)
    assert group.beginning_execution(entity)
    group.ending_execution(entity)


def test_members_are_held_weakly():
    group = ReentrantCallbackGroup()
    entity = Something()
    assert not group.has_entity(entity)
    group.add_entity(entity)
    assert group.has_entity(entity)
    del entity
    gc.collect()
    assert group.entities == set()


def test_a_node_has_a_mutually_exclusive_default_group(node):
    group = ReentrantCallbackGroup()
    timer = node.create_timer(1.0, None, callback_group=group)
    other = node.create_timer(1.0, None)
    assert timer.callback_group is group
    assert group.has_entity(timer)
    assert other.callback_group is node.default_callback_group
    assert isinstance(node.default_callback_group, MutuallyExclusiveCallbackGroup)
