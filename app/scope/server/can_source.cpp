// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/can_source.hpp"

#include <fmt/format.h>
#include <net/if.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <stdexcept>
#include <thread>

namespace graben::scope {
namespace {

/// A full bus of 1 Mbit/s brings some 80 frames in this time, which every socket has room for; to
/// be woken for each would cost more than all the rest.
constexpr auto kHearPeriod = std::chrono::milliseconds(10);
constexpr int kFlushEvery = 4;
/// Opening may wait for the kernel; nothing of it is urgent.
constexpr int kOpenEvery = 50;
/// So that lost frames are told as they come, but not each.
constexpr int kTellEvery = 50;
static_assert(kFlushPeriodUs == kFlushEvery * 10 * kMillisecondUs);

TimeUs wall_now_us() {
  timespec now{};
  static_cast<void>(clock_gettime(CLOCK_REALTIME, &now));
  return TimeUs{now.tv_sec} * kSecondUs + now.tv_nsec / 1000;
}

std::string words_of(const CanListener& listener) {
  std::string words = listener.is_open()
                          ? listener.interface() + ": heard"
                          : fmt::format("{}; tried again every half second", listener.last_error());
  if (listener.lost() > 0) {
    words += fmt::format("; the kernel had no room for {} frames of it", listener.lost());
  }
  return words;
}

nlohmann::json state_of(const std::vector<CanListener>& listeners) {
  std::vector<std::string> words;
  words.reserve(listeners.size());
  for (const CanListener& listener : listeners) {
    words.push_back(words_of(listener));
  }
  const bool all_up = std::all_of(listeners.begin(), listeners.end(),
                                  [](const CanListener& listener) { return listener.is_open(); });
  return {{"kind", "bus"}, {"up", all_up}, {"words", fmt::format("{}", fmt::join(words, "; "))}};
}

}  // namespace

CanSource::CanSource(const std::vector<std::string>& interfaces, int bitrate_bps,
                     CanListener::Opener opener)
    : name_(fmt::format("{}", fmt::join(interfaces, ", "))), bitrate_bps_(bitrate_bps) {
  if (interfaces.empty()) {
    throw std::runtime_error("no CAN interface is named");
  }
  for (const std::string& interface : interfaces) {
    if (std::count(interfaces.begin(), interfaces.end(), interface) > 1) {
      throw std::runtime_error(fmt::format("CAN interface '{}' is named twice", interface));
    }
    listeners_.emplace_back(interface, opener);
    // One that is down is there all the same.
    if (!listeners_.back().open() && if_nametoindex(interface.c_str()) == 0) {
      throw std::runtime_error(listeners_.back().last_error());
    }
  }
  state_ = state_of(listeners_);
}

nlohmann::json CanSource::setup() const {
  return {{"source", {{"mode", "can"}, {"name", name_}, {"bitrate", bitrate_bps_}}}};
}

void CanSource::run(FrameFeed& feed, const std::atomic<bool>& stop) {
  auto next = std::chrono::steady_clock::now();
  for (int turn = 0; !stop; ++turn) {
    hear(feed);
    if (turn % kFlushEvery == 0) {
      feed.flush();
    }
    if (turn % kOpenEvery == 0) {
      open_what_is_closed();
    }
    if (turn % kTellEvery == 0) {
      tell_state(feed);
    }
    // Behind after a pause of the whole machine: goes on from now.
    next = std::max(next + kHearPeriod, std::chrono::steady_clock::now() - kHearPeriod);
    std::this_thread::sleep_until(next);
  }
}

/// Interfaces are heard one after the other: what comes meanwhile waits for the next turn, so that
/// the stamps rise over all of them.
void CanSource::hear(FrameFeed& feed) {
  const TimeUs begin_us = wall_now_us();
  const auto waited = static_cast<std::ptrdiff_t>(heard_.size());
  for (CanListener& listener : listeners_) {
    listener.hear([&](const CanFrame& frame) { heard_.push_back({frame, &listener}); });
  }
  const auto end = std::stable_partition(
      heard_.begin() + waited, heard_.end(),
      [begin_us](const Heard& heard) { return heard.frame.stamp_us <= begin_us; });
  std::stable_sort(heard_.begin(), end, [](const Heard& a, const Heard& b) {
    return a.frame.stamp_us < b.frame.stamp_us;
  });
  for (auto heard = heard_.begin(); heard != end; ++heard) {
    feed.append(heard->frame, heard->frame.stamp_us, heard->from->interface());
  }
  heard_.erase(heard_.begin(), end);
}

void CanSource::open_what_is_closed() {
  for (CanListener& listener : listeners_) {
    if (!listener.is_open()) {
      // Still away: tried again in a moment.
      static_cast<void>(listener.open());
    }
  }
}

void CanSource::tell_state(const FrameFeed& feed) {
  nlohmann::json state = state_of(listeners_);
  {
    const std::lock_guard lock(mutex_);
    if (state == state_) {
      return;
    }
    state_ = std::move(state);
    ++revision_;
  }
  feed.wake();
}

std::optional<nlohmann::json> CanSource::state(std::uint64_t& seen) const {
  const std::lock_guard lock(mutex_);
  if (seen == revision_) {
    return std::nullopt;
  }
  seen = revision_;
  return state_;
}

}  // namespace graben::scope
