# Builds the library as a shared one, with the programs, in the folder `build`, as Debian has it (multiarch
# folders), and installs it into `prefix`.
cmake_minimum_required(VERSION 3.18)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
run(out ${CMAKE_COMMAND} -S ${source} -B ${build} -G ${generator} -C ${options}
    -DCMAKE_BUILD_TYPE=${build_type} -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_SHARED_LIBS=ON
    -DCERES_ED_BUILD_TESTS=OFF -DCERES_ED_BUILD_BENCHMARKS=OFF -DCERES_ED_BUILD_APPS=ON
    -DCERES_ED_BUILD_PYTHON=${python} -DCERES_ED_BUILD_PCL=${pcl}
    -DCERES_ED_BUILD_VTK=${vtk} -DCERES_ED_BUILD_GLTF=${gltf}
    -DCERES_ED_PYTHON_DIR=lib/python3/dist-packages)
run(out ${CMAKE_COMMAND} --build ${build} --parallel ${jobs})
include(${CMAKE_CURRENT_LIST_DIR}/install_and_check.cmake)

# The programs run from where they are, and load the library that came with them.
run(out ${prefix}/bin/ed_fit --version)
file(GLOB_RECURSE libraries ${prefix}/lib/*libceres_ed.so.*)
if(NOT libraries)
  message(FATAL_ERROR "no libceres_ed.so.* in ${prefix}")
endif()
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${prefix}/bin/ed_fit RESOLVED_DEPENDENCIES_VAR loaded
     UNRESOLVED_DEPENDENCIES_VAR missing)
list(FILTER loaded INCLUDE REGEX "libceres_ed")
string(FIND "${loaded}" "${prefix}/" position)
if(NOT position EQUAL 0)
  message(FATAL_ERROR "ed_fit loads '${loaded}', expected libceres_ed.so of ${prefix}; missing: ${missing}")
endif()
