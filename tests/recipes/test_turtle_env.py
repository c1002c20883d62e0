"""examples/gym_turtlesim keeps Gymnasium's rules, and its episodes can be repeated."""

from __future__ import annotations

import math

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from tests.places import EXAMPLES

NAME = "turtle_env:TurtleGoal-v0"


@pytest.fixture
def make(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES / "gym_turtlesim"))
    environments = []

    def start():
        environments.append(gymnasium.make(NAME))
        return environments[-1]

    yield start
    for environment in environments:
        environment.close()


def episode(environment, seed):
    """Drive at random, and return all observations and rewards."""
    observation, _ = environment.reset(seed=seed)
    environment.action_space.seed(seed)
    found = [(*observation.tolist(), 0.0)]
    ended = False
    while not ended:
        action = environment.action_space.sample()
        observation, reward, reached, too_long, _ = environment.step(action)
        found.append((*observation.tolist(), reward))
        ended = reached or too_long
    return found


def test_the_environment_passes_gymnasiums_checks(make):
    check_env(make().unwrapped)  # warnings are errors


def test_the_same_seed_gives_the_same_episode(make):
    one, other = make(), make()
    first = episode(one, 7)
    assert episode(other, 7) == first
    assert episode(one, 7) == first  # also after another episode
    assert episode(one, 8) != first


def test_an_episode_ends_at_the_goal(make):
    environment = make()
    (ahead, left), _ = environment.reset(seed=1)
    distance, reached, too_long = math.hypot(ahead, left), False, False
    while not reached and not too_long:
        turn = np.clip(math.atan2(left, ahead), -1.0, 1.0)
        (ahead, left), reward, reached, too_long, _ = environment.step([1.0, turn])
        distance -= reward + 0.01  # the cost of a step
    assert reached
    assert math.hypot(ahead, left) < 0.5
    assert distance == pytest.approx(math.hypot(ahead, left), abs=1e-5)


def test_a_turtle_that_stands_still_ends_after_300_steps(make):
    environment = make()
    start, _ = environment.reset(seed=1)
    for step in range(1, 301):
        observation, reward, reached, too_long, _ = environment.step([0.0, 0.0])
        assert np.array_equal(observation, start)
        assert (reward, reached, too_long) == (-0.01, False, step == 300)


def test_actions_out_of_range_are_limited(make):
    one, other = make().unwrapped, make().unwrapped
    one.reset(seed=3)
    other.reset(seed=3)
    assert np.array_equal(one.step([5.0, -9.0])[0], other.step([1.0, -1.0])[0])


def test_several_environments_run_side_by_side(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES / "gym_turtlesim"))
    environments = gymnasium.make_vec(NAME, num_envs=4)
    observations, _ = environments.reset(seed=1)
    assert observations.shape == (4, 2)
    assert len({tuple(each) for each in observations.tolist()}) == 4
    environments.close()
