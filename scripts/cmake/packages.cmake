# Debian packages by `cpack`, one a component of install.cmake. They are made of a shared build with the
# prefix /usr (scripts/package.sh).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ceres-ed)
set(CPACK_PACKAGE_VENDOR "the ceres_ed authors")
# Debian wants an address. Whoever hands packages on puts one here that is read
# (-DCPACK_PACKAGE_CONTACT="Name <mail>"); that of the default can belong to nobody (RFC 2606).
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "ceres_ed authors <ceres-ed@packages.invalid>")
endif()
# Each package has a summary of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Dependencies are what the binaries load; that the tools load libceres_ed.so dpkg can't know yet.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/ceres_ed)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENTS_ALL "")

# The changelog of all packages. SOURCE_DATE_EPOCH sets its date, so that the same sources make the same
# packages.
set(ceres_ed_debian ${PROJECT_BINARY_DIR}/debian)
string(TIMESTAMP CERES_ED_DEBIAN_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(scripts/cmake/debian_changelog.in ${ceres_ed_debian}/changelog @ONLY)
execute_process(COMMAND gzip --best --no-name --force ${ceres_ed_debian}/changelog)
# Shared libraries are made known when all packages are in place.
file(WRITE ${ceres_ed_debian}/library/triggers "activate-noawait ldconfig\n")

# ceres_ed_add_package(COMPONENT NAME SECTION DEPENDS SUMMARY TEXT): the package NAME.
function(ceres_ed_add_package component name section depends summary text)
  string(TOUPPER ${component} key)
  # Excluded from a plain install, which has one licence for all.
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${ceres_ed_debian}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
  if(section STREQUAL libs)
    set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA ${ceres_ed_debian}/library/triggers PARENT_SCOPE)
  endif()
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

set(ceres_ed_runtime libceres-ed${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(ceres_ed_same_version "${ceres_ed_runtime} (= ${PROJECT_VERSION})")
set(ceres_ed_dev_depends "${ceres_ed_same_version}, libceres-dev (>= 2.1), libeigen3-dev (>= 3.4)")
if(openblas IN_LIST CERES_ED_EXTERNALS)
  string(APPEND ceres_ed_dev_depends ", libopenblas-dev")
endif()
set(ceres_ed_text
    "Fits one surface to another, and tracks tissue that deforms under a
moving depth camera, with an embedded-deformation graph on Ceres Solver.")

ceres_ed_add_package(library ${ceres_ed_runtime} libs "" "embedded deformation graphs: shared library"
                     "${ceres_ed_text}")
ceres_ed_add_package(
  dev libceres-ed-dev libdevel "${ceres_ed_dev_depends}" "embedded deformation graphs: development files"
  "${ceres_ed_text}\n
This package has what programs and plugins are built with: headers, and
files for CMake and pkg-config.")
ceres_ed_add_package(
  doc ceres-ed-doc doc "" "embedded deformation graphs: documentation and examples"
  "${ceres_ed_text}\n
This package has the pages about how to use and extend it, and the examples.")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SHLIBDEPS OFF)
if(CERES_ED_BUILD_APPS)
  ceres_ed_add_package(
    tools ceres-ed-tools science "${ceres_ed_same_version}" "embedded deformation graphs: programs"
    "${ceres_ed_text}\n
This package has ed_fit, ed_check, ed_apply, ed_cohort, ed_slam, ed_depth,
ed_simulate, ed_eval, ed_report and ed_list_energies, sample data, and ceres_ed_demo, which shows them.")
endif()
if(CERES_ED_BUILD_PYTHON)
  # The module is built for one minor version of Python.
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(python "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}~)")
  string(APPEND python ", python3 (<< ${Python3_VERSION_MAJOR}.${next_minor})")
  ceres_ed_add_package(
    python python3-ceres-ed python "${ceres_ed_same_version}, ${python}, python3-numpy"
    "embedded deformation graphs: Python package"
    "${ceres_ed_text}\n
This package has the Python module ceres_ed, which works on numpy arrays.")
  configure_file(scripts/cmake/python_prerm.in ${ceres_ed_debian}/python/prerm @ONLY)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${ceres_ed_debian}/python/prerm)
endif()
if(CERES_ED_BUILD_PCL)
  ceres_ed_add_package(
    pcl ceres-ed-pcl libs "${ceres_ed_same_version}" "embedded deformation graphs: PCL clouds and PCD files"
    "${ceres_ed_text}\n
With this package the programs read and write .pcd files, and C++ programs
convert the clouds and meshes of the Point Cloud Library (which they build
with libceres-ed-dev and libpcl-dev).")
endif()
if(TARGET ceres_ed_vtk)
  ceres_ed_add_package(
    vtk ceres-ed-vtk libs "${ceres_ed_same_version}" "embedded deformation graphs: VTK and VTP files"
    "${ceres_ed_text}\n
With this package the programs read and write surfaces in the files of the
Visualization Toolkit, .vtk and .vtp.")
endif()
if(TARGET ceres_ed_gltf)
  ceres_ed_add_package(
    gltf ceres-ed-gltf libs "${ceres_ed_same_version}" "embedded deformation graphs: GLB files"
    "${ceres_ed_text}\n
With this package the programs read and write meshes in .glb files, the
binary files of glTF.")
endif()
if(TARGET ceres_ed_video)
  ceres_ed_add_package(
    video ceres-ed-video libs "${ceres_ed_same_version}" "embedded deformation graphs: videos"
    "${ceres_ed_text}\n
With this package the programs read and write stereo recordings that are
videos.")
endif()

if(CERES_ED_BUILD_HDF5)
  ceres_ed_add_package(
    hdf5 ceres-ed-hdf5 libs "${ceres_ed_same_version}" "embedded deformation graphs: transforms in HDF5"
    "${ceres_ed_text}\n
With this package ed_apply writes displacement fields as .h5 files of ITK.")
endif()

if(NOT BUILD_SHARED_LIBS)
  # Says so when cpack is called; a static build is fine for anything else.
  set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/scripts/cmake/packages_refused.cmake)
endif()
include(CPack)
