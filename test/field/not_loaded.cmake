# Fails when `program` loads HDF5 ahead of a file that needs it.
cmake_minimum_required(VERSION 3.18)
execute_process(COMMAND ldd ${program} OUTPUT_VARIABLE libraries RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT libraries MATCHES "libc[.]so")
  message(FATAL_ERROR "ldd ${program}: ${result}")
endif()
if(libraries MATCHES "lib(hdf5|ceres_ed_hdf5)[^ ]*")
  message(FATAL_ERROR "${program} loads ${CMAKE_MATCH_0}")
endif()
