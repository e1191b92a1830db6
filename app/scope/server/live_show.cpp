// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/live_show.hpp"

#include <utility>

namespace graben::scope {
namespace {

class LiveStream : public ClientStream {
 public:
  explicit LiveStream(const FrameFeed& feed) : reader_(feed) {}

  bool next(std::string& message) override {
    const std::shared_ptr<const FrameBlock> block = reader_.next();
    if (!block) {
      return false;
    }
    message += block->text;
    return true;
  }
  [[nodiscard]] std::uint64_t lost() const override { return reader_.lost(); }

 private:
  FrameReader reader_;
};

std::string setup_of(const FrameSource& source, const nlohmann::json& parts) {
  nlohmann::json setup = parts;
  setup.update(source.setup());
  setup["kind"] = "setup";
  return setup.dump();
}

}  // namespace

LiveShow::LiveShow(FrameSource& source, const nlohmann::json& parts)
    : source_(source), setup_(setup_of(source, parts)) {}

LiveShow::~LiveShow() { stop(); }

void LiveShow::start(std::function<void()> on_change) {
  feed_.on_change(std::move(on_change));
  thread_ = std::thread([this] { run(); });
}

void LiveShow::run() {
  try {
    source_.run(feed_, stop_);
  } catch (...) {
    error_ = std::current_exception();
  }
  ended_ = true;
  feed_.wake();
}

void LiveShow::stop() {
  stop_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void LiveShow::stop_and_rethrow() {
  stop();
  if (error_) {
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

std::unique_ptr<ClientStream> LiveShow::open() const { return std::make_unique<LiveStream>(feed_); }

}  // namespace graben::scope
