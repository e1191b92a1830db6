// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/log_version.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <vector>

namespace graben::identify {
namespace {

using Identity = dbc::common::EcuIdentity;
using Status = dbc::common::EcuStatus;

/// Twice the period of EcuIdentity.
constexpr double kUntold_s = 2.0;

/// EcuStatus before LimitKind had five bits: Mode 0|4, LimitKind 4|4, 14 'error', 15 'not
/// available'.
LoggedFrame of_this_version(LoggedFrame frame) {
  constexpr unsigned kLastMode = 5;
  constexpr unsigned kLastKind = 13;
  const unsigned mode = frame.data[0] & 0xFU;
  const unsigned kind = frame.data[0] >> 4U;
  const unsigned mode_now = mode <= kLastMode ? mode : mode == 15U ? 7U : 6U;
  const unsigned kind_now = kind <= kLastKind ? kind : kind + 16U;
  frame.data[0] = static_cast<std::uint8_t>(mode_now | kind_now << 3U);
  return frame;
}

/// Holds frames back until the controller has said its version and the frames their kind.
class Versions {
 public:
  Versions(std::string name, const std::function<void(const LoggedFrame&)>& take)
      : name_(std::move(name)), take_(take) {}

  void take(const LoggedFrame& frame) {
    hear(frame);
    if (is_settled_) {
      return give(frame);
    }
    held_.push_back(frame);
    if ((own_ != nullptr && version_) || frame.time_s - held_.front().time_s > kUntold_s) {
      settle();
    }
  }

  void settle() {
    is_settled_ = true;
    for (const LoggedFrame& frame : held_) {
      give(frame);
    }
    held_.clear();
  }

 private:
  void hear(const LoggedFrame& frame) {
    if (!frame.extended || frame.length != 8) {
      return;
    }
    if (own_ == nullptr) {
      // With IMUs or on a bus of its own a machine tells no stroke; its controller tells the kind.
      if (frame.id == dbc::dozer::BladeStroke::kId || frame.id == dbc::dozer::EcuGrade::kId) {
        own_ = &kDozerVersions;
      } else if (frame.id == dbc::excavator::BoomStroke::kId ||
                 frame.id == dbc::excavator::EcuHydraulics::kId) {
        own_ = &kExcavatorVersions;
      }
      judge(frame.line);
    }
    if (frame.id == Identity::kId) {
      const dbc::Count version = Identity::decode(frame.data).dbc_version;
      if (version.state == dbc::RawState::kValid && version_ != version.value) {
        version_ = version.value;
        judge(frame.line);
      }
    }
  }

  void judge(std::size_t line) {
    if (own_ == nullptr || !version_) {
      return;
    }
    if (!is_read(*version_, *own_)) {
      throw std::runtime_error(fmt::format("{}:{}: the controller speaks version {} of the DBC, {}",
                                           name_, line, *version_, read_versions(*own_)));
    }
    is_before_ = *version_ < own_->five_bits;
    if (is_before_ && was_taken_for_own_) {
      throw std::runtime_error(fmt::format(
          "{}:{}: the controller speaks version {} of the DBC, and has said so too late: what came "
          "before was read as version {}",
          name_, line, *version_, own_->own));
    }
  }

  void give(const LoggedFrame& frame) {
    const bool is_status = frame.extended && frame.length == 8 && frame.id == Status::kId;
    if (is_status && is_before_) {
      return take_(of_this_version(frame));
    }
    was_taken_for_own_ = was_taken_for_own_ || (is_status && !version_);
    take_(frame);
  }

  std::string name_;
  const std::function<void(const LoggedFrame&)>& take_;
  std::vector<LoggedFrame> held_;
  const DbcVersions* own_ = nullptr;  ///< Of the log's kind.
  std::optional<std::uint32_t> version_;
  bool is_settled_ = false;
  bool is_before_ = false;
  bool was_taken_for_own_ = false;
};

}  // namespace

std::string read_versions(const DbcVersions& of) {
  return fmt::format("this tool reads versions {} to {}", of.oldest, of.own);
}

LogRead read_versioned(const std::filesystem::path& file,
                       const std::function<void(const LoggedFrame&)>& take) {
  Versions versions(file.string(), take);
  LogRead read = read_candump(file, [&](const LoggedFrame& frame) { versions.take(frame); });
  versions.settle();
  return read;
}

}  // namespace graben::identify
