// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/show.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace graben::scope {
namespace {

/// Nothing comes over the WebSocket: the page gets the file itself.
class NoStream : public ClientStream {
 public:
  [[nodiscard]] bool next(std::string& /*message*/) override { return false; }
};

[[noreturn]] void fail(const std::filesystem::path& file, const char* why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

/// Throws where it is no log; closed by whoever has it.
LogFile open_log(const std::filesystem::path& name) {
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
  const int file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    fail(name, std::strerror(errno));
  }
  struct stat status {};
  const char* problem = nullptr;
  if (fstat(file, &status) != 0) {
    problem = std::strerror(errno);
  } else if (S_ISDIR(status.st_mode)) {
    problem = "is a folder, not a log";
  } else if (!S_ISREG(status.st_mode)) {
    problem = "is no regular file; what is sent through it can be written to one first";
  } else if (status.st_size == 0) {
    problem = "is empty";
  }
  if (problem != nullptr) {
    close(file);
    fail(name, problem);
  }
  return {file, static_cast<std::uint64_t>(status.st_size)};
}

}  // namespace

LogShow::LogShow(const std::filesystem::path& file, int bitrate_bps, const nlohmann::json& parts)
    : name_(file.filename().string()), log_(open_log(file)) {
  nlohmann::json setup = parts;
  setup["kind"] = "setup";
  setup["source"] = {{"mode", "log"},
                     {"name", name_},
                     {"bytes", log_.bytes},
                     {"get", kLogPath},
                     {"bitrate", bitrate_bps}};
  // A file's name need not be UTF-8.
  setup_ = setup.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

LogShow::~LogShow() { close(log_.file); }

std::unique_ptr<ClientStream> LogShow::open() const { return std::make_unique<NoStream>(); }

}  // namespace graben::scope
