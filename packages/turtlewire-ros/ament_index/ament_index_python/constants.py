"""The location of the index."""

#: Name of the environment variable that lists the prefixes of sourced workspaces.
AMENT_PREFIX_PATH_ENV_VAR = "AMENT_PREFIX_PATH"

#: Folder of a prefix that has a folder for each type of resource.
RESOURCE_INDEX_SUBFOLDER = "share/ament_index/resource_index"
