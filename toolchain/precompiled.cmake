# Headers from outside cost more to read than our sources: they are compiled once for each group of
# targets (target_precompile_headers). Every source names what it uses all the same: the preset `debug`,
# in which ./test builds the core, and whoever has a compiler cache read each one without.

# A compiler cache keeps nothing of a source with a precompiled header.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# What is beside Eigen in all groups but the core's, which has a list of its own.
set(graben_precompiled <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <cstddef> <cstdint>
  <cstdio> <cstring> <functional> <limits> <map> <optional> <random> <string> <string_view> <utility>
  <vector>)

# graben_together(TARGET sources...): for another machine, where time is scarcer than what changes, a
# target's sources are read as one but for these, which call something as others do.
function(graben_together target)
  if(CMAKE_CROSSCOMPILING)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()
