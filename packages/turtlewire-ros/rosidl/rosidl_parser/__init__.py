"""Interfaces as objects, as in ROS 2's package of this name.

=============  ===================================================================
module         contents
=============  ===================================================================
`definition`   types of fields, of which ``SLOT_TYPES`` consists; messages, services
`idl_file`     files of interfaces in IDL
`parser`       parses these files
`syntax_tree`  syntax trees of these files
=============  ===================================================================
"""
