# SPDX-License-Identifier: Apache-2.0
# Which unit tests are not run on a target, and why: TEST|TARGETS, a regular expression|WHY. What
# runs has fewer random rounds (tests/unit/rounds.hpp). A row that fits no test, or no target, is
# refused.
set(every_raw_value "every raw value of every signal, which bits alone decide")
set(one_file "its machine is like another one, and by semihosting all files look like one")
set(rows
  "unit_dbc_codec|^arm-|${every_raw_value}"
  "unit_dbc_dozer_codec|^arm-|${every_raw_value}"
  "unit_steady_lambda|^arm-|a search at every step, minutes under an emulator"
  "unit_tilt|^arm-none-|${one_file}"
  "unit_tilting_dozer|^arm-none-|${one_file}"
  "unit_curving_dozer|^arm-none-|${one_file}")

cmake_path(GET CMAKE_TOOLCHAIN_FILE STEM target)
set(known aarch64-linux-gnu arm-linux-gnueabihf arm-none-eabi-cortex-m7 arm-none-eabi-cortex-r5f)
foreach(row ${rows})
  string(REPLACE "|" ";" fields "${row}")
  list(GET fields 0 test)
  list(GET fields 1 where)
  list(GET fields 2 why)
  if(NOT test IN_LIST tests)
    message(FATAL_ERROR "left_out.cmake: no unit test is called ${test}")
  endif()
  set(fitting ${known})
  list(FILTER fitting INCLUDE REGEX "${where}")
  if(NOT fitting)
    message(FATAL_ERROR "left_out.cmake: ${test}: no target is like ${where}")
  endif()
  if(target MATCHES "${where}")
    message(STATUS "NOT run on ${target}: ${test}: ${why}")
    list(APPEND left_out ${test})
  endif()
endforeach()
