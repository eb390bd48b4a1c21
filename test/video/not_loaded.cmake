# Fails when `program` loads the decoders of videos ahead of a video that needs them.
cmake_minimum_required(VERSION 3.18)
execute_process(COMMAND ldd ${program} OUTPUT_VARIABLE libraries RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT libraries MATCHES "libc[.]so")
  message(FATAL_ERROR "ldd ${program}: ${result}")
endif()
if(libraries MATCHES "lib(opencv_videoio|avcodec|avformat|gst|ceres_ed_video)[^ ]*")
  message(FATAL_ERROR "${program} loads ${CMAKE_MATCH_0}")
endif()
