"""Tools for tf2: view_frames draws the tree of frames.

=============  ====================================
module         contents
=============  ====================================
`view_frames`  the executable: listens, then draws
`dot`, `pdf`   the tree as Graphviz text and as PDF
=============  ====================================
"""
