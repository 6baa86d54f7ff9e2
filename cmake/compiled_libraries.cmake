# SPDX-License-Identifier: BSD-3-Clause

# Libraries for machines that Debian compiles none for (WebAssembly, Windows): headers are taken from the installed packages, and what
# has code is compiled from Debian's source packages, which tools/fetch-sources.sh puts into build/sources.
enable_language(C)
set(sources ${PROJECT_SOURCE_DIR}/build/sources)
execute_process(COMMAND ${PROJECT_SOURCE_DIR}/tools/fetch-sources.sh ${sources} COMMAND_ERROR_IS_FATAL ANY)

# Headers of the machine that know no machine; the rest of /usr/include must not be seen.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(library boost fmt toml++ nlohmann CLI xsimd Random123 tl eigen3/Eigen eigen3/unsupported)
  if(NOT EXISTS /usr/include/${library})
    message(FATAL_ERROR "/usr/include/${library} is missing; tools/install-packages.sh run installs it")
  endif()
  cmake_path(GET library FILENAME name)
  file(CREATE_LINK /usr/include/${library} ${headers}/${name} SYMBOLIC)
endforeach()
include_directories(BEFORE SYSTEM ${headers})

add_library(fmt::fmt INTERFACE IMPORTED)
set_target_properties(fmt::fmt PROPERTIES INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY)
add_library(Eigen3::Eigen INTERFACE IMPORTED)
add_library(Threads::Threads INTERFACE IMPORTED)

# SUNDIALS: its own CMake files ask the machine for the size of types by running a program.
set(sundials ${sources}/sundials)
file(GLOB sundials_sources
  ${sundials}/src/arkode/*.c ${sundials}/src/cvode/*.c ${sundials}/src/sundials/*.c ${sundials}/src/nvector/serial/*.c
  ${sundials}/src/sunmatrix/band/*.c ${sundials}/src/sunmatrix/dense/*.c ${sundials}/src/sunmatrix/sparse/*.c
  ${sundials}/src/sunlinsol/band/*.c ${sundials}/src/sunlinsol/dense/*.c ${sundials}/src/sunlinsol/spgmr/*.c
  ${sundials}/src/sunnonlinsol/*/*.c)
list(FILTER sundials_sources EXCLUDE REGEX "hypamgpre|xbraid|petsc|/f[a-z]+_[a-z]+\\.c|_futils|_profiler")
add_library(sundials STATIC EXCLUDE_FROM_ALL ${sundials_sources})
target_include_directories(sundials SYSTEM PUBLIC ${PROJECT_BINARY_DIR}/sundials ${sundials}/include
                           PRIVATE ${sundials}/src ${sundials}/src/sundials ${sundials}/src/arkode ${sundials}/src/cvode)
target_compile_options(sundials PRIVATE -O2 -w)
block()
  set(PACKAGE_VERSION 6.4.1)
  set(PACKAGE_VERSION_MAJOR 6)
  set(PACKAGE_VERSION_MINOR 4)
  set(PACKAGE_VERSION_PATCH 1)
  set(SUNDIALS_C_COMPILER_HAS_MATH_PRECISIONS ON)
  set(SUNDIALS_C_COMPILER_HAS_ISINF_ISNAN ON)
  set(SUNDIALS_C_COMPILER_HAS_INLINE ON)
  set(SUNDIALS_C_COMPILER_HAS_SNPRINTF_AND_VA_COPY ON)
  set(PRECISION_LEVEL "#define SUNDIALS_DOUBLE_PRECISION 1")
  set(INDEX_TYPE "#define SUNDIALS_INT32_T 1")
  set(SUNDIALS_CINDEX_TYPE int32_t)
  set(SUNDIALS_LOGGING_LEVEL 0)
  set(SUNDIALS_MPI_ENABLED OFF)
  configure_file(${sundials}/include/sundials/sundials_config.in ${PROJECT_BINARY_DIR}/sundials/sundials/sundials_config.h)
endblock()
file(WRITE ${PROJECT_BINARY_DIR}/sundials/sundials/sundials_export.h
     "#define SUNDIALS_EXPORT\n#define SUNDIALS_DEPRECATED\n#define SUNDIALS_DEPRECATED_EXPORT\n")
add_library(SundialsSerial::arkode ALIAS sundials)
add_library(SundialsSerial::cvode ALIAS sundials)

# zlib packs the data of a report.
set(zlib ${sources}/zlib)
add_library(zlib STATIC EXCLUDE_FROM_ALL ${zlib}/adler32.c ${zlib}/compress.c ${zlib}/crc32.c ${zlib}/deflate.c ${zlib}/trees.c
            ${zlib}/zutil.c)
target_include_directories(zlib SYSTEM PUBLIC ${zlib})
target_compile_options(zlib PRIVATE -O2 -w)
add_library(ZLIB::ZLIB ALIAS zlib)

# NLopt, without the two methods in C++: its own CMake file cannot be taken in without its installation.
set(nlopt ${sources}/nlopt/src)
file(GLOB nlopt_sources ${nlopt}/api/*.c ${nlopt}/algs/*/*.c ${nlopt}/util/*.c)
list(FILTER nlopt_sources EXCLUDE REGEX "/tst|_test|f77api|nlopt-getopt|/algs/(stogo|subplex|cquad|cdirect/hybrid)|DIRparallel")
list(APPEND nlopt_sources ${nlopt}/algs/cdirect/hybrid.c)
add_library(nlopt STATIC EXCLUDE_FROM_ALL ${nlopt_sources})
file(GLOB nlopt_folders LIST_DIRECTORIES ON ${nlopt}/algs/*)
target_include_directories(nlopt SYSTEM PUBLIC ${nlopt}/api PRIVATE ${PROJECT_BINARY_DIR}/nlopt ${nlopt}/util ${nlopt_folders})
target_compile_options(nlopt PRIVATE -O2 -w)
block()
  set(NLOPT_MAJOR_VERSION 2)
  set(NLOPT_MINOR_VERSION 7)
  set(NLOPT_BUGFIX_VERSION 1)
  foreach(found COPYSIGN FPCLASSIFY GETPID GETTIMEOFDAY ISINF ISNAN STDINT_H SYS_TIME_H TIME UINT32_T UNISTD_H)
    set(HAVE_${found} ON)
  endforeach()
  set(TIME_WITH_SYS_TIME ON)
  set(SIZEOF_UNSIGNED_INT 4)
  set(SIZEOF_UNSIGNED_LONG 4)
  configure_file(${sources}/nlopt/nlopt_config.h.in ${PROJECT_BINARY_DIR}/nlopt/nlopt_config.h)
endblock()
add_library(NLopt::nlopt ALIAS nlopt)

# Sources of other people are compiled one by one: they share names.
set_target_properties(sundials zlib nlopt PROPERTIES UNITY_BUILD OFF)
