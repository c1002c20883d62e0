"""The command ``ros2 multicast``, and its functions for programs and extensions.

=========  ==============================
module     what it holds
=========  ==============================
`api`      datagrams to and from a group
`command`  the command ``ros2 multicast``
`verb`     its verbs
=========  ==============================
"""
