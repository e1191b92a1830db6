// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/candump_reader.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "app/identify/lines.hpp"
#include "app/identify/machine/candump_line.hpp"
#include "app/identify/machine/other_logs.hpp"
#include "app/machines/missing_file.hpp"
#include "app/machines/plain_text.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/can_frame.hpp"

namespace graben::identify {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::runtime_error("SHA-256 is not available");
    }
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string text() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    std::string text;
    for (unsigned int at = 0; at < size; ++at) {
      text += fmt::format("{:02x}", digest[at]);
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

/// The id that one of our DBCs has for the same PGN and source, if any has.
std::uint32_t own_id(std::uint32_t id) {
  static const std::unordered_map<std::uint32_t, std::uint32_t> known = [] {
    std::unordered_map<std::uint32_t, std::uint32_t> ids;
    for (const dbc::MessageInfo& message : dbc::excavator::kMessages) {
      ids.emplace(identity_of(message.id), message.id);
    }
    for (const dbc::MessageInfo& message : dbc::dozer::kMessages) {
      ids.emplace(identity_of(message.id), message.id);
    }
    return ids;
  }();
  const auto found = known.find(identity_of(id));
  return found == known.end() ? id : found->second;
}

[[noreturn]] void refuse(const std::string& where, const std::string& line) {
  throw std::runtime_error(
      fmt::format("{}: \"{}\" is not a line of candump -L, \"(seconds) interface id#data\"", where,
                  line.substr(0, 60)));
}

std::string plural(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

}  // namespace

std::vector<std::string> LogRead::notes() const {
  std::vector<std::string> notes;
  const auto say = [&](const std::string& what) { notes.push_back(name + ": " + what); };
  if (lost > 0) {
    say(fmt::format("{} lost as it was recorded (DROPCOUNT)",
                    plural(lost, "frame was", "frames were")));
  }
  if (broken > 0) {
    say(fmt::format("{} of {}'s, left out; the first is line {}",
                    plural(broken, "line is none", "lines are none"), format, first_broken));
  }
  if (is_cut) {
    say("its last line is cut, and left out");
  }
  constexpr std::size_t kNamed = 3;
  for (std::size_t i = 0; i < std::min(breaks.size(), kNamed); ++i) {
    const ClockBreak& at = breaks[i];
    say(at.by_s > 0.0
            ? fmt::format("a gap of {:.2f} s before line {}; its pieces are counted apart", at.by_s,
                          at.line)
            : fmt::format(
                  "its clock goes back by {:.2f} s at line {}; its pieces are counted apart",
                  -at.by_s, at.line));
  }
  if (breaks.size() > kNamed) {
    say(fmt::format("{} gaps and steps of its clock in all", breaks.size()));
  }
  if (disordered > 0) {
    say(fmt::format("{} a stamp before that of the frame before, and {} its stamp",
                    plural(disordered, "frame had", "frames had"),
                    disordered == 1 ? "has" : "have"));
  }
  if (garbled > 0) {
    say(fmt::format("{} left out, whose stamp fits no other",
                    plural(garbled, "frame is", "frames are")));
  }
  return notes;
}

namespace {

/// Counts what comes, and hands frames on by the log's clock.
class Reading {
 public:
  Reading(const std::filesystem::path& file, const std::function<void(const LoggedFrame&)>& take)
      : count_([this, &take](const LoggedFrame& frame) {
          ++read_.frames;
          take(frame);
        }),
        clock_(count_) {
    read_.name = file.string();
  }
  ~Reading() = default;
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  void name_format(const char* format) { read_.format = format; }

  void take(std::size_t number, const CandumpLine& line) {
    whole_ += line.kind == LineKind::kLost ? 0 : 1;
    read_.lost += line.lost;
    read_.other += line.kind == LineKind::kOther ? 1 : 0;
    if (line.kind == LineKind::kFrame) {
      LoggedFrame frame{number, line.time_s, line.id, line.extended, line.length, line.data};
      frame.id = line.extended ? own_id(line.id) : line.id;
      clock_.judge(frame);
    }
  }

  void take_broken(std::size_t number, const std::string& line, bool is_whole) {
    if (first_broken_.empty()) {
      first_broken_ = line;
      read_.first_broken = number;
    }
    read_.broken += is_whole ? 1 : 0;
    read_.is_cut = read_.is_cut || !is_whole;
  }

  LogRead end(std::string sha256) {
    clock_.end();
    if (read_.broken > whole_ || (read_.is_cut && whole_ == 0)) {
      refuse(fmt::format("{}:{}", read_.name, read_.first_broken), first_broken_);
    }
    read_.sha256 = std::move(sha256);
    read_.breaks = clock_.breaks();
    read_.disordered = clock_.disordered();
    read_.garbled = clock_.garbled();
    return read_;
  }

 private:
  LogRead read_;
  LogClock::Take count_;
  LogClock clock_;
  std::string first_broken_;
  std::size_t whole_ = 0;
};

/// The file's first bytes, unpacked or not; none where it can't be read, which is told later.
std::string begin_of(const std::filesystem::path& file) {
  constexpr std::size_t kBegin = 16;
  std::string begin(kBegin, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return begin;
}

LogRead read_binary(const std::filesystem::path& file, Reading& reading) {
  const std::string bytes = machines::file_text(file, machines::kWantedLog);
  reading.name_format("BLF");
  Sha256 digest;
  digest.add(bytes);
  const std::string wrong = read_blf(
      bytes, [&](std::size_t number, const CandumpLine& line) { reading.take(number, line); });
  if (!wrong.empty()) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), wrong));
  }
  return reading.end(digest.text());
}

}  // namespace

LogRead read_candump(const std::filesystem::path& file,
                     const std::function<void(const LoggedFrame&)>& take) {
  Reading reading(file, take);
  const std::string begin = begin_of(file);
  if (const std::string what = foreign_log(begin); !what.empty()) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
  }
  if (is_blf(begin)) {
    return read_binary(file, reading);
  }
  Lines lines(file.string(), machines::kWantedLog);
  std::optional<LogText> text;
  Sha256 digest;
  std::string line;
  while (lines.next(line)) {
    digest.add(line);
    digest.add("\n");
    if (line.empty()) {
      continue;
    }
    if (!text) {
      text.emplace(line);
      reading.name_format(text->format());
    }
    const CandumpLine got = text->parse(line);
    if (got.kind == LineKind::kBroken) {
      reading.take_broken(lines.number(), line, lines.is_whole());
    } else {
      reading.take(lines.number(), got);
    }
  }
  return reading.end(digest.text());
}

bool is_other_log(const std::filesystem::path& file) {
  if (is_blf(begin_of(file))) {
    return true;
  }
  Lines lines(file.string(), machines::kWantedLog);
  std::string line;
  while (lines.next(line)) {
    if (!line.empty()) {
      return !LogText(line).is_candump();
    }
  }
  return false;
}

std::string candump_text(const std::filesystem::path& file, LogRead* read) {
  std::string text;
  LogRead whole = read_candump(file, [&](const LoggedFrame& frame) {
    text += fmt::format(frame.extended ? "({:.6f}) can0 {:08X}#" : "({:.6f}) can0 {:03X}#",
                        frame.time_s, frame.id);
    for (unsigned i = 0; i < frame.length; ++i) {
      text += fmt::format("{:02X}", frame.data[i]);
    }
    text += '\n';
  });
  if (read != nullptr) {
    *read = std::move(whole);
  }
  return text;
}

}  // namespace graben::identify
