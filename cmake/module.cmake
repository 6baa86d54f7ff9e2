# SPDX-License-Identifier: BSD-3-Clause

# One module = one static library `linkwright_<module>`; every module is compiled with the same flags.

add_library(linkwright_flags INTERFACE)
target_include_directories(linkwright_flags INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_features(linkwright_flags INTERFACE cxx_std_20)
# errno of sqrt and traps of selects block vectorising; without them code is 2.5 to 4.5 times faster and
# no value changes. Contraction would change values between instruction sets, so it is left to the SIMD kernels.
target_compile_options(linkwright_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wno-missing-field-initializers  # designated initialisers name what differs from the defaults
  -fno-math-errno -fno-trapping-math -ffp-contract=off
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # g++ 12 warns about its own std::string operator+ (GCC bug 105651)
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow>  # sources compiled as one see each other's constants
  $<$<BOOL:${LINKWRIGHT_WARNINGS_AS_ERRORS}>:-Werror>)
if(LINKWRIGHT_SANITIZE)
  target_compile_options(linkwright_flags INTERFACE -fsanitize=${LINKWRIGHT_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(linkwright_flags INTERFACE -fsanitize=${LINKWRIGHT_SANITIZE})
endif()
if(EMSCRIPTEN)
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
else()
  set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
endif()

# Sources compiled as one: the most for which two compilers stay below 3 GB.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)

# By itself emscripten's -Os inlines nothing: an analysis in the page then takes three times as long.
set(small -Os;-sINLINING_LIMIT=0)

# linkwright_module(<module> SOURCES <files> [DEPENDS <modules or libraries>])
function(linkwright_module module)
  linkwright_library(${module} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY LINKWRIGHT_MODULES linkwright_${module})
endfunction()

# linkwright_library(<name> ...): a library beside the modules, for those who link it by its name.
function(linkwright_library module)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(linkwright_${module} STATIC ${arg_SOURCES})
  target_include_directories(linkwright_${module} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                       $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(linkwright_${module} PUBLIC cxx_std_20)
  # Reading and reporting take milliseconds a run and two thirds of the compiler's time; a page loads them over the network.
  # Of a page that is dragged, reading, drawing and writing are two thirds of an answer.
  if(module MATCHES "_studies$|^study$|^report$|^app$|^serve$|^cli$" AND NOT (EMSCRIPTEN AND module MATCHES "^study$|^report$|^app$"))
    target_compile_options(linkwright_${module} PRIVATE $<$<CONFIG:Release>:$<IF:$<BOOL:${EMSCRIPTEN}>,${small},-O1>>)
  endif()
  # Our programs and tests take the flags from the modules; other people's code keeps its own.
  if(PROJECT_IS_TOP_LEVEL)
    target_link_libraries(linkwright_${module} PUBLIC $<BUILD_INTERFACE:linkwright_flags> ${arg_DEPENDS})
  else()
    target_link_libraries(linkwright_${module} PRIVATE $<BUILD_INTERFACE:linkwright_flags> PUBLIC ${arg_DEPENDS})
  endif()
  set_target_properties(linkwright_${module} PROPERTIES EXPORT_NAME ${module})
  # Into the module of Python.
  if(NOT EMSCRIPTEN)
    set_target_properties(linkwright_${module} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  add_library(Linkwright::${module} ALIAS linkwright_${module})
endfunction()

# linkwright_texts(<domain> <folder>): each <folder>/<name>.toml of a domain becomes <name>() of the generated header
# linkwright/<domain>/<folder>.h, in the namespace of the folder's last name: studies/templates holds what `linkwright new`
# writes, studies/published the tables that `linkwright reproduce` computes again. A kind without its file does not compile.
function(linkwright_texts domain folder)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.toml)
  cmake_path(GET folder FILENAME namespace)
  set(functions)
  foreach(file IN LISTS files)
    cmake_path(GET file STEM LAST_ONLY name)
    list(APPEND functions ${name}=${file})
  endforeach()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(header linkwright/${domain}/${folder}.h)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${namespace}.cpp)
  add_custom_command(OUTPUT ${source} ${generated}/${header}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${source} -DHEADER=${header} -DDECLARE=${generated}/${header}
            -DNAMESPACE=linkwright::${domain}::${namespace} "-DFILES=${functions}"
            -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
  target_sources(linkwright_${domain}_studies PRIVATE ${source} ${generated}/${header})
  target_include_directories(linkwright_${domain}_studies PRIVATE ${generated})
endfunction()

# linkwright_kernels(<module> SOURCES <files> [WIDEST avx2] [FLAGS <flags>]): kernels, compiled once for each instruction set,
# which is LINKWRIGHT_INSTRUCTION_SET there, and each in a compilation of its own; core/kernels.h chooses at run time. Each is
# one huge function: with sanitizers a single file takes many minutes to compile, so they are left out; what the kernels read
# and write is tested against the plain formulas.
function(linkwright_kernels module)
  cmake_parse_arguments(arg "" "WIDEST" "SOURCES;FLAGS" ${ARGN})
  if(LINKWRIGHT_SANITIZE)
    list(APPEND arg_FLAGS -fno-sanitize=all)
  endif()
  set(sets baseline)
  set(baseline)
  set(avx2 -mavx2 -mfma)
  # g++ 12's own AVX-512 header trips -Wmaybe-uninitialized.
  set(avx512 -mavx512f -mavx512dq -mfma -mprefer-vector-width=512 $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(LINKWRIGHT_X86_KERNELS)
    target_compile_definitions(linkwright_${module} PRIVATE LINKWRIGHT_X86_KERNELS)
    list(APPEND sets avx2)
    if(NOT arg_WIDEST STREQUAL "avx2")
      list(APPEND sets avx512)
    endif()
  endif()
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src OUTPUT_VARIABLE folder)
  foreach(source IN LISTS arg_SOURCES)
    foreach(set IN LISTS sets)
      set(compiled ${source})
      if(NOT set STREQUAL "baseline")  # a target compiles a file once, so that the others include it
        cmake_path(REMOVE_EXTENSION source OUTPUT_VARIABLE name)
        set(compiled ${CMAKE_CURRENT_BINARY_DIR}/kernels/${name}_${set}.cpp)
        file(CONFIGURE OUTPUT ${compiled} CONTENT "#include \"${folder}/${source}\"\n")
      endif()
      target_sources(linkwright_${module} PRIVATE ${compiled})
      set_source_files_properties(${compiled} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
        COMPILE_DEFINITIONS LINKWRIGHT_INSTRUCTION_SET=${set} COMPILE_OPTIONS "${${set}};${arg_FLAGS}")
    endforeach()
  endforeach()
endfunction()

# linkwright_require(<package> [options]): find_package(... REQUIRED) for a library that modules link; the installed
# package looks for it again.
macro(linkwright_require)
  find_package(${ARGV} REQUIRED)
  string(REPLACE ";" " " linkwright_requirement "${ARGV}")
  set_property(GLOBAL APPEND PROPERTY LINKWRIGHT_REQUIREMENTS "${linkwright_requirement}")
endmacro()

# linkwright_test(<module> SOURCES <files> [ALONE <files>] [DEPENDS <modules or libraries>]): one test program a module. Files
# under ALONE are not compiled together with others: their helpers have names that others use.
function(linkwright_test module)
  cmake_parse_arguments(arg "" "" "SOURCES;ALONE;DEPENDS" ${ARGN})
  set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(${module}_test ${arg_SOURCES} ${arg_ALONE})
  target_include_directories(${module}_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${module}_test PRIVATE LINKWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_compile_options(${module}_test PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(${module}_test PRIVATE ${arg_DEPENDS} linkwright_test_support GTest::gmock_main)
  set(timeout 300)
  if(LINKWRIGHT_SANITIZE)
    set(timeout 7200)  # sanitized programs take ten times as long and more
  endif()
  gtest_discover_tests(${module}_test DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT ${timeout})
endfunction()
