// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/candump_reader.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <charconv>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "app/identify/lines.hpp"
#include "app/machines/missing_file.hpp"

namespace graben::identify {
namespace {

/// How can-utils mark what is a report of the bus controller: CAN_ERR_FLAG.
constexpr std::uint32_t kErrorFlag = 0x20000000U;
constexpr std::size_t kExtendedDigits = 8;

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

std::string_view next_word(std::string_view& rest) {
  const std::size_t from = std::min(rest.find_first_not_of(' '), rest.size());
  rest.remove_prefix(from);
  const std::size_t until = std::min(rest.find(' '), rest.size());
  const std::string_view word = rest.substr(0, until);
  rest.remove_prefix(until);
  return word;
}

template <class Number>
bool read(std::string_view text, Number& number, int base) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc() && end == text.data() + text.size();
}

/// "(1700000000.123456)" as seconds.
bool read_time(std::string_view text, double& time_s) {
  if (text.size() < 4 || text.front() != '(' || text.back() != ')') {
    return false;
  }
  text = text.substr(1, text.size() - 2);
  const std::size_t point = text.find('.');
  std::int64_t seconds = 0;
  std::int64_t micros = 0;
  if (point == std::string_view::npos || text.size() - point - 1 != 6 ||
      !read(text.substr(0, point), seconds, 10) || !read(text.substr(point + 1), micros, 10) ||
      seconds < 0 || micros < 0) {
    return false;
  }
  time_s = static_cast<double>(seconds) + 1e-6 * static_cast<double>(micros);
  return true;
}

enum class Kind { kData, kOther, kBroken };

/// "0CFF2080#00112233": id and data.
Kind read_frame(std::string_view text, LoggedFrame& frame) {
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos || !read(text.substr(0, hash), frame.id, 16)) {
    return Kind::kBroken;
  }
  frame.extended = hash == kExtendedDigits;
  const std::string_view data = text.substr(hash + 1);
  if ((frame.extended && (frame.id & kErrorFlag) != 0U) || (!data.empty() && data[0] == 'R') ||
      (!data.empty() && data[0] == '#')) {
    return Kind::kOther;
  }
  if (data.size() % 2 != 0 || data.size() > 2 * frame.data.size()) {
    return Kind::kBroken;
  }
  frame.length = static_cast<std::uint8_t>(data.size() / 2);
  for (std::size_t at = 0; at < frame.length; ++at) {
    if (!read(data.substr(2 * at, 2), frame.data[at], 16)) {
      return Kind::kBroken;
    }
  }
  return Kind::kData;
}

}  // namespace

std::string read_candump(const std::filesystem::path& file,
                         const std::function<void(const LoggedFrame&)>& take, CutLine cut) {
  Lines lines(file.string(), machines::kWantedLog);
  Sha256 digest;
  std::string line;
  LoggedFrame frame;
  while (lines.next(line)) {
    digest.add(line);
    digest.add("\n");
    if (line.empty()) {
      continue;
    }
    frame.line = lines.number();
    std::string_view rest(line);
    Kind kind = Kind::kBroken;
    if (read_time(next_word(rest), frame.time_s)) {
      next_word(rest);  // The interface: several may be in one log.
      kind = read_frame(next_word(rest), frame);
    }
    if (kind == Kind::kBroken && cut == CutLine::kPassedOver && !lines.is_whole()) {
      break;
    }
    if (kind == Kind::kBroken) {
      throw std::runtime_error(
          fmt::format("{}: \"{}\" is not a line of candump -L, \"(seconds) interface id#data\"",
                      lines.where(), line.substr(0, 60)));
    }
    if (kind == Kind::kData) {
      take(frame);
    }
  }
  return digest.text();
}

}  // namespace graben::identify
