"""``ros2 node``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ======================================
module     what it holds
=========  ======================================
`api`      nodes and what they have, completions
`command`  the class of the command ``ros2 node``
`verb`     the classes of its verbs
=========  ======================================
"""
