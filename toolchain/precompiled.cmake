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

# graben_as_one(TARGET): its sources are compiled in two batches, where headers are precompiled: what
# templates they have in common are made once. Not for the core, whose objects are judged one by one.
function(graben_as_one target)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  math(EXPR half "(${count} + 1) / 2")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${half})
endfunction()
