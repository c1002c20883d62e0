"""``ros2 interface``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ===========================================
module     what it holds
=========  ===========================================
`api`      interfaces as YAML, completions
`command`  the class of the command ``ros2 interface``
`verb`     the classes of its verbs
=========  ===========================================
"""
