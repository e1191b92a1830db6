// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace graben::scope {
namespace {

using nlohmann::json;

/// Whatever bytes it holds.
std::string text_of(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

Content add(std::string& buffer, const std::string& message) {
  buffer += message;
  return Content::kJson;
}

}  // namespace

Client::Client(Show& show) : show_(show), stream_(show.open()) {}

std::optional<Content> Client::next(std::string& buffer) {
  if (!std::exchange(has_setup_, true)) {
    return add(buffer, show_.setup());
  }
  if (!answers_.empty()) {
    const std::string answer = std::move(answers_.front());
    answers_.pop_front();
    return add(buffer, answer);
  }
  if (const std::optional<json> state = show_.state(seen_state_)) {
    return add(buffer, text_of(*state));
  }
  if (const std::uint64_t lost = stream_->lost(); lost != told_lost_) {
    told_lost_ = lost;
    return add(buffer, fmt::format(R"({{"kind":"dropped","frames":{}}})", lost));
  }
  if (stream_->next(buffer)) {
    return Content::kLines;
  }
  return std::nullopt;
}

Received Client::receive(const Piece& piece) {
  budget_ -= 1;
  if (piece.is_binary) {
    return Received::kBinary;
  }
  if (heard_.size() + piece.content.size() > kMessageMostBytes) {
    return Received::kTooLong;
  }
  heard_ += piece.content;
  if (piece.is_last) {
    if (const std::optional<std::string> why = obey(heard_)) {
      refuse(*why);
    }
    heard_.clear();
  }
  return Received::kTaken;
}

std::optional<std::string> Client::obey(const std::string& text) {
  const json wish = json::parse(text, nullptr, false);
  if (wish.is_discarded()) {
    return "this is not JSON";
  }
  if (!wish.is_object()) {
    return R"(this is no object, such as {"do": "stop"})";
  }
  try {
    return show_.control(wish);
  } catch (const json::out_of_range&) {
    return "a value is missing";
  } catch (const json::exception&) {
    return "a value is of another kind than it has to be";
  }
}

void Client::refuse(const std::string& why) {
  answers_.push_back(text_of({{"kind", "refused"}, {"why", why}}));
}

void Client::tick() { budget_ = std::min(budget_ + kBudgetPerTick, kBudgetMost); }

}  // namespace graben::scope
