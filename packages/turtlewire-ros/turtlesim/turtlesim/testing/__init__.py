"""Tests of nodes that drive turtles: simulator and nodes in one process, in lock-step.

::

    with Simulation() as simulation:
        simulation.spawn("turtle2", x=4.0, y=2.0)
        simulation.add(MyFollower())
        simulation.drive("turtle1", linear=2.0, angular=1.0)
        assert simulation.run_until(lambda: simulation.distance("turtle1", "turtle2") < 0.5,
        within=10.0)

For pytest, ``pytest_plugins = ["turtlesim.testing.fixtures"]`` in ``conftest.py`` gives a fixture
``simulation``.

============  ===================================================================
module        contents
============  ===================================================================
`simulation`  the simulator and the nodes of a test, in lock-step
`stage`       nodes of one process, in lock-step
`programs`    runs the ``main`` of a node's file up to where it spins
`faults`      delay, loss, wrong frames and times …, to practise on
`fixtures`    the fixture for pytest
============  ===================================================================
"""

from turtlesim.testing.simulation import Simulation

__all__ = ["Simulation"]
