# SPDX-License-Identifier: Apache-2.0
# 64-bit Arm with Linux, by Debian's cross compiler; what runs here runs under QEMU's user mode.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
# Options and not CMAKE_CXX_FLAGS_INIT, which a build folder keeps as it was when it was made.
add_compile_options(-mcpu=cortex-a53)
