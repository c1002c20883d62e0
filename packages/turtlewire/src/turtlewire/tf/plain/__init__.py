"""The buffer in plain Python, for machines without a compiler, and for reading.

It gives the same answers as the compiled core, whose files have the same names.

=====================  ==================================================
module                 contents
=====================  ==================================================
`link`                 the history of a link
`tree`                 the tree of frames, and tf2's search in it
`rules`                how the releases of tf2 differ
`shared_tree`          the tree with a lock, waiting and listeners
`buffer`               the public class
`additions`            its methods that add transforms
`batch`                its methods that take and return arrays
`inspection`           its methods that show, remove and load samples
`checks`               checked arguments, arrays too
`transform`            the result of a lookup
`failure`              the errors of lookups, in tf2's words
`status`               the outcomes of a lookup
`refusals`             refused transforms, counted by frame
`report`               tf2's texts about the whole tree
`tf_message`           decodes ``tf2_msgs/msg/TFMessage``
`record_walk`          the chunks of a bag
`fork`                 keeps the locks of buffers usable after ``fork()``
=====================  ==================================================
"""

from turtlewire.tf.plain.buffer import Buffer
from turtlewire.tf.plain.record_walk import RecordWalk
from turtlewire.tf.plain.transform import Transform

__all__ = ["Buffer", "RecordWalk", "Transform"]
