"""``ros2 component``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ===========================================
module     what it holds
=========  ===========================================
`api`      components, and those in containers
`command`  the class of the command ``ros2 component``
`verb`     the classes of its verbs
=========  ===========================================
"""
