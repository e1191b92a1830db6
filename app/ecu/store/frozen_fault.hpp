// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sample of the last fault as DM25 tells it.

#include "app/ecu/store/fault_recorder.hpp"
#include "hal/j1939/frozen_sample.hpp"

namespace graben::ecu {

[[nodiscard]] j1939::FrozenSample frozen_of(const FaultSample& from);

}  // namespace graben::ecu
