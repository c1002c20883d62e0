"""The ``turtlewire`` command: inspects and checks transforms, bags and networks without ROS.

====================  ========================================================================
module                contents
====================  ========================================================================
`start`               starts the command; handles Ctrl-C during the imports
`main`                the command and its verbs
`frames`              the verb ``frames``: ages, rates and publishers; the keys that scroll it
`frame_picture`       a snapshot of that tree, as text and as JSON
`bag_commands`        the parsers of ``bag``, ``trajectory`` and ``compare``
`bag_edit_parsers`    the parsers of ``bag info``, ``cut``, ``filter``, ``merge`` and ``split``
`bag_edits`           ``bag info``, ``cut``, ``filter``, ``merge`` and ``split``
`bag_tf`              ``bag tf``: the tree of a bag with rates and gaps
`bag_findings`        faults of a bag and of its transforms
`trajectory_command`  the verb ``trajectory``
`compare_command`     the verb ``compare``
`relay_command`       the verb ``relay``
`mcp_command`         the verb ``mcp``
`assistant`           the tools of ``mcp``, a package of its own
`trajectory_sources`  trajectories of bags and files, for these verbs
====================  ========================================================================
"""
