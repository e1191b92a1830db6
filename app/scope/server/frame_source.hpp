// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the frames come from that the scope shows as they come: a bus, or a simulation.

#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/scope/server/frame_feed.hpp"

namespace graben::scope {

/// run() has a thread of its own; everything else is called from the server's, also while run() is
/// at work: what both touch is the source's to guard. Only run() may take long.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  /// What of `Setup` (page/src/model/api.ts) is the source's: {"source": {...}}, and of a
  /// simulation "sim": {...} as well. Asked once, before run().
  [[nodiscard]] virtual nlohmann::json setup() const = 0;

  /// What is shown, in words for the terminal: "simulated dig".
  [[nodiscard]] virtual std::string words() const = 0;

  /// Feeds frames until `stop`; then returns within 100 ms. What it throws ends the server with
  /// that message.
  virtual void run(FrameFeed& feed, const std::atomic<bool>& stop) = 0;

  /// Does what a page asks (`ToServer`), an object of at most 4 KiB that holds anything. Why not,
  /// in words for the page, if it is refused. Must not wait for run().
  [[nodiscard]] virtual std::optional<std::string> control(const nlohmann::json& /*wish*/) {
    return "this is not a simulation: it is only watched";
  }

  /// A message for every page (`FromServer`: {"kind": "sim" | "bus", ...}) if the state has changed
  /// since `seen`, which then becomes its revision. Revisions begin at 1, and a page that has just
  /// connected asks with 0. After a change the source calls FrameFeed::wake().
  [[nodiscard]] virtual std::optional<nlohmann::json> state(std::uint64_t& /*seen*/) const {
    return std::nullopt;
  }
};

}  // namespace graben::scope
