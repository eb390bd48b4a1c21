# Installs `build` afresh into `prefix`, and fails when the package files hold what they must not.
cmake_minimum_required(VERSION 3.18)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${prefix})
run(out ${CMAKE_COMMAND} --install ${build} --prefix ${prefix})

file(GLOB_RECURSE package_files ${prefix}/*ceres_ed*.cmake ${prefix}/*ceres_ed.pc)
if(NOT package_files)
  message(FATAL_ERROR "no package files in ${prefix}")
endif()
foreach(file IN LISTS package_files)
  expect_no_paths(${file} ${source} ${build} nlohmann)
endforeach()
