# Whether the Python package can be built: sets CERES_ED_PYTHON_MISSING to what it lacks, empty where it
# lacks nothing. -DPython3_EXECUTABLE=... chooses another Python than the one found here.

# Of the Pythons of a machine the one with numpy: a bare one of a version manager may come first.
if(NOT Python3_EXECUTABLE)
  foreach(candidate python3 /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy, sys; print(sys.executable)"
                    RESULT_VARIABLE result OUTPUT_VARIABLE found ERROR_QUIET
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(result EQUAL 0)
      set(Python3_EXECUTABLE ${found} CACHE FILEPATH "The Python that the package is built for")
      break()
    endif()
  endforeach()
endif()

set(CERES_ED_PYTHON_MISSING "")
find_package(Python3 3.8 QUIET COMPONENTS Interpreter Development.Module)
if(Python3_Development.Module_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
  if(NOT pybind11_FOUND)
    set(CERES_ED_PYTHON_MISSING "pybind11 2.10 (Debian's pybind11-dev)")
  endif()
else()
  set(CERES_ED_PYTHON_MISSING "Python's headers (Debian's python3-dev)")
endif()

# Where Python looks below ~/.local or a virtual environment. Below /usr/local Debian has it look in
# dist-packages instead.
set(CERES_ED_PYTHON_DIR lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages
    CACHE STRING "Where the Python package is installed, below the prefix")
