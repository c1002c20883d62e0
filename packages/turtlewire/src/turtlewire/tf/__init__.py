"""The transform buffer, what fills it, and what shows it.

Many classes are called some kind of Buffer. From the inside out:

========================  ======================================================================
``Tree``                  frames, links, samples and tf2's search; no lock. Once in C++
                          (``native/core/tree.hpp``), once in Python (``plain/tree.py``)
``SharedBuffer``          C++: a ``Tree`` behind a lock, with threads that wait for data
``BufferObject``          C++: the Python object around a ``SharedBuffer``
``BaseBuffer``            the Python class of ``BufferObject``, or its plain twin
                          ``turtlewire.tf.plain.Buffer``
``turtlewire.Buffer``     what programs use: a ``BaseBuffer`` that knows bags, trajectories and
                          pickling; see :mod:`turtlewire.tf.buffer`
``tf2_py.BufferCore``     ROS 2's lowest interface, with messages; holds a ``turtlewire.Buffer``
``tf2_ros.Buffer``        ROS 2's buffer: a ``BufferCore`` that transforms messages of any type
``tf2_ros.BufferClient``  the same interface (``BufferInterface``) to a buffer in another process
========================  ======================================================================

=========================  =========================================================================
module                     what it holds
=========================  =========================================================================
`buffer`                   `Buffer`: the chosen core, with bags, trajectories, pickling
`implementation`           chooses the compiled core or its plain twin
`products`                 products of transforms, and interpolation
`archive`                  a buffer as a file
`file_names`               refuses names of files that promise another format
`datetimes`                stamps given as ``datetime64``
`plain`                    the plain-Python twin of the compiled core
`answers`                  answers of a buffer that have several parts
`array_arguments`          stamps and points given as arrays
`pose_rows`                poses given as an array of rows or of matrices
`number_errors`            errors for vectors and quaternions of another kind
`text_tree`                the tree as text
`listener`                 `TransformListener`: puts the bytes of TF messages into buffers
`full_buffers`             warnings of buffers that take no more frames
`tf_topics`                the topics of transforms, and their type
`publisher_names`          the node that published a message
`links`                    the links of a buffer with rates and ages
`faults`                   refused transforms, malformed messages, and conflicts of senders
`restarts`                 notices that a simulation has started again
`arrays`                   a transform as an array
`frame_tree`               the frames with the figures of their links, for pictures
`tidy_tree`                positions of the nodes of a drawn tree
`tree_drawing`, `drawing`  the picture of the tree; boxes, lines and text on a page
`svg`                      elements of SVG documents
`pdf`                      a PDF file of one page
`notebook`                 how buffers and transforms show themselves in Jupyter
=========================  =========================================================================
"""
