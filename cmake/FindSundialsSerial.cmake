# SPDX-License-Identifier: BSD-3-Clause

# The serial integrators of SUNDIALS, as SundialsSerial::arkode and SundialsSerial::cvode. SUNDIALS' own package
# config wants OpenMP (and targets of MPI) for parts that are not used here, and fails where the compiler has none.
# Both libraries hold the serial vectors, matrices and solvers they need.
include(FindPackageHandleStandardArgs)

find_path(SundialsSerial_INCLUDE_DIR arkode/arkode_erkstep.h)
find_library(SundialsSerial_ARKODE sundials_arkode)
find_library(SundialsSerial_CVODE sundials_cvode)
mark_as_advanced(SundialsSerial_INCLUDE_DIR SundialsSerial_ARKODE SundialsSerial_CVODE)

if(SundialsSerial_INCLUDE_DIR)
  file(STRINGS ${SundialsSerial_INCLUDE_DIR}/sundials/sundials_config.h SundialsSerial_line
       REGEX "#define SUNDIALS_VERSION \"")
  string(REGEX REPLACE ".*\"([0-9.]+).*" "\\1" SundialsSerial_VERSION "${SundialsSerial_line}")
endif()
find_package_handle_standard_args(SundialsSerial
  REQUIRED_VARS SundialsSerial_ARKODE SundialsSerial_CVODE SundialsSerial_INCLUDE_DIR
  VERSION_VAR SundialsSerial_VERSION)

if(SundialsSerial_FOUND AND NOT TARGET SundialsSerial::arkode)
  foreach(part arkode cvode)
    string(TOUPPER ${part} SundialsSerial_part)
    add_library(SundialsSerial::${part} UNKNOWN IMPORTED)
    set_target_properties(SundialsSerial::${part} PROPERTIES
      IMPORTED_LOCATION ${SundialsSerial_${SundialsSerial_part}}
      INTERFACE_INCLUDE_DIRECTORIES ${SundialsSerial_INCLUDE_DIR})
  endforeach()
endif()
