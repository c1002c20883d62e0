"""The router of Zenoh; the middleware itself is ``RMW_IMPLEMENTATION=rmw_zenoh_cpp``.

============  ===================================
module        contents
============  ===================================
`rmw_zenohd`  ``ros2 run rmw_zenoh_cpp rmw_zenohd``
============  ===================================
"""
