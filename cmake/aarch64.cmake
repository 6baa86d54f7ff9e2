# SPDX-License-Identifier: BSD-3-Clause

# Toolchain file: compiles for 64-bit ARM by Debian's g++-aarch64-linux-gnu with the arm64 libraries in LINKWRIGHT_SYSROOT, which
# tools/fetch-sysroot.sh fills; tests run under qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LINKWRIGHT_SYSROOT)
set(CMAKE_SYSROOT ${LINKWRIGHT_SYSROOT})
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L ${LINKWRIGHT_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${LINKWRIGHT_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${LINKWRIGHT_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${LINKWRIGHT_SYSROOT}/usr/share/pkgconfig)
