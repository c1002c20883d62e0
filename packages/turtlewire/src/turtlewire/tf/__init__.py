"""The transform buffer, its listener, and its diagrams.

Several classes are named Buffer. From the inside out:

========================  ======================================================================
``Tree``                  frames, links, samples and tf2's search; no lock. Once in C++
                          (``native/core/tree.hpp``), once in Python (``plain/tree.py``)
``SharedBuffer``          C++: a ``Tree`` behind a lock, with threads that wait for data
``BufferObject``          C++: the Python object around a ``SharedBuffer``
``BaseBuffer``            the Python class of ``BufferObject``, or its plain twin
                          ``turtlewire.tf.plain.Buffer``
``turtlewire.Buffer``     the class for programs: a ``BaseBuffer`` with bags, trajectories and
                          pickling; see :mod:`turtlewire.tf.buffer`
``tf2_py.BufferCore``     ROS 2's lowest interface, with messages; holds a ``turtlewire.Buffer``
``tf2_ros.Buffer``        ROS 2's buffer: a ``BufferCore`` that transforms messages of any type
``tf2_ros.BufferClient``  the same interface (``BufferInterface``) to a buffer in another process
========================  ======================================================================

=========================  =========================================================================
module                     contents
=========================  =========================================================================
`buffer`                   `Buffer`: the chosen core, with bags, trajectories, pickling
`implementation`           chooses the compiled core or its plain twin
`products`                 products of transforms, and interpolation
`archive`                  a buffer as a file
`datetimes`                stamps given as ``datetime64``
`plain`                    the plain-Python twin of the compiled core
`answers`                  results of a buffer that have several parts
`array_arguments`          stamps and points given as arrays
`pose_rows`                poses given as an array of rows or of matrices
`number_errors`            errors for values that are not vectors or quaternions
`listener`                 `TransformListener`: puts the bytes of TF messages into buffers
`channel`                  the subscriptions that buffers share; what stores their messages
`refusal_warnings`         warnings about refused transforms and full buffers
`tf_topics`                the topics of transforms, and their type
`links`                    the links of a buffer with rates and ages; its tree as text
`faults`                   rejected transforms, malformed messages, and conflicts
`restarts`                 detects that a simulation has restarted
`publishers`               names of publishers; frames whose publisher has left the graph
`arrays`                   a transform as an array
`frame_tree`               the frames with statistics of their links, for diagrams
`tree_drawing`, `drawing`  the diagram of the tree; boxes, lines and text on a page
`svg`                      elements of SVG documents
`pdf`                      a PDF file of one page
`notebook`                 the display of buffers and transforms in Jupyter, as tables
=========================  =========================================================================
"""
