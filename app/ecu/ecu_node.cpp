// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ecu_node.hpp"

#include <algorithm>

#include "app/ecu/kinds.hpp"

namespace graben::ecu {
namespace {
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
constexpr TimeUs kOpenAgain_us = 200 * kMillisecondUs;
constexpr TimeUs kStillPassive_us = kSecondUs;

BusState bus_state(CanPortState state) {
  switch (state) {
    case CanPortState::kActive:
      return BusState::kActive;
    case CanPortState::kErrorPassive:
      return BusState::kPassive;
    case CanPortState::kBusOff:
      return BusState::kOff;
    case CanPortState::kClosed:
    case CanPortState::kDown:
      break;
  }
  return BusState::kDown;
}
}  // namespace

bool BusWatch::begin(TimeUs now_us) {
  stalled_ = has_begun_ && now_us - last_us_ > kStalled_us;
  last_us_ = now_us;
  has_begun_ = true;
  before_ = bus_state(port_.state());
  return stalled_ || needs_open_;
}

BusState BusWatch::judge(TimeUs now_us) {
  // What it was before the port was read counts too: each state is seen for one cycle at least.
  bus_ = std::max(before_, bus_state(port_.state()));
  if (bus_ == BusState::kPassive && !needs_open_) {
    // It mostly comes back by itself; but the frame that says so can be lost.
    open_from_us_ = now_us + kStillPassive_us;
  }
  needs_open_ = needs_open_ || bus_ != BusState::kActive;
  return bus_;
}

void BusWatch::end(TimeUs now_us) {
  const bool is_back = bus_ == BusState::kActive;
  if (stalled_ || (needs_open_ && (is_back || now_us >= open_from_us_))) {
    // A port that does not open again stays silent; the signals then time out.
    needs_open_ = !port_.open();
    open_from_us_ = now_us + kOpenAgain_us;
  }
}

template class EcuNode<ExcavatorKind>;
template class EcuNode<DozerKind>;

}  // namespace graben::ecu
