# SPDX-License-Identifier: Apache-2.0
# 32-bit Arm with Linux (Cortex-A7), by Debian's cross compiler; what runs here runs under QEMU's
# user mode.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_C_COMPILER arm-linux-gnueabihf-gcc)
set(CMAKE_CXX_COMPILER arm-linux-gnueabihf-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-arm -cpu cortex-a7 -L /usr/arm-linux-gnueabihf)
# Options and not CMAKE_CXX_FLAGS_INIT, which a build folder keeps as it was when it was made.
# How GCC 6 passed arguments does not matter here: nothing is linked with what it compiled.
add_compile_options(-mcpu=cortex-a7 -mfpu=neon-vfpv4 -mfloat-abi=hard -Wno-psabi)
