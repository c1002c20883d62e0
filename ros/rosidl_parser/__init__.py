"""The types of interface fields, as ROS 2's package of this name.

============  =================================================
module        what it holds
============  =================================================
`definition`  types of fields, of which ``SLOT_TYPES`` consists
============  =================================================
"""
