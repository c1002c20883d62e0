# macro_tool_expand(<output variable> <name>): called by packages that find this one
function(macro_tool_expand output name)
  cmake_parse_arguments(ARG "UPPER" "SUFFIX" "" ${ARGN})
  set(text "${name}")
  if(ARG_UPPER)
    string(TOUPPER "${text}" text)
  endif()
  set(${output} "${text}${ARG_SUFFIX}" PARENT_SCOPE)
endfunction()

# macro_tool_add_file(<text> <output>): runs the program when the package is built
function(macro_tool_add_file text output)
  set(path "${CMAKE_CURRENT_BINARY_DIR}/${output}")
  execute_process(COMMAND ${CMAKE_COMMAND} -E make_directory "${CMAKE_CURRENT_BINARY_DIR}")
  add_custom_command(OUTPUT ${path}
    COMMAND ${CMAKE_COMMAND} -E env GREETED=yes macro_tool "${text}" "${PROJECT_NAME}" > ${path}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    COMMENT "expanding ${output}")
  add_custom_target(${PROJECT_NAME}_${output} ALL DEPENDS ${path})
  install(FILES ${path} DESTINATION share/${PROJECT_NAME})
endfunction()
