"""The command ``ros2 multicast``, and its functions for programs and extensions.

=========  ==============================
module     contents
=========  ==============================
`api`      datagrams to and from a group
`command`  the command ``ros2 multicast``
`verb`     its verbs
=========  ==============================
"""
