// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/candump_reader.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "app/identify/lines.hpp"
#include "app/identify/machine/candump_line.hpp"
#include "app/machines/missing_file.hpp"
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
    say(fmt::format("{} of candump's, left out; the first is line {}",
                    plural(broken, "line is none", "lines are none"), first_broken));
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

LogRead read_candump(const std::filesystem::path& file,
                     const std::function<void(const LoggedFrame&)>& take) {
  LogRead read;
  read.name = file.string();
  const LogClock::Take count = [&](const LoggedFrame& frame) {
    ++read.frames;
    take(frame);
  };
  LogClock clock(count);
  Lines lines(file.string(), machines::kWantedLog);
  Sha256 digest;
  std::string line;
  std::string first_broken;
  std::size_t whole = 0;
  while (lines.next(line)) {
    digest.add(line);
    digest.add("\n");
    const CandumpLine got = line.empty() ? CandumpLine{LineKind::kOther} : parse_candump(line);
    if (line.empty()) {
      continue;
    }
    if (got.kind == LineKind::kBroken && !lines.is_whole()) {
      read.is_cut = true;
      first_broken = first_broken.empty() ? line : first_broken;
      continue;
    }
    if (got.kind == LineKind::kBroken) {
      if (read.broken++ == 0) {
        read.first_broken = lines.number();
        first_broken = line;
      }
      continue;
    }
    whole += got.kind == LineKind::kLost ? 0 : 1;
    read.lost += got.lost;
    read.other += got.kind == LineKind::kOther ? 1 : 0;
    if (got.kind == LineKind::kFrame) {
      LoggedFrame frame{lines.number(), got.time_s, got.id, got.extended, got.length, got.data};
      frame.id = got.extended ? own_id(got.id) : got.id;
      clock.judge(frame);
    }
  }
  clock.end();
  if (read.broken > whole || (read.is_cut && whole == 0)) {
    refuse(fmt::format("{}:{}", file.string(), std::max<std::size_t>(1, read.first_broken)),
           first_broken);
  }
  read.sha256 = digest.text();
  read.breaks = clock.breaks();
  read.disordered = clock.disordered();
  read.garbled = clock.garbled();
  return read;
}

}  // namespace graben::identify
