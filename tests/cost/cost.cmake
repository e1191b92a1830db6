# SPDX-License-Identifier: Apache-2.0
# CMake's add_test with two things more: the label `thorough` of what ./test leaves out (tests/thorough.cmake), and,
# with GRABEN_COSTS, the command behind GNU time, which writes its processor seconds into costs.txt of the build
# folder, a line a test (budget.py reads them). Not on another target, where an emulator runs the tests.

if(CMAKE_CROSSCOMPILING)
  return()
endif()
set(graben_time)
if(GRABEN_COSTS)
  find_program(GRABEN_TIME time PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
  set(graben_time ${GRABEN_TIME} -q -a -o ${PROJECT_BINARY_DIR}/costs.txt -f)
endif()

function(add_test)
  cmake_parse_arguments(PARSE_ARGV 0 of "COMMAND_EXPAND_LISTS" "NAME;WORKING_DIRECTORY" "CONFIGURATIONS;COMMAND")
  list(GET of_COMMAND 0 program)
  # A list that is changed loses which of its semicolons were text: only those of a target are.
  if(TARGET ${program})
    list(REMOVE_AT of_COMMAND 0)
    list(PREPEND of_COMMAND $<TARGET_FILE:${program}>)
  endif()
  set(more)
  if(of_CONFIGURATIONS)
    list(APPEND more CONFIGURATIONS ${of_CONFIGURATIONS})
  endif()
  if(of_WORKING_DIRECTORY)
    list(APPEND more WORKING_DIRECTORY ${of_WORKING_DIRECTORY})
  endif()
  if(of_COMMAND_EXPAND_LISTS)
    list(APPEND more COMMAND_EXPAND_LISTS)
  endif()
  set(behind)
  if(graben_time)
    set(behind ${graben_time} "${of_NAME} %U %S %e")
  endif()
  _add_test(NAME ${of_NAME} ${more} COMMAND ${behind} ${of_COMMAND})
  set_property(GLOBAL APPEND PROPERTY graben_tests ${of_NAME})
  get_property(left_out GLOBAL PROPERTY graben_thorough)
  if(of_NAME IN_LIST left_out)
    # At the folder's end: it may set labels of its own.
    cmake_language(EVAL CODE "cmake_language(DEFER CALL set_property TEST ${of_NAME} APPEND PROPERTY LABELS thorough)")
  endif()
endfunction()

# graben_no_name_left(): a row of tests/thorough.cmake that names no test leaves out nothing, and nobody would miss it
function(graben_no_name_left)
  get_property(left_out GLOBAL PROPERTY graben_thorough)
  get_property(there GLOBAL PROPERTY graben_tests)
  list(REMOVE_ITEM left_out ${there})
  if(left_out)
    message(FATAL_ERROR "tests/thorough.cmake names no test: ${left_out}")
  endif()
endfunction()
