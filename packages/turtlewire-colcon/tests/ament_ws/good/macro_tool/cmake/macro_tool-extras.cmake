include("${macro_tool_DIR}/macro_tool_expand.cmake")
