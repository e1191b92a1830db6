#include "app/scope/log_show.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace graben::scope {
namespace {

/// Read, not mapped: a file that somebody makes shorter would end a process that has it mapped. A
/// chunk costs the same one copy either way.
class LogStream : public ClientStream {
 public:
  LogStream(int file, std::uint64_t bytes) : file_(file), bytes_(bytes) {}

  bool next(std::string& message) override {
    if (ended()) {
      return false;
    }
    const std::size_t before = message.size();
    const std::size_t wanted =
        static_cast<std::size_t>(std::min<std::uint64_t>(kMessageMostBytes, bytes_ - offset_));
    message.resize(before + wanted);
    const std::size_t got = read_at(message.data() + before, wanted);
    // Shorter than it was: all that there is was given.
    bytes_ = got < wanted ? offset_ + got : bytes_;
    const std::size_t kept = whole_lines(message.data() + before, got);
    message.resize(before + kept);
    offset_ += kept;
    return kept > 0;
  }
  [[nodiscard]] bool ended() const override { return offset_ == bytes_; }

 private:
  std::size_t read_at(char* to, std::size_t wanted) const {
    std::size_t got = 0;
    while (got < wanted) {
      const ssize_t count = pread(file_, to + got, wanted - got, static_cast<off_t>(offset_ + got));
      if (count < 0 && errno == EINTR) {
        continue;
      }
      if (count <= 0) {
        break;
      }
      got += static_cast<std::size_t>(count);
    }
    return got;
  }

  /// Up to the last line end; all of it at the file's end, or where no line ends at all.
  [[nodiscard]] std::size_t whole_lines(const char* text, std::size_t size) const {
    if (offset_ + size == bytes_) {
      return size;
    }
    const void* end = memrchr(text, '\n', size);
    return end == nullptr ? size
                          : static_cast<std::size_t>(static_cast<const char*>(end) - text) + 1;
  }

  int file_;
  std::uint64_t bytes_;
  std::uint64_t offset_ = 0;
};

[[noreturn]] void fail(const std::filesystem::path& file, const char* why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

/// Closed by whoever opened it, if it is not a log.
std::uint64_t log_size(int file, const std::filesystem::path& name) {
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
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace

LogShow::LogShow(const std::filesystem::path& file, int bitrate_bps, const nlohmann::json& parts)
    // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
    : name_(file.filename().string()),
      file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (file_ < 0) {
    fail(file, std::strerror(errno));
  }
  bytes_ = log_size(file_, file);
  nlohmann::json setup = parts;
  setup["kind"] = "setup";
  setup["source"] = {{"mode", "log"}, {"name", name_}, {"bytes", bytes_}, {"bitrate", bitrate_bps}};
  // A file's name need not be UTF-8.
  setup_ = setup.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

LogShow::~LogShow() { close(file_); }

std::unique_ptr<ClientStream> LogShow::open() const {
  return std::make_unique<LogStream>(file_, bytes_);
}

}  // namespace graben::scope
