"""urdfdom's programs: check_urdf reads a robot description, urdf_to_graphviz draws its tree.

================================  ==========================================
module                            contents
================================  ==========================================
`check_urdf`, `urdf_to_graphviz`  the executables
================================  ==========================================
"""
