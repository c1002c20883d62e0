"""``ros2 multicast``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ===========================================
module     what it holds
=========  ===========================================
`api`      datagrams to and from a group
`command`  the class of the command ``ros2 multicast``
`verb`     the classes of its verbs
=========  ===========================================
"""
