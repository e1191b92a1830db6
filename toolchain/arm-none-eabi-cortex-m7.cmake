# SPDX-License-Identifier: Apache-2.0
# Cortex-M7 with the double-precision FPU; what runs here runs on QEMU's board mps2-an500.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/mps2_an500/run.sh)
# Options and not CMAKE_CXX_FLAGS_INIT, which a build folder keeps as it was when it was made.
set(graben_cpu -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard)
add_compile_options(${graben_cpu})
add_link_options(${graben_cpu})
# The vectors lie where the processor looks for them, the rest in the 16 MB of PSRAM.
set(GRABEN_START_SOURCE ${CMAKE_CURRENT_LIST_DIR}/mps2_an500/start.cpp)
set(GRABEN_START_LINK_OPTIONS LINKER:-Ttext-segment=0x60000000
  LINKER:--section-start=.vectors=0 LINKER:--undefined=graben_vectors)
