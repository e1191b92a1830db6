// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the server has to show its pages, whatever it comes from. Everything here is called from
/// the server's thread.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace graben::scope {

/// What one page gets, at its own pace.
class ClientStream {
 public:
  ClientStream() = default;
  ClientStream(const ClientStream&) = delete;
  ClientStream& operator=(const ClientStream&) = delete;
  virtual ~ClientStream() = default;

  /// Appends the next whole candump lines to `message`, at most kMessageMostBytes of them. False,
  /// and nothing appended, if there is none by now.
  [[nodiscard]] virtual bool next(std::string& message) = 0;
  /// Frames that this page has missed, in all.
  [[nodiscard]] virtual std::uint64_t lost() const { return 0; }

  static constexpr std::size_t kMessageMostBytes = 512 * 1024;
};

/// A file as it was when it was opened: what it grows by is not shown.
struct LogFile {
  int file = -1;  ///< Read at an offset by whoever asks.
  std::uint64_t bytes = 0;
};

/// Where on the server a log is, if there is one.
inline constexpr const char* kLogPath = "/log";
/// Where the operator's view is.
inline constexpr const char* kOperatorPath = "/operator";

class Show {
 public:
  Show() = default;
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;
  virtual ~Show() = default;

  /// The first message to every page: JSON of {kind: 'setup'} & Setup (page/src/model/api.ts).
  [[nodiscard]] virtual const std::string& setup() const = 0;
  /// In words, for the terminal.
  [[nodiscard]] virtual std::string words() const = 0;
  [[nodiscard]] virtual std::unique_ptr<ClientStream> open() const = 0;
  /// What pages get at kLogPath; null: nothing is there.
  [[nodiscard]] virtual const LogFile* log() const { return nullptr; }
  /// What the kernel may hold for a page that reads slowly; 0: as it likes.
  [[nodiscard]] virtual int send_buffer_bytes() const { return 0; }
  /// As FrameSource has them.
  [[nodiscard]] virtual std::optional<std::string> control(const nlohmann::json& wish) = 0;
  [[nodiscard]] virtual std::optional<nlohmann::json> state(std::uint64_t& seen) const = 0;
};

/// A candump log in a file, plain or gzip, which is unpacked at the start. Every page gets it by
/// HTTP, as long as it was at the start: a browser takes that seven times as fast as WebSocket
/// messages (tests/scope/browser/hour.mjs).
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
