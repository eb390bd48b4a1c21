# PCL's libraries by name, for its package file asks for the development files of VTK: sets
# CERES_ED_PCL_MISSING to what is missing, empty where nothing is, and defines ceres_ed::pcl_common (with the
# headers), ceres_ed::pcl_io and ceres_ed::pcl_surface. The build uses this file, and so does the installed package.
find_path(
  CERES_ED_PCL_INCLUDE_DIR pcl/point_types.h
  PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 pcl-1.12 pcl-1.11 pcl)
find_path(CERES_ED_BOOST_INCLUDE_DIR boost/predef.h)
find_library(CERES_ED_pcl_common_LIBRARY pcl_common)
find_library(CERES_ED_pcl_io_LIBRARY pcl_io)
find_library(CERES_ED_pcl_surface_LIBRARY pcl_surface)
find_library(CERES_ED_pcl_search_LIBRARY pcl_search)
find_library(CERES_ED_pcl_kdtree_LIBRARY pcl_kdtree)
set(CERES_ED_PCL_MISSING "")
foreach(ceres_ed_name CERES_ED_PCL_INCLUDE_DIR CERES_ED_BOOST_INCLUDE_DIR CERES_ED_pcl_common_LIBRARY
        CERES_ED_pcl_io_LIBRARY CERES_ED_pcl_surface_LIBRARY CERES_ED_pcl_search_LIBRARY
        CERES_ED_pcl_kdtree_LIBRARY)
  mark_as_advanced(${ceres_ed_name})
  if(NOT ${ceres_ed_name})
    set(CERES_ED_PCL_MISSING "PCL (Debian's libpcl-dev)")
  endif()
endforeach()
if(NOT CERES_ED_PCL_MISSING AND NOT TARGET ceres_ed::pcl_common)
  add_library(ceres_ed::pcl_common INTERFACE IMPORTED GLOBAL)
  set_target_properties(
    ceres_ed::pcl_common
    PROPERTIES INTERFACE_LINK_LIBRARIES "${CERES_ED_pcl_common_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${CERES_ED_PCL_INCLUDE_DIR};${CERES_ED_BOOST_INCLUDE_DIR}")
  add_library(ceres_ed::pcl_io INTERFACE IMPORTED GLOBAL)
  set_target_properties(ceres_ed::pcl_io PROPERTIES INTERFACE_LINK_LIBRARIES "${CERES_ED_pcl_io_LIBRARY}")
  add_library(ceres_ed::pcl_surface INTERFACE IMPORTED GLOBAL)
  set_target_properties(
    ceres_ed::pcl_surface
    PROPERTIES INTERFACE_LINK_LIBRARIES
               "${CERES_ED_pcl_surface_LIBRARY};${CERES_ED_pcl_search_LIBRARY};${CERES_ED_pcl_kdtree_LIBRARY}")
endif()
