// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One page at the other end of a WebSocket: what it is sent next, and what it says.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/scope/server/show.hpp"

namespace graben::scope {

/// What a message to the page holds.
enum class Content : std::uint8_t {
  kJson = 0,   ///< As text.
  kLines = 1,  ///< Of candump; as binary: a page need not look at their encoding.
};

/// What became of a piece of a message from the page.
enum class Received : std::uint8_t {
  kTaken = 0,
  kTooLong = 1,  ///< The connection has to be closed for it.
  kBinary = 2,   ///< The same.
};

/// A piece of a message, as the WebSocket has cut it.
struct Piece {
  std::string_view content;
  bool is_binary = false;
  bool is_last = true;
};

/// Knows no sockets. Holds a bounded amount: of what the page said at most one message, of answers
/// at most kAnswersMost.
class Client {
 public:
  explicit Client(Show& show);

  /// Appends the next message to `buffer`, and says what it is; nothing if there is none by now.
  [[nodiscard]] std::optional<Content> next(std::string& buffer);

  [[nodiscard]] Received receive(const Piece& piece);

  /// False: the page says more than it may, and nothing should be read of it until this is true
  /// again.
  [[nodiscard]] bool may_speak() const { return budget_ > 0 && answers_.size() < kAnswersMost; }
  /// To be called every kTickUs.
  void tick();

  static constexpr std::size_t kMessageMostBytes = 4096;
  static constexpr std::size_t kAnswersMost = 16;
  /// Pieces of messages at once, and how many are given back in a tick: a hundred a second.
  static constexpr int kBudgetMost = 100;
  static constexpr int kBudgetPerTick = 10;

 private:
  /// Why not, if it is refused.
  [[nodiscard]] std::optional<std::string> obey(const std::string& text);
  void refuse(const std::string& why);

  Show& show_;
  std::unique_ptr<ClientStream> stream_;
  bool has_setup_ = false;
  std::uint64_t seen_state_ = 0;
  std::uint64_t told_lost_ = 0;
  std::string heard_;  ///< Of a message that is not whole yet.
  std::deque<std::string> answers_;
  int budget_ = kBudgetMost;
};

}  // namespace graben::scope
