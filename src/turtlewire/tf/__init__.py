"""The transform buffer, what fills it, and what shows it.

Many classes are called some kind of Buffer. From the inside out:

========================  ======================================================================
``Tree``                  frames, links, samples and tf2's search; no lock. Once in C++
                          (``native/core/tree.hpp``), once in Python (``plain/tree.py``)
``SharedBuffer``          C++: a ``Tree`` behind a lock, with threads that wait for data
``BufferObject``          C++: the Python object around a ``SharedBuffer``
``turtlewire.Buffer``     what programs use: the Python class of ``BufferObject``, or its plain
                          twin ``turtlewire.tf.plain.Buffer``; see :mod:`turtlewire.tf.buffer`
``tf2_py.BufferCore``     ROS 2's lowest interface, with messages; holds a ``turtlewire.Buffer``
``tf2_ros.Buffer``        ROS 2's buffer: a ``BufferCore`` that transforms messages of any type
``tf2_ros.BufferClient``  the same interface (``BufferInterface``) to a buffer in another process
========================  ======================================================================
"""
