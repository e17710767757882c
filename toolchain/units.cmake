# Builds from nothing spend most of their time on the headers of others. Where nobody edits and builds again, several
# sources of a room are therefore compiled as one unit.
option(GRASPD_UNITS "Compile several sources of a room at once" OFF)

# Compiles the sources of `target`, given to it with whole paths, in units.
function(compile_in_units target)
  if(NOT GRASPD_UNITS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(TRANSFORM sources REPLACE "^${CMAKE_SOURCE_DIR}/" "")
  execute_process(COMMAND awk -v largest=12 -f ${CMAKE_SOURCE_DIR}/toolchain/units.awk ${sources}
                  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" lines "${lines}")
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+) (.+)$")
      set(source ${CMAKE_SOURCE_DIR}/${CMAKE_MATCH_2})
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${CMAKE_MATCH_1})
      set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
