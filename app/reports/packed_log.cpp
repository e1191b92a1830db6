// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <cerrno>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "app/identify/machine/candump_reader.hpp"
#include "app/reports/report_file.hpp"

namespace graben::reports {
namespace {

constexpr int kLargestWindow = 15;
constexpr int kGzip = 16;  ///< Added to the window's bits: gzip's header, not zlib's.
constexpr int kMemoryLevel = 8;
/// A log shrinks by 5 at this level and by 6 at the slowest, which takes four times as long.
constexpr int kLevel = 5;

[[noreturn]] void fail(const char* step) {
  throw std::runtime_error(std::string("a log cannot be packed: zlib's ") + step + " failed");
}

std::vector<std::uint8_t> gzip(std::string_view text) {
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kLargestWindow + kGzip, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    fail("deflateInit2");
  }
  std::vector<std::uint8_t> packed(deflateBound(&stream, text.size()));
  // zlib takes neither const nor more than an unsigned int at a time.
  auto* from = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  std::size_t left = text.size();
  std::size_t written = 0;
  int result = Z_OK;
  while (result == Z_OK) {
    constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
    const std::size_t in = left < kMost ? left : kMost;
    const std::size_t room = packed.size() - written;
    const std::size_t out = room < kMost ? room : kMost;
    stream.next_in = from;
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = packed.data() + written;
    stream.avail_out = static_cast<uInt>(out);
    result = deflate(&stream, in == left ? Z_FINISH : Z_NO_FLUSH);
    from += in - stream.avail_in;
    left -= in - stream.avail_in;
    written += out - stream.avail_out;
  }
  deflateEnd(&stream);
  if (result != Z_STREAM_END) {
    fail("deflate");
  }
  packed.resize(written);
  return packed;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? bytes[i + k] : 0U);
    }
    for (unsigned k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace

std::string packed(std::string_view text) { return base64(gzip(text)); }

std::string packed_file(const std::filesystem::path& file) {
  if (identify::is_other_log(file)) {
    return packed(identify::candump_text(file));
  }
  const std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> in(gzopen(file.c_str(), "rb"), gzclose);
  if (!in) {
    throw std::runtime_error(file.string() + ": " + std::generic_category().message(errno));
  }
  std::string text;
  std::vector<char> part(1U << 16U);
  int got = 1;
  while ((got = gzread(in.get(), part.data(), static_cast<unsigned>(part.size()))) > 0) {
    text.append(part.data(), static_cast<std::size_t>(got));
  }
  if (got < 0) {
    throw std::runtime_error(file.string() + ": can't be read");
  }
  return packed(text);
}

}  // namespace graben::reports
