"""``ros2 service``, for programs and extensions; :mod:`ros2cli` does the work.

=========  =========================================
module     what it holds
=========  =========================================
`api`      services and their classes, completions
`command`  the class of the command ``ros2 service``
`verb`     the classes of its verbs
=========  =========================================
"""
