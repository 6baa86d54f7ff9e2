# One room = one static library `linkwright_<room>`; every room is compiled with the same flags.

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
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# linkwright_room(<room> SOURCES <files> [DEPENDS <rooms or libraries>])
function(linkwright_room room)
  linkwright_library(${room} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY LINKWRIGHT_ROOMS linkwright_${room})
endfunction()

# linkwright_extra(<name> ...): a library for those who link it by its name; Linkwright::linkwright is without it.
function(linkwright_extra name)
  linkwright_library(${name} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY LINKWRIGHT_EXTRAS linkwright_${name})
endfunction()

function(linkwright_library room)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(linkwright_${room} STATIC ${arg_SOURCES})
  target_include_directories(linkwright_${room} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                       $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(linkwright_${room} PUBLIC cxx_std_20)
  # Reading and reporting take milliseconds a run and two thirds of the compiler's time.
  if(room MATCHES "_studies$|^study$|^report$|^app$|^cli$")
    target_compile_options(linkwright_${room} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  # Our programs and tests take the flags from the rooms; other people's code keeps its own.
  if(PROJECT_IS_TOP_LEVEL)
    target_link_libraries(linkwright_${room} PUBLIC $<BUILD_INTERFACE:linkwright_flags> ${arg_DEPENDS})
  else()
    target_link_libraries(linkwright_${room} PRIVATE $<BUILD_INTERFACE:linkwright_flags> PUBLIC ${arg_DEPENDS})
  endif()
  set_target_properties(linkwright_${room} PROPERTIES EXPORT_NAME ${room} POSITION_INDEPENDENT_CODE ON)
  add_library(Linkwright::${room} ALIAS linkwright_${room})
endfunction()

# linkwright_templates(<domain>): each studies/templates/<name>.toml of a domain, which is what `linkwright new` writes,
# becomes <name>() of the generated header linkwright/<domain>/studies/templates.h. A kind without its file does not compile.
function(linkwright_templates domain)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/studies/templates/*.toml)
  set(functions)
  foreach(file IN LISTS files)
    cmake_path(GET file STEM LAST_ONLY name)
    list(APPEND functions ${name}=${file})
  endforeach()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(header linkwright/${domain}/studies/templates.h)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/templates.cpp)
  add_custom_command(OUTPUT ${source} ${folder}/${header}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${source} -DHEADER=${header} -DDECLARE=${folder}/${header}
            -DNAMESPACE=linkwright::${domain}::templates "-DFILES=${functions}"
            -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
  target_sources(linkwright_${domain}_studies PRIVATE ${source} ${folder}/${header})
  target_include_directories(linkwright_${domain}_studies PRIVATE ${folder})
endfunction()

# linkwright_kernels(<room> BASELINE <files> AVX2 <files> [AVX512 <files>] [FLAGS <flags>]): kernels, once per instruction
# set and each in a compilation of its own; core/kernels.h chooses at run time. Each is one huge function: with sanitizers
# a single file takes many minutes to compile, so they are left out; what the kernels read and write is tested against the
# plain formulas.
function(linkwright_kernels room)
  cmake_parse_arguments(arg "" "" "BASELINE;AVX2;AVX512;FLAGS" ${ARGN})
  if(LINKWRIGHT_SANITIZE)
    list(APPEND arg_FLAGS -fno-sanitize=all)
  endif()
  set(avx2 -mavx2 -mfma)
  # g++ 12's own AVX-512 header trips -Wmaybe-uninitialized.
  set(avx512 -mavx512f -mavx512dq -mfma -mprefer-vector-width=512 $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_sources(linkwright_${room} PRIVATE ${arg_BASELINE})
  set_source_files_properties(${arg_BASELINE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS "${arg_FLAGS}")
  if(LINKWRIGHT_X86_KERNELS)
    target_compile_definitions(linkwright_${room} PRIVATE LINKWRIGHT_X86_KERNELS)
    target_sources(linkwright_${room} PRIVATE ${arg_AVX2} ${arg_AVX512})
    set_source_files_properties(${arg_AVX2} PROPERTIES COMPILE_OPTIONS "${avx2};${arg_FLAGS}")
    set_source_files_properties(${arg_AVX512} PROPERTIES COMPILE_OPTIONS "${avx512};${arg_FLAGS}")
  endif()
endfunction()

# linkwright_require(<package> [options]): find_package(... REQUIRED) for a library that rooms link; the installed
# package looks for it again.
macro(linkwright_require)
  find_package(${ARGV} REQUIRED)
  string(REPLACE ";" " " linkwright_requirement "${ARGV}")
  set_property(GLOBAL APPEND PROPERTY LINKWRIGHT_REQUIREMENTS "${linkwright_requirement}")
endmacro()

# linkwright_test(<room> SOURCES <files> [ALONE <files>] [DEPENDS <rooms or libraries>]): one test program a room. Files
# under ALONE are not compiled together with others: their helpers have names that others use.
function(linkwright_test room)
  cmake_parse_arguments(arg "" "" "SOURCES;ALONE;DEPENDS" ${ARGN})
  set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(${room}_test ${arg_SOURCES} ${arg_ALONE})
  target_include_directories(${room}_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${room}_test PRIVATE LINKWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_compile_options(${room}_test PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(${room}_test PRIVATE ${arg_DEPENDS} linkwright_test_support GTest::gmock_main)
  gtest_discover_tests(${room}_test DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300)
endfunction()
