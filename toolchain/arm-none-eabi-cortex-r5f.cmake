# SPDX-License-Identifier: Apache-2.0
# Cortex-R5F; what runs here runs under QEMU's user mode, which answers semihosting too.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-arm -cpu cortex-r5f)
# Options and not CMAKE_CXX_FLAGS_INIT, which a build folder keeps as it was when it was made.
set(graben_cpu -mcpu=cortex-r5 -mfpu=vfpv3-d16 -mfloat-abi=hard)
add_compile_options(${graben_cpu})
add_link_options(${graben_cpu})
