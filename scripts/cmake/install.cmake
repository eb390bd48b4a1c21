# What `cmake --install` puts where, and the package that find_package(ceres_ed) finds afterwards.
include(CMakePackageConfigHelpers)

set(ceres_ed_headers_dir ${CMAKE_INSTALL_INCLUDEDIR}/ceres_ed-${PROJECT_VERSION})
set(ceres_ed_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ceres_ed)

install(TARGETS ceres_ed ceres_ed_cost_functions EXPORT ceres_ed-targets)
install(DIRECTORY ceres_ed cost_functions DESTINATION ${ceres_ed_headers_dir} FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/include/ceres_ed/version.h DESTINATION ${ceres_ed_headers_dir}/ceres_ed)

install(EXPORT ceres_ed-targets NAMESPACE ceres_ed:: DESTINATION ${ceres_ed_package_dir})
get_property(CERES_ED_EXTERNALS GLOBAL PROPERTY CERES_ED_EXTERNALS)
configure_package_config_file(
  scripts/cmake/ceres_ed-config.cmake.in ${PROJECT_BINARY_DIR}/ceres_ed-config.cmake
  INSTALL_DESTINATION ${ceres_ed_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ceres_ed-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ceres_ed-config.cmake
              ${PROJECT_BINARY_DIR}/ceres_ed-config-version.cmake
              scripts/cmake/ceres_ed-external.cmake
        DESTINATION ${ceres_ed_package_dir})
