# Installs the component `dev` of `build` alone, for the project components/.
cmake_minimum_required(VERSION 3.18)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${prefix})
run(out ${CMAKE_COMMAND} --install ${build} --prefix ${prefix} --component dev)
file(GLOB programs ${prefix}/bin/*)
if(programs)
  message(FATAL_ERROR "the component dev has programs: ${programs}")
endif()
