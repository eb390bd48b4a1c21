# What `cmake --install` puts where, and the package that find_package(ceres_ed) finds afterwards. Parts
# that can be installed alone, by `cmake --install ... --component`:
#   library  what a program needs to run: libceres_ed.so.*, nothing of a static build
#   dev      what one needs to be built: headers, libceres_ed.so or .a, package files
#   tools    programs, the demo and its data
#   python   the Python package (ceres_ed/python)
#   pcl      the module for PCL, with its header (ceres_ed/pcl)
#   vtk      the module for .vtk and .vtp files (ceres_ed/vtk)
#   gltf     the module for .glb files (ceres_ed/gltf)
#   video    the module for videos (ceres_ed/video)
#   hdf5     the module for .h5 files (ceres_ed/hdf5)
#   doc      the pages with their pictures, the examples, and the licence
include(CMakePackageConfigHelpers)

set(ceres_ed_headers_dir ${CMAKE_INSTALL_INCLUDEDIR}/ceres_ed-${PROJECT_VERSION})
set(ceres_ed_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ceres_ed)

# An export a component of find_package.
install(TARGETS ceres_ed_cost_functions EXPORT ceres_ed-cost_functions-targets)
install(
  TARGETS ceres_ed
  EXPORT ceres_ed-library-targets
  LIBRARY COMPONENT library NAMELINK_COMPONENT dev
  ARCHIVE COMPONENT dev)
foreach(part cost_functions library)
  install(EXPORT ceres_ed-${part}-targets NAMESPACE ceres_ed:: DESTINATION ${ceres_ed_package_dir}
          COMPONENT dev)
endforeach()
if(CERES_ED_BUILD_APPS)
  install(EXPORT ceres_ed-tools-targets NAMESPACE ceres_ed:: DESTINATION ${ceres_ed_package_dir}
          COMPONENT tools)
endif()

# The headers that a user includes, and those that these include. All others are internal.
include(scripts/cmake/public_headers.cmake)
foreach(header IN LISTS CERES_ED_PUBLIC_HEADERS)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${ceres_ed_headers_dir}/${folder} COMPONENT dev)
endforeach()
install(DIRECTORY cost_functions DESTINATION ${ceres_ed_headers_dir} COMPONENT dev
        FILES_MATCHING
        PATTERN "*.h")
if(CERES_ED_BUILD_PCL)
  install(EXPORT ceres_ed-pcl-targets NAMESPACE ceres_ed:: DESTINATION ${ceres_ed_package_dir} COMPONENT pcl)
  install(FILES scripts/cmake/ceres_ed-pcl.cmake DESTINATION ${ceres_ed_package_dir} COMPONENT pcl)
endif()
install(FILES ${PROJECT_BINARY_DIR}/include/ceres_ed/version.h
        DESTINATION ${ceres_ed_headers_dir}/ceres_ed COMPONENT dev)

# What the users of the library link: of a shared one, what its headers use and the BLAS that must stand
# ahead of others; of an archive, everything.
get_property(CERES_ED_EXTERNALS GLOBAL PROPERTY CERES_ED_EXTERNALS)
set(ceres_ed_private_externals ${CERES_ED_EXTERNALS})
list(REMOVE_ITEM ceres_ed_private_externals openblas)
get_target_property(ceres_ed_kind ceres_ed TYPE)
if(ceres_ed_kind STREQUAL SHARED_LIBRARY)
  list(REMOVE_ITEM CERES_ED_EXTERNALS ${ceres_ed_private_externals})
endif()
configure_package_config_file(
  scripts/cmake/ceres_ed-config.cmake.in ${PROJECT_BINARY_DIR}/ceres_ed-config.cmake
  INSTALL_DESTINATION ${ceres_ed_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ceres_ed-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ceres_ed-config.cmake
              ${PROJECT_BINARY_DIR}/ceres_ed-config-version.cmake
              scripts/cmake/ceres_ed-external.cmake
              scripts/cmake/ceres_ed-plugin.cmake
        DESTINATION ${ceres_ed_package_dir} COMPONENT dev)

# The same for pkg-config. Ceres and glog have no files of their own for it.
set(ceres_ed_pc_libraries ceres glog)
set(ceres_ed_pc_private_libraries ${ceres_ed_private_externals} pthread ${CMAKE_DL_LIBS})
if(openblas IN_LIST CERES_ED_EXTERNALS)
  list(PREPEND ceres_ed_pc_libraries openblas)
endif()
if(ceres_ed_kind STREQUAL STATIC_LIBRARY)
  # So that nobody has to know which kind is installed, and to say --static.
  list(APPEND ceres_ed_pc_libraries ${ceres_ed_pc_private_libraries})
  set(ceres_ed_pc_private_libraries "")
endif()
# Where the library was found without its development files.
if(CERES_ED_openblas_LIBRARY MATCHES "/(libopenblas[.]so[.][0-9]+)$")
  list(TRANSFORM ceres_ed_pc_libraries REPLACE "^openblas$" ":${CMAKE_MATCH_1}")
endif()
list(TRANSFORM ceres_ed_pc_libraries PREPEND -l OUTPUT_VARIABLE CERES_ED_PC_LIBS)
list(TRANSFORM ceres_ed_pc_private_libraries PREPEND -l OUTPUT_VARIABLE CERES_ED_PC_LIBS_PRIVATE)
list(JOIN CERES_ED_PC_LIBS " " CERES_ED_PC_LIBS)
list(JOIN CERES_ED_PC_LIBS_PRIVATE " " CERES_ED_PC_LIBS_PRIVATE)
# Relative to the file, so that the package can be moved.
file(RELATIVE_PATH CERES_ED_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" CERES_ED_PC_PREFIX ${CERES_ED_PC_PREFIX})
file(RELATIVE_PATH CERES_ED_PC_LIBDIR ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH CERES_ED_PC_INCLUDEDIR ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
configure_file(scripts/cmake/ceres_ed.pc.in ${PROJECT_BINARY_DIR}/ceres_ed.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/ceres_ed.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

set(ceres_ed_doc_dir ${CMAKE_INSTALL_DATADIR}/doc/ceres_ed)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${ceres_ed_doc_dir} COMPONENT doc)
# In their tree, so that the links between them lead somewhere.
file(GLOB_RECURSE ceres_ed_pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
     apps/*.md ceres_ed/*.md cost_functions/*.md data/*.md scripts/*.md test/*.md scripts/images/*.png
     ceres_ed/*.png)
foreach(page IN LISTS ceres_ed_pages)
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${ceres_ed_doc_dir}/${folder} COMPONENT doc)
endforeach()
install(DIRECTORY apps/examples DESTINATION ${ceres_ed_doc_dir}/apps COMPONENT doc)
if(CERES_ED_BUILD_APPS)
  configure_file(scripts/cmake/ceres_ed_demo.1 ${PROJECT_BINARY_DIR}/ceres_ed_demo.1 COPYONLY)
  execute_process(COMMAND gzip --best --no-name --force ${PROJECT_BINARY_DIR}/ceres_ed_demo.1)
  install(FILES ${PROJECT_BINARY_DIR}/ceres_ed_demo.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
  install(PROGRAMS scripts/demo.sh DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME ceres_ed_demo COMPONENT tools)
  install(DIRECTORY data DESTINATION ${CMAKE_INSTALL_DATADIR}/ceres_ed COMPONENT tools
          FILES_MATCHING REGEX "/data/[^/]+/[^/]+$")
endif()
