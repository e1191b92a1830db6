# SPDX-License-Identifier: Apache-2.0
# Arm without an operating system, by Debian's cross compiler and newlib: what the toolchain files
# of the two processors share.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# A program needs a start and a memory map, which CMake's trials have not.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# How GCC 6 passed arguments does not matter here: nothing is linked with what it compiled.
add_compile_options(-Wno-psabi)
