# Libraries without a package file that can be trusted, as targets. The build uses this file, and so
# does the installed package, so that no path of the machine that built it is exported.

# ceres_ed_find_external(NAME): sets ceres_ed_NAME_FOUND and, where libNAME is there, defines the target
# ceres_ed::NAME that links it. libNAME.so.0 will do: it takes no development files to link a C library
# such as OpenBLAS, whose archive is larger than all else that a fit needs.
macro(ceres_ed_find_external name)
  find_library(CERES_ED_${name}_LIBRARY NAMES ${name} lib${name}.so.0)
  mark_as_advanced(CERES_ED_${name}_LIBRARY)
  set(ceres_ed_${name}_FOUND FALSE)
  if(CERES_ED_${name}_LIBRARY)
    set(ceres_ed_${name}_FOUND TRUE)
    # The installed package looks for the same names.
    set_property(GLOBAL APPEND PROPERTY CERES_ED_EXTERNALS ${name})
    if(NOT TARGET ceres_ed::${name})
      add_library(ceres_ed::${name} INTERFACE IMPORTED GLOBAL)
      set_target_properties(ceres_ed::${name} PROPERTIES INTERFACE_LINK_LIBRARIES
                                                         "${CERES_ED_${name}_LIBRARY}")
    endif()
  endif()
endmacro()
