// SPDX-License-Identifier: Apache-2.0
#include "platform/loopback/candump_log.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace graben {
namespace {
/// How can-utils mark what is a report of the bus controller: CAN_ERR_FLAG.
constexpr std::uint32_t kErrorFlag = 0x20000000U;

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), std::strerror(error)));
}

/// Where to write until it is whole: beside a file, but straight into what is none, which a rename
/// would replace.
std::filesystem::path part_of(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::symlink_status(file, ignored);
  const bool replaceable =
      !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
  return replaceable ? std::filesystem::path(file.string() + ".part") : file;
}

/// Takes away what follows the last whole line.
void end_with_a_line(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::uintmax_t whole = 0;
  std::uintmax_t size = 0;
  for (std::string line; std::getline(stream, line);) {
    size += line.size() + (stream.eof() ? 0 : 1);
    whole = stream.eof() ? whole : size;
  }
  if (size > whole) {
    std::filesystem::resize_file(file, whole);
  }
}

std::FILE* open_stream(const std::filesystem::path& file, CandumpLog::Form form) {
  if (form == CandumpLog::Form::kWhole) {
    return std::fopen(file.c_str(), "w");
  }
  if (std::filesystem::is_regular_file(file)) {
    end_with_a_line(file);
  }
  return std::fopen(file.c_str(), "a");
}
}  // namespace

std::string candump_line(const CanFrame& frame, TimeUs now_us, const std::string& interface_name) {
  // Compiled, and one call a line: a simulation spent a fifth of its time here when every byte took
  // one.
  std::string line = fmt::format(FMT_COMPILE("({:010d}.{:06d}) {} "), now_us / kSecondUs,
                                 now_us % kSecondUs, interface_name);
  const std::uint32_t id = frame.error ? frame.id | kErrorFlag : frame.id;
  line += frame.extended || frame.error ? fmt::format(FMT_COMPILE("{:08X}#"), id)
                                        : fmt::format(FMT_COMPILE("{:03X}#"), id);
  if (frame.remote) {
    return line + "R";
  }
  constexpr char kDigits[] = "0123456789ABCDEF";
  for (unsigned i = 0; i < frame.length && i < frame.data.size(); ++i) {
    line += kDigits[frame.data[i] >> 4U];
    line += kDigits[frame.data[i] & 15U];
  }
  return line;
}

CandumpLog::CandumpLog(const std::filesystem::path& file, std::string interface_name, Form form)
    : file_(file),
      part_(form == Form::kGrows ? file : part_of(file)),
      interface_name_(std::move(interface_name)),
      stream_(open_stream(part_, form)) {
  if (stream_ == nullptr) {
    fail(file_, errno);
  }
}

CandumpLog::~CandumpLog() {
  if (stream_ != nullptr) {
    std::fclose(stream_);
    if (part_ != file_) {
      std::error_code ignored;
      std::filesystem::remove(part_, ignored);
    }
  }
}

void CandumpLog::write(const CanFrame& frame, TimeUs now_us) {
  const std::string line = candump_line(frame, now_us, interface_name_) + "\n";
  if (std::fwrite(line.data(), 1, line.size(), stream_) != line.size()) {
    fail(file_, errno);
  }
}

void CandumpLog::flush() {
  if (std::fflush(stream_) != 0) {
    fail(file_, errno);
  }
}

void CandumpLog::close() {
  if (std::fclose(std::exchange(stream_, nullptr)) != 0) {
    fail(file_, errno);
  }
  if (part_ != file_) {
    std::filesystem::rename(part_, file_);
  }
}

}  // namespace graben
