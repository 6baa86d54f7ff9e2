# SPDX-License-Identifier: BSD-3-Clause

# The libraries of a build for WebAssembly.
# Exceptions and the registers of 128 bit of WebAssembly itself, in all code; every browser since 2022 has both.
add_compile_options(-fwasm-exceptions -msimd128 -msse2)
add_link_options(-fwasm-exceptions)
# Eigen's instructions for SSE are not all among those that emscripten translates; the kernels' are.
add_compile_definitions(EIGEN_DONT_VECTORIZE)
include(cmake/compiled_libraries.cmake)
# Goes first: what libc++ 13 and Random123 lack for this compiler.
include_directories(BEFORE SYSTEM ${CMAKE_CURRENT_LIST_DIR}/include)
target_compile_options(linkwright_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-include;libcxx_13.h>)
