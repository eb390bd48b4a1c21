# Makes the Debian packages of `build`, checks what they say and hold, and runs ed_fit of them.
cmake_minimum_required(VERSION 3.18)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
set(triplet "[a-z0-9_]+-linux-gnu")

file(REMOVE_RECURSE ${folder})
run(out ${cpack} --config ${build}/CPackConfig.cmake -B ${folder})

# check_package(NAME DEPENDS FILE ...): NAME depends on what the expression DEPENDS matches and has the files
# that the others match. Unpacks it into folder/root.
function(check_package name depends)
  file(GLOB package ${folder}/${name}_*.deb)
  list(LENGTH package count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "packages of ${name}: '${package}', expected one")
  endif()
  foreach(field Package Version Architecture Maintainer Description Section)
    run(value dpkg-deb --field ${package} ${field})
    if(NOT value)
      message(FATAL_ERROR "${package} has no ${field}")
    endif()
  endforeach()
  run(value dpkg-deb --field ${package} Depends)
  message(STATUS "${name} depends on ${value}")
  if(NOT value MATCHES "${depends}")
    message(FATAL_ERROR "${name} depends on '${value}', expected ${depends}")
  endif()
  run(contents dpkg-deb --contents ${package})
  foreach(file IN LISTS ARGN ITEMS "/usr/share/doc/${name}/copyright"
                      "/usr/share/doc/${name}/changelog.gz")
    if(NOT contents MATCHES " \\.${file}( ->[^\n]*)?(\n|$)")
      message(FATAL_ERROR "${package} has no ${file}:\n${contents}")
    endif()
  endforeach()
  # All is root's, below /usr, and nobody else's to write.
  string(REPLACE "\n" ";" lines "${contents}")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^([-d]rw[-x]r-[-x]r-[-x]|lrwxrwxrwx) root/root .* \\./(usr/.*)?( ->.*)?$")
      message(FATAL_ERROR "${package} has: ${line}")
    endif()
  endforeach()
  run(out dpkg-deb --extract ${package} ${folder}/root)
endfunction()

set(library libceres-ed${soversion})
check_package(${library} "libc6 .*libgoogle-glog.*libopencv-core" "/usr/lib/${triplet}/libceres_ed.so.${soversion}")
check_package(
  libceres-ed-dev "${library} \\(= ${version}\\).*libceres-dev.*libeigen3-dev"
  "/usr/lib/${triplet}/libceres_ed.so"
  "/usr/lib/${triplet}/cmake/ceres_ed/ceres_ed-config.cmake"
  "/usr/lib/${triplet}/pkgconfig/ceres_ed.pc"
  "/usr/include/ceres_ed-${version}/ceres_ed/version.h"
  "/usr/include/ceres_ed-${version}/cost_functions/warp.h")
check_package(
  ceres-ed-tools "${library} \\(= ${version}\\).*libgflags" /usr/bin/ed_fit /usr/bin/ed_slam
  /usr/bin/ceres_ed_demo /usr/share/man/man1/ed_fit.1.gz /usr/share/man/man1/ceres_ed_demo.1.gz
  /usr/share/bash-completion/completions/ed_slam /usr/share/ceres_ed/data/plane_bumps/source.ply
  "/usr/lib/${triplet}/cmake/ceres_ed/ceres_ed-tools-targets.cmake")
check_package(
  ceres-ed-doc "^$" /usr/share/doc/ceres_ed/README.md /usr/share/doc/ceres_ed/ceres_ed/solver/README.md
  /usr/share/doc/ceres_ed/scripts/images/fit.png /usr/share/doc/ceres_ed/apps/examples/01_hello/hello.cc)
if(python)
  check_package(python3-ceres-ed "${library} \\(= ${version}\\).*python3 \\(>= 3.*python3 \\(<< 3.*python3-numpy"
                "/usr/lib/python3/dist-packages/ceres_ed/_core[^/]*.so"
                /usr/lib/python3/dist-packages/ceres_ed/__init__.py)
endif()
if(pcl)
  check_package(
    ceres-ed-pcl "${library} \\(= ${version}\\).*libpcl-io"
    "/usr/lib/${triplet}/libceres_ed_pcl.so.${soversion}"
    "/usr/lib/${triplet}/cmake/ceres_ed/ceres_ed-pcl-targets.cmake"
    "/usr/include/ceres_ed-pcl-${version}/ceres_ed/pcl/pcl_conversions.h")
endif()
if(vtk)
  check_package(ceres-ed-vtk "${library} \\(= ${version}\\).*libvtk9"
                "/usr/lib/${triplet}/libceres_ed_vtk.so.${soversion}")
endif()
if(gltf)
  check_package(ceres-ed-gltf "${library} \\(= ${version}\\)" "/usr/lib/${triplet}/libceres_ed_gltf.so.${soversion}")
endif()
if(video)
  check_package(ceres-ed-video "${library} \\(= ${version}\\).*libopencv-videoio"
                "/usr/lib/${triplet}/libceres_ed_video.so.${soversion}")
endif()

if(hdf5)
  check_package(ceres-ed-hdf5 "${library} \\(= ${version}\\).*libhdf5"
                "/usr/lib/${triplet}/libceres_ed_hdf5.so.${soversion}")
endif()

# Faults that Debian's own checker calls errors.
find_program(LINTIAN lintian)
if(LINTIAN)
  file(GLOB packages ${folder}/*.deb)
  execute_process(COMMAND ${LINTIAN} --fail-on error --display-level error --allow-root ${packages}
                  RESULT_VARIABLE result OUTPUT_VARIABLE faults ERROR_VARIABLE faults)
  if(result)
    message(FATAL_ERROR "lintian says of the packages:\n${faults}")
  endif()
else()
  message(STATUS "not checked by lintian, which is not installed")
endif()

# Nothing of the machine that built them, in binaries neither.
execute_process(
  COMMAND grep --recursive --files-with-matches --fixed-strings -e ${source}/ -e ${build}/ ${folder}/root
  RESULT_VARIABLE result OUTPUT_VARIABLE files)
# 1: no match; 0 and 2 are a match and a failure.
if(NOT result EQUAL 1)
  message(FATAL_ERROR "these name ${source} or ${build}:\n${files}")
endif()

file(GLOB library_dir ${folder}/root/usr/lib/*-linux-gnu)
set(ENV{LD_LIBRARY_PATH} "${library_dir}:$ENV{LD_LIBRARY_PATH}")
set(root ${folder}/root/usr)
run(out ${root}/bin/ed_fit ${root}/share/ceres_ed/data/plane_bumps/source.ply
    ${root}/share/ceres_ed/data/plane_bumps/target.ply --output=${folder}/fitted.ply)
