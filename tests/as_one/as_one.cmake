# SPDX-License-Identifier: Apache-2.0
# Unit tests as one program, each test a run of it: read, compiled and linked together they cost a
# tenth of as many programs.

# graben_unit_test(NAME source libs...): for the program that graben_unit_program makes next
function(graben_unit_test name source)
  cmake_path(ABSOLUTE_PATH source)
  set_property(GLOBAL APPEND PROPERTY graben_collected_tests ${name})
  set_property(GLOBAL APPEND PROPERTY graben_collected_sources ${source})
  set_property(GLOBAL APPEND PROPERTY graben_collected_libraries ${ARGN})
endfunction()

# graben_unit_program(TARGET libs...): of what was collected since the last one, whose names are `tests` then
function(graben_unit_program target)
  foreach(what tests sources libraries)
    get_property(${what} GLOBAL PROPERTY graben_collected_${what})
    set_property(GLOBAL PROPERTY graben_collected_${what})
  endforeach()
  list(REMOVE_DUPLICATES libraries)
  # A test that reads another header is put together anew.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})

  # All headers that any of them reads, once. What two of them call alike does not compile.
  set(headers)
  foreach(source ${sources})
    file(STRINGS ${source} lines REGEX "^#include ")
    list(APPEND headers ${lines})
  endforeach()
  list(REMOVE_DUPLICATES headers)
  # First the libraries': CMocka's macro `fail` breaks some.
  set(libraries_headers ${headers})
  list(FILTER libraries_headers INCLUDE REGEX "<")
  list(FILTER headers EXCLUDE REGEX "<")
  list(JOIN libraries_headers "\n" libraries_headers)
  list(JOIN headers "\n" headers)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.parts)
  file(CONFIGURE OUTPUT ${folder}/headers.hpp CONTENT "#pragma once\n@libraries_headers@\n@headers@\n" @ONLY)

  # The sources in a few parts, each source in namespaces of its own: what two of them call alike is not the
  # same, and what one of them does not use is a warning.
  set(group 9)
  set(parts)
  list(LENGTH tests count)
  math(EXPR last "${count} - 1")
  foreach(first RANGE 0 ${last} ${group})
    set(bodies)
    list(SUBLIST tests ${first} ${group} part)
    list(SUBLIST sources ${first} ${group} part_sources)
    foreach(test source IN ZIP_LISTS part part_sources)
      string(APPEND bodies "namespace ${test} {\nnamespace {\n#include \"${source}\"\n}\n}\n")
    endforeach()
    file(CONFIGURE OUTPUT ${folder}/tests_${first}.cpp CONTENT "#include \"headers.hpp\"\n@bodies@" @ONLY)
    list(APPEND parts ${folder}/tests_${first}.cpp)
  endforeach()

  set(rows)
  foreach(test source IN ZIP_LISTS tests sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(APPEND rows "    {\"${test}\", \"${source}\"},\n")
  endforeach()
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/run_one.cpp.in ${folder}/run_one.cpp @ONLY)
  add_executable(${target} ${folder}/run_one.cpp ${parts})
  # To write a precompiled header costs as much as to read its text twice more.
  list(LENGTH parts count)
  if(count GREATER 2)
    target_precompile_headers(${target} PRIVATE ${folder}/headers.hpp)
  endif()
  target_link_libraries(${target} PRIVATE ${libraries} ${ARGN} cmocka graben_build_flags)
  set(tests ${tests} PARENT_SCOPE)
endfunction()

# graben_no_test_left(): what no program was made of would not be run, and nobody would miss it
function(graben_no_test_left)
  get_property(tests GLOBAL PROPERTY graben_collected_tests)
  if(tests)
    message(FATAL_ERROR "no program has these unit tests: ${tests}")
  endif()
endfunction()
