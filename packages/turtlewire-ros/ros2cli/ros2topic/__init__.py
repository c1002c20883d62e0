"""``ros2 topic``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ==================================================
module     what it holds
=========  ==================================================
`api`      topics and their message classes, QoS, completions
`command`  the class of the command ``ros2 topic``
`verb`     the classes of its verbs
=========  ==================================================
"""
