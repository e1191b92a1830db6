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
