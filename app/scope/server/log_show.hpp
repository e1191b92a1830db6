#pragma once
/// A candump log in a file. Every page gets it by HTTP, as long as it was at the start: a browser
/// takes that seven times as fast as WebSocket messages (tests/scope/browser/hour.mjs).

#include <filesystem>
#include <string>

#include "app/scope/server/show.hpp"

namespace graben::scope {

class LogShow : public Show {
 public:
  /// `parts`: what of Setup is the same for every source. Throws std::runtime_error that names the
  /// file, if it is not there, no file, or empty. What is in it, the page judges; what it grows by
  /// from here on is not shown.
  LogShow(const std::filesystem::path& file, int bitrate_bps, const nlohmann::json& parts);
  ~LogShow() override;

  [[nodiscard]] const std::string& setup() const override { return setup_; }
  [[nodiscard]] std::string words() const override { return "log " + name_; }
  [[nodiscard]] std::unique_ptr<ClientStream> open() const override;
  [[nodiscard]] const LogFile* log() const override { return &log_; }
  [[nodiscard]] std::optional<std::string> control(const nlohmann::json& /*wish*/) override {
    return "this is a log: it can only be looked at";
  }
  [[nodiscard]] std::optional<nlohmann::json> state(std::uint64_t& /*seen*/) const override {
    return std::nullopt;
  }

 private:
  std::string name_;
  LogFile log_;
  std::string setup_;
};

}  // namespace graben::scope
