"""The packages in ``ament_ws`` have tests of their own, which ``colcon test`` runs."""

collect_ignore = ["ament_ws"]
