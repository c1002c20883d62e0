"""``ros2 param``, for programs and extensions; :mod:`ros2cli` does the work.

=========  =======================================
module     what it holds
=========  =======================================
`api`      parameters of other nodes, completions
`command`  the class of the command ``ros2 param``
`verb`     the classes of its verbs
=========  =======================================
"""
