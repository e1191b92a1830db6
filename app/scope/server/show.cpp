// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/show.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <regex>
#include <stdexcept>
#include <vector>

#include "app/identify/machine/candump_reader.hpp"
#include "app/machines/missing_file.hpp"

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

constexpr std::size_t kPieceBytes = 1U << 18U;

/// What is packed, in a file without a name; `file` is closed. Pages are told how much comes, and
/// that is not in what gzip writes.
int unpacked(const std::filesystem::path& name, int file) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> in(gzdopen(file, "rb"), gzclose);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::tmpfile(), std::fclose);
  if (!in || !out) {
    fail(name, std::strerror(errno));
  }
  std::vector<char> piece(kPieceBytes);
  int got = 0;
  while ((got = gzread(in.get(), piece.data(), static_cast<unsigned>(piece.size()))) > 0) {
    if (std::fwrite(piece.data(), 1, static_cast<std::size_t>(got), out.get()) !=
        static_cast<std::size_t>(got)) {
      fail(name, std::strerror(errno));
    }
  }
  int error = Z_OK;
  gzerror(in.get(), &error);
  if (error != Z_OK) {
    fail(name, "is cut off or damaged (gzip)");
  }
  if (std::fflush(out.get()) != 0) {
    fail(name, std::strerror(errno));
  }
  return fcntl(fileno(out.get()), F_DUPFD_CLOEXEC, 0);
}

/// A log of another tool as candump's lines, which the page reads, in a file without a name.
int turned(const std::filesystem::path& name) {
  identify::LogRead read;
  const std::string text = identify::candump_text(name, &read);
  for (const std::string& note : read.notes()) {
    fmt::print(stderr, "note: {}\n", note);  // The page is given whole lines only.
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::tmpfile(), std::fclose);
  if (!out || std::fwrite(text.data(), 1, text.size(), out.get()) != text.size() ||
      std::fflush(out.get()) != 0) {
    fail(name, std::strerror(errno));
  }
  return fcntl(fileno(out.get()), F_DUPFD_CLOEXEC, 0);
}

bool is_packed(int file) {
  std::array<unsigned char, 2> begin{};
  return pread(file, begin.data(), begin.size(), 0) == 2 && begin[0] == 0x1f && begin[1] == 0x8b;
}

/// A section or a key before anything that begins as a frame does: what the page can't judge better
/// is said here already.
bool reads_like_toml(int file) {
  std::string head(4096, '\0');
  const ssize_t got = pread(file, head.data(), head.size(), 0);
  head.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  static const std::regex kLine(R"((^|\n)[ \t]*(\[\[?[\w.-]+\]\]?|[\w."-]+[ \t]*=[^\n]))");
  static const std::regex kFrame(R"((^|\n)[ \t]*\()");
  return std::regex_search(head, kLine) && !std::regex_search(head, kFrame);
}

/// Throws where it is no log; closed by whoever has it.
LogFile open_log(const std::filesystem::path& name) {
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
  const int file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    throw std::runtime_error(machines::unread_text(name, machines::kWantedLog));
  }
  struct stat status {};
  const char* problem = nullptr;
  if (fstat(file, &status) != 0) {
    problem = std::strerror(errno);
  } else if (S_ISDIR(status.st_mode)) {
    close(file);
    throw std::runtime_error(machines::unread_text(name, machines::kWantedLog));
  } else if (!S_ISREG(status.st_mode)) {
    problem = "is no regular file; what is sent through it can be written to one first";
  } else if (status.st_size == 0) {
    problem = "is empty";
  }
  if (problem != nullptr) {
    close(file);
    fail(name, problem);
  }
  if (reads_like_toml(file)) {
    close(file);
    fail(name,
         fmt::format("reads like TOML, as a profile or a task; wanted: {}", machines::kWantedLog)
             .c_str());
  }
  if (!is_packed(file) && !identify::is_other_log(name)) {
    return {file, static_cast<std::uint64_t>(status.st_size)};
  }
  const int whole = identify::is_other_log(name) ? turned(name) : unpacked(name, file);
  if (whole < 0 || fstat(whole, &status) != 0) {
    fail(name, std::strerror(errno));
  }
  return {whole, static_cast<std::uint64_t>(status.st_size)};
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
