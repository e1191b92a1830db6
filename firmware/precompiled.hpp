// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What most of the core reads anyway, compiled once; included by no source, which all name what
/// they use. Under the gate `layering` as every file here.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <type_traits>
