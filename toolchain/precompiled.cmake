# SPDX-License-Identifier: Apache-2.0
# Headers from outside cost more to read than our sources: they are compiled once for each group of
# targets (target_precompile_headers). Every source names what it uses all the same: the gate `names`
# looks at what the core's take of std and Eigen, and the preset `debug` and whoever has a compiler
# cache compile each one without. Not so unit tests, which are compiled together everywhere
# (tests/as_one).

# A compiler cache keeps nothing of a source with a precompiled header.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# What is beside Eigen in all groups but the core's, which has a list of its own.
set(graben_precompiled <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <cstddef> <cstdint>
  <cstdio> <cstring> <functional> <limits> <map> <optional> <random> <string> <string_view> <utility>
  <vector>)

# graben_as_one(TARGET [COUNT]): its sources are compiled in COUNT batches, two unless told, where headers are
# precompiled: what templates they have in common are made once. Sources that call something alike are
# never in the same batch (batches.py). Not on
# other targets, where the core's objects are judged one by one.
function(graben_as_one target)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
    return()
  endif()
  set(count 2)
  if(ARGC GREATER 1)
    set(count ${ARGV1})
  endif()
  get_target_property(sources ${target} SOURCES)
  set(batched)
  foreach(source ${sources})
    get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    cmake_path(ABSOLUTE_PATH source)
    if(NOT alone AND source MATCHES "[.]cpp$")
      list(APPEND batched ${source})
    endif()
  endforeach()
  # A source that calls something by another name may belong to another batch.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${batched})
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/toolchain/batches.py ${count}
      ${PROJECT_SOURCE_DIR}:${graben_generated} ${batched}
    OUTPUT_VARIABLE batches OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" batches "${batches}")
  foreach(source batch IN ZIP_LISTS batched batches)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class may have parts of its source's unnamed namespace: that source is no header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
