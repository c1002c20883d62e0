"""Tools for tf2: view_frames draws the tree of frames."""
