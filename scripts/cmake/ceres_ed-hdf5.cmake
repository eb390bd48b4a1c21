# Whether the module for HDF5 (ceres_ed/hdf5) can be built: the serial library and its header, as Debian and others
# name them.
find_library(CERES_ED_hdf5_LIBRARY NAMES hdf5_serial hdf5)
find_path(CERES_ED_HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
mark_as_advanced(CERES_ED_hdf5_LIBRARY CERES_ED_HDF5_INCLUDE_DIR)
set(CERES_ED_HDF5_MISSING "")
if(NOT CERES_ED_hdf5_LIBRARY OR NOT CERES_ED_HDF5_INCLUDE_DIR)
  set(CERES_ED_HDF5_MISSING "HDF5 (Debian's libhdf5-dev)")
endif()
ceres_ed_add_module_option(HDF5 ".h5 files (needs HDF5)")
