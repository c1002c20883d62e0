"""What interfaces consist of, as ROS 2's package of this name.

============  ===================================================================
module        what it holds
============  ===================================================================
`definition`  types of fields, of which ``SLOT_TYPES`` consists; messages, services
`idl_file`    files of interfaces in IDL
`parser`      reads them
============  ===================================================================
"""
