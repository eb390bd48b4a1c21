# The modules for formats of meshes: VTK's, and glTF. Sets CERES_ED_VTK_MISSING and CERES_ED_GLTF_MISSING to
# what is missing, empty where nothing is. VTK's libraries are found by name, for its package file asks for the
# development files of all that it was built with.
find_path(CERES_ED_VTK_INCLUDE_DIR vtkPolyData.h PATH_SUFFIXES vtk-9.3 vtk-9.2 vtk-9.1 vtk-9.0 vtk)
mark_as_advanced(CERES_ED_VTK_INCLUDE_DIR)
set(CERES_ED_VTK_MISSING "")
set(CERES_ED_VTK_LIBRARIES "")
if(NOT CERES_ED_VTK_INCLUDE_DIR)
  set(CERES_ED_VTK_MISSING "VTK (Debian's libvtk9-dev)")
endif()
foreach(name IOXML IOLegacy IOCore CommonExecutionModel CommonDataModel CommonCore)
  find_library(CERES_ED_vtk${name}_LIBRARY NAMES vtk${name}-9.3 vtk${name}-9.2 vtk${name}-9.1 vtk${name}-9.0 vtk${name})
  mark_as_advanced(CERES_ED_vtk${name}_LIBRARY)
  if(CERES_ED_vtk${name}_LIBRARY)
    list(APPEND CERES_ED_VTK_LIBRARIES ${CERES_ED_vtk${name}_LIBRARY})
  else()
    set(CERES_ED_VTK_MISSING "VTK (Debian's libvtk9-dev)")
  endif()
endforeach()

find_path(CERES_ED_TINYGLTF_INCLUDE_DIR tiny_gltf.h)
mark_as_advanced(CERES_ED_TINYGLTF_INCLUDE_DIR)
set(CERES_ED_GLTF_MISSING "")
if(NOT CERES_ED_TINYGLTF_INCLUDE_DIR)
  set(CERES_ED_GLTF_MISSING "tinygltf (Debian's libtinygltf-dev)")
endif()

ceres_ed_add_module_option(VTK ".vtk and .vtp files (needs VTK)")
ceres_ed_add_module_option(GLTF ".glb files (needs tinygltf)")
