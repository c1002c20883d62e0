# macro_tool_expand(<output variable> <name>): called by packages that find this one
function(macro_tool_expand output name)
  cmake_parse_arguments(ARG "UPPER" "SUFFIX" "" ${ARGN})
  set(text "${name}")
  if(ARG_UPPER)
    string(TOUPPER "${text}" text)
  endif()
  set(${output} "${text}${ARG_SUFFIX}" PARENT_SCOPE)
endfunction()
