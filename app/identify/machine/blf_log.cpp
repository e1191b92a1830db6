// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "app/identify/machine/other_logs.hpp"

namespace graben::identify {
namespace {

constexpr std::string_view kFile = "LOGG";
constexpr std::string_view kObject = "LOBJ";
constexpr std::size_t kBaseHeader = 16;
constexpr std::size_t kContainerHeader = 16;
/// Of one container; writers fill 128 KiB.
constexpr std::size_t kMostUnpacked = 64U << 20U;

constexpr unsigned kContainer = 10;
constexpr unsigned kMessage = 1;
constexpr unsigned kMessage2 = 86;
constexpr unsigned kErrorFrame = 2;
constexpr unsigned kErrorExt = 73;
constexpr unsigned kFdMessage = 100;
constexpr unsigned kFdMessage64 = 101;

/// Little-endian.
template <class Number>
Number at(std::string_view bytes, std::size_t from) {
  Number number = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) {
    number = static_cast<Number>(number << 8U | static_cast<std::uint8_t>(bytes[from + i]));
  }
  return number;
}

struct Object {
  unsigned header = 0;
  unsigned version = 0;
  std::size_t size = 0;
  unsigned type = 0;
};

/// The next one from a place on; its begin, or the text's end where there is none in whole.
std::size_t next_object(std::string_view bytes, std::size_t from, Object& object) {
  const std::size_t begin = bytes.find(kObject, from);
  if (begin == std::string_view::npos || bytes.size() - begin < kBaseHeader) {
    return bytes.size();
  }
  object = {at<std::uint16_t>(bytes, begin + 4), at<std::uint16_t>(bytes, begin + 6),
            at<std::uint32_t>(bytes, begin + 8), at<std::uint32_t>(bytes, begin + 12)};
  const bool is_whole = object.size >= kBaseHeader && object.size <= bytes.size() - begin;
  return is_whole ? begin : bytes.size();
}

std::string unpacked(std::string_view packed, std::size_t size) {
  std::string plain(size, '\0');
  uLongf length = size;
  const int status = uncompress(reinterpret_cast<Bytef*>(plain.data()), &length,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  return status == Z_OK && length == size ? plain : std::string();
}

/// Time since the log began.
double time_of(std::string_view object) {
  constexpr std::size_t kFlagsAt = 16;
  constexpr std::size_t kStampAt = 24;
  constexpr std::uint32_t kTenMicros = 1;
  const double unit_s = at<std::uint32_t>(object, kFlagsAt) == kTenMicros ? 1e-5 : 1e-9;
  return static_cast<double>(at<std::uint64_t>(object, kStampAt)) * unit_s;
}

CandumpLine frame_of(std::string_view object, std::size_t header) {
  constexpr std::size_t kFrame = 16;
  constexpr unsigned kRemote = 0x80;
  constexpr std::uint32_t kExtended = 0x80000000U;
  CandumpLine line;
  if (header < 32 || object.size() < header + kFrame) {
    return line;
  }
  const std::uint32_t id = at<std::uint32_t>(object, header + 4);
  const auto length = static_cast<std::uint8_t>(object[header + 3]);
  const bool is_remote = (static_cast<std::uint8_t>(object[header + 2]) & kRemote) != 0U;
  line.kind = is_remote ? LineKind::kOther : LineKind::kFrame;
  line.time_s = time_of(object);
  line.id = id & 0x1FFFFFFFU;
  line.extended = (id & kExtended) != 0U;
  line.length = std::min<std::uint8_t>(length, 8);
  for (std::size_t i = 0; i < line.length; ++i) {
    line.data[i] = static_cast<std::uint8_t>(object[header + 8 + i]);
  }
  return line;
}

/// Objects of containers, one stream that is cut anywhere.
class Stream {
 public:
  explicit Stream(const std::function<void(std::size_t, const CandumpLine&)>& take) : take_(take) {}

  void feed(std::string_view bytes) {
    rest_ += bytes;
    std::size_t from = 0;
    Object object;
    for (std::size_t begin = next_object(rest_, 0, object); begin < rest_.size();
         begin = next_object(rest_, from, object)) {
      take_object(std::string_view(rest_).substr(begin, object.size), object);
      from = begin + object.size;
    }
    rest_.erase(0, from);
  }

 private:
  void take_object(std::string_view bytes, const Object& object) {
    ++number_;
    const bool is_other = object.type == kErrorFrame || object.type == kErrorExt ||
                          object.type == kFdMessage || object.type == kFdMessage64;
    if (object.type == kMessage || object.type == kMessage2) {
      take_(number_, frame_of(bytes, object.header));
    } else if (is_other) {
      take_(number_, CandumpLine{LineKind::kOther});
    }
  }

  const std::function<void(std::size_t, const CandumpLine&)>& take_;
  std::string rest_;
  std::size_t number_ = 0;
};

}  // namespace

bool is_blf(std::string_view begin) { return begin.substr(0, kFile.size()) == kFile; }

std::string read_blf(std::string_view bytes,
                     const std::function<void(std::size_t, const CandumpLine&)>& take) {
  if (bytes.size() < 8) {
    return "is cut off in its header (BLF)";
  }
  Stream stream(take);
  Object object;
  std::size_t from = at<std::uint32_t>(bytes, 4);
  for (std::size_t begin = next_object(bytes, std::min(from, bytes.size()), object);
       begin < bytes.size(); begin = next_object(bytes, from, object)) {
    const std::string_view whole = bytes.substr(begin, object.size);
    from = begin + object.size;
    if (object.type != kContainer) {
      stream.feed(whole);
      continue;
    }
    if (whole.size() < kBaseHeader + kContainerHeader) {
      return fmt::format("byte {}: a container that is too short (BLF)", begin);
    }
    const unsigned method = at<std::uint16_t>(whole, kBaseHeader);
    const std::size_t size = at<std::uint32_t>(whole, kBaseHeader + 8);
    const std::string_view packed = whole.substr(kBaseHeader + kContainerHeader);
    const std::string plain = method == 0            ? std::string(packed)
                              : size > kMostUnpacked ? std::string()
                                                     : unpacked(packed, size);
    if (plain.empty() && size > 0) {
      return fmt::format("byte {}: a container that can't be unpacked (BLF)", begin);
    }
    stream.feed(plain);
  }
  const bool is_cut = bytes.find(kObject, from) != std::string_view::npos;
  return is_cut ? "is cut off in its last container (BLF)" : "";
}

}  // namespace graben::identify
