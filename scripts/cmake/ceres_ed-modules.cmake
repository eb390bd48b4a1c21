# Libraries of their own that programs load when a file needs them, so that nothing else has to install what
# they bring.

# ceres_ed_add_module_option(KEY FOR): the option CERES_ED_BUILD_KEY, on where nothing is missing.
function(ceres_ed_add_module_option key for)
  set(default OFF)
  if(CERES_ED_TOP_LEVEL AND NOT CERES_ED_${key}_MISSING)
    set(default ON)
  endif()
  option(CERES_ED_BUILD_${key} "Build the module for ${for}" ${default})
  if(CERES_ED_BUILD_${key} AND CERES_ED_${key}_MISSING)
    message(FATAL_ERROR "CERES_ED_BUILD_${key} is ON, and there is no ${CERES_ED_${key}_MISSING}")
  elseif(CERES_ED_TOP_LEVEL AND CERES_ED_${key}_MISSING)
    message(STATUS "ceres_ed: no module for ${for}: there is no ${CERES_ED_${key}_MISSING}")
  endif()
endfunction()
# ceres_ed_add_module(NAME SOURCES FILE ...): libceres_ed_NAME.so, where programs look for it.
function(ceres_ed_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "" SOURCES)
  add_library(ceres_ed_${name} SHARED ${module_SOURCES})
  add_library(ceres_ed::${name} ALIAS ceres_ed_${name})
  set_target_properties(
    ceres_ed_${name}
    PROPERTIES VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
               # Programs find it from their own folder, as they do when both are installed.
               LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}
               INSTALL_RPATH "$ORIGIN")
  target_link_libraries(ceres_ed_${name} PRIVATE ceres_ed::ceres_ed)
  # What it takes from an archive is its own, as in plugins.
  target_link_options(ceres_ed_${name} PRIVATE LINKER:--as-needed LINKER:--exclude-libs,ALL)
  if(CERES_ED_INSTALL)
    install(TARGETS ceres_ed_${name} LIBRARY COMPONENT ${name} NAMELINK_SKIP)
  endif()
endfunction()
