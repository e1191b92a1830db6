#include "app/plant/command_link.hpp"

namespace graben::plant {

bool CommandLink::accepts(const E2eConfig& config, const CanFrame& frame, TimeUs now) {
  constexpr std::uint8_t kLength = 8;
  if (!frame.extended || frame.remote || frame.error || frame.fd || frame.length != kLength) {
    ++counters_.wrong_format;
    return false;
  }
  if (!e2e_accepted(e2e_check(config, e2e_, frame.data, now))) {
    ++counters_.rejected;
    return false;
  }
  ++counters_.accepted;
  alive_ = true;
  last_us_ = now;
  return true;
}

bool CommandLink::dies(TimeUs now) {
  if (!alive_ || now - last_us_ < kCommandTimeoutUs) {
    return false;
  }
  ++counters_.timeouts;
  alive_ = false;
  return true;
}

}  // namespace graben::plant
