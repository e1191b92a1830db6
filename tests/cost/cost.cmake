# SPDX-License-Identifier: Apache-2.0
# What each test costs: GNU time writes its processor seconds into costs.txt of the build folder, a line a
# test (tests/cost/budget.py reads them). Not on another target, where an emulator runs the tests.

set(graben_costs ${PROJECT_BINARY_DIR}/costs.txt)
find_program(GRABEN_TIME time PATHS /usr/bin NO_DEFAULT_PATH)
if(CMAKE_CROSSCOMPILING OR NOT GRABEN_TIME)
  return()
endif()

# CMake's own, with the command behind GNU time.
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
  _add_test(NAME ${of_NAME} ${more}
    COMMAND ${GRABEN_TIME} -q -a -o ${graben_costs} -f "${of_NAME} %U %S %e" ${of_COMMAND})
endfunction()
