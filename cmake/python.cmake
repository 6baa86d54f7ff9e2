# SPDX-License-Identifier: BSD-3-Clause

# LINKWRIGHT_PYTHON: the Python module; on where Python with its headers, pybind11 and NumPy are.
# Debian's Python unless another one is named: the newest of a machine may be without NumPy.
find_program(LINKWRIGHT_PYTHON_EXECUTABLE NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python to build the module for")

if(NOT DEFINED LINKWRIGHT_PYTHON)
  block()
    set(found OFF)
    if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CROSSCOMPILING AND NOT LINKWRIGHT_SANITIZE AND LINKWRIGHT_PYTHON_EXECUTABLE)
      execute_process(RESULT_VARIABLE missing ERROR_QUIET COMMAND ${LINKWRIGHT_PYTHON_EXECUTABLE} -c
        "import numpy, os, sysconfig; os.stat(sysconfig.get_path('include') + '/Python.h'); os.stat('/usr/include/pybind11')")
      if(missing EQUAL 0)
        set(found ON)
      endif()
    endif()
    option(LINKWRIGHT_PYTHON "Build the Python module (needs pybind11 and NumPy)" ${found})
  endblock()
endif()
