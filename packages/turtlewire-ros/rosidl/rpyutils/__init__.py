"""Loading of compiled libraries, as ROS 2's package of this name.

=====================  ===================================
module                 contents
=====================  ===================================
`add_dll_directories`  folders of libraries on Windows
`import_c_library`     imports a compiled module by a name
=====================  ===================================
"""

from rpyutils.add_dll_directories import add_dll_directories_from_env
from rpyutils.import_c_library import import_c_library

__all__ = ["add_dll_directories_from_env", "import_c_library"]
