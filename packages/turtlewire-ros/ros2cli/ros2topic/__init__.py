"""The command ``ros2 topic``, and its functions for programs and extensions.

=========  ==================================================
module     contents
=========  ==================================================
`api`      topics and their message classes, QoS, completions
`command`  the command ``ros2 topic``
`several`  several topics for ``hz`` and ``bw``
`verb`     its verbs
=========  ==================================================
"""
