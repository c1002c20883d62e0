"""Tools for tf2: view_frames draws the tree of frames.

=============  ==========================================================
module         contents
=============  ==========================================================
`view_frames`  the executable: listens, then draws, also as Graphviz text
`pdf`          a drawing as PDF
=============  ==========================================================
"""
