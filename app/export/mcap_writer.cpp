// SPDX-License-Identifier: Apache-2.0
#include "app/export/mcap_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace graben::app_export {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkSize = 1U << 20U;

// The specification's numbers of the records.
constexpr std::uint8_t kHeader = 0x01;
constexpr std::uint8_t kFooter = 0x02;
constexpr std::uint8_t kSchema = 0x03;
constexpr std::uint8_t kChannel = 0x04;
constexpr std::uint8_t kMessage = 0x05;
constexpr std::uint8_t kChunk = 0x06;
constexpr std::uint8_t kMessageIndex = 0x07;
constexpr std::uint8_t kChunkIndex = 0x08;
constexpr std::uint8_t kStatistics = 0x0B;
constexpr std::uint8_t kDataEnd = 0x0F;

/// Little endian, whatever the machine's order is.
template <class Number>
std::string bytes_of(Number number) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes += static_cast<char>((static_cast<std::uint64_t>(number) >> (8U * i)) & 0xFFU);
  }
  return bytes;
}

std::string u16(std::uint64_t number) { return bytes_of(static_cast<std::uint16_t>(number)); }
std::string u32(std::uint64_t number) { return bytes_of(static_cast<std::uint32_t>(number)); }
std::string u64(std::uint64_t number) { return bytes_of(number); }

/// With its length before it: a string, a map, an array.
std::string sized(std::string_view bytes) { return u32(bytes.size()).append(bytes); }

std::string record(std::uint8_t code, std::string_view content) {
  return std::string(1, static_cast<char>(code)).append(u64(content.size())).append(content);
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::string map_of(const std::map<std::uint16_t, std::uint64_t>& map) {
  std::string bytes;
  for (const auto& [key, value] : map) {
    bytes += u16(key) + u64(value);
  }
  return sized(bytes);
}

}  // namespace

McapWriter::McapWriter(std::filesystem::path file, std::string_view library)
    : file_(std::move(file)), stream_(file_, std::ios::binary) {
  put(kMagic);
  put(record(kHeader, sized("") + sized(library)));
}

std::uint16_t McapWriter::add_channel(std::string_view topic, std::string_view schema_name,
                                      std::string_view schema) {
  const std::uint16_t id = ++channels_;
  const std::string records =
      record(kSchema, u16(id) + sized(schema_name) + sized("jsonschema") + sized(schema)) +
      record(kChannel, u16(id) + u16(id) + sized(topic) + sized("json") + sized(""));
  definitions_ += records;
  chunk_ += records;
  counts_[id] = 0;
  return id;
}

void McapWriter::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  if (chunk_index_.empty()) {
    chunk_first_ns_ = time_ns;
  }
  first_ns_ = messages_ == 0 ? time_ns : first_ns_;
  last_ns_ = time_ns;
  chunk_index_[channel].emplace_back(time_ns, chunk_.size());
  chunk_ += record(kMessage, u16(channel) + u32(counts_[channel]) + u64(time_ns) + u64(time_ns) +
                                 std::string(json));
  ++counts_[channel];
  ++messages_;
  if (chunk_.size() >= kChunkSize) {
    close_chunk();
  }
}

void McapWriter::finish() {
  close_chunk();
  put(record(kDataEnd, u32(0)));
  put(summary(at_));
  put(kMagic);
  stream_.close();
  if (!stream_) {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), std::strerror(errno)));
  }
}

void McapWriter::put(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), std::strerror(errno)));
  }
  at_ += bytes.size();
}

void McapWriter::close_chunk() {
  if (chunk_.empty()) {
    return;
  }
  const std::uint64_t first_ns = chunk_index_.empty() ? last_ns_ : chunk_first_ns_;
  ChunkPlace place{first_ns, last_ns_, at_, 0, {}, 0, chunk_.size()};
  put(record(kChunk, u64(place.first_ns) + u64(place.last_ns) + u64(chunk_.size()) +
                         u32(crc_of(chunk_)) + sized("") + u64(chunk_.size()) + chunk_));
  place.length = at_ - place.begin;
  for (const auto& [channel, index] : chunk_index_) {
    std::string entries;
    for (const auto& [time_ns, offset] : index) {
      entries += u64(time_ns) + u64(offset);
    }
    place.index_at[channel] = at_;
    put(record(kMessageIndex, u16(channel) + sized(entries)));
  }
  place.index_length = at_ - place.begin - place.length;
  chunks_.push_back(place);
  chunk_.clear();
  chunk_index_.clear();
}

std::string McapWriter::summary(std::uint64_t begin) const {
  std::string text = definitions_;
  for (const ChunkPlace& chunk : chunks_) {
    text += record(kChunkIndex, u64(chunk.first_ns) + u64(chunk.last_ns) + u64(chunk.begin) +
                                    u64(chunk.length) + map_of(chunk.index_at) +
                                    u64(chunk.index_length) + sized("") + u64(chunk.size) +
                                    u64(chunk.size));
  }
  text += record(kStatistics, u64(messages_) + u16(channels_) + u32(channels_) + u32(0) + u32(0) +
                                  u32(chunks_.size()) + u64(first_ns_) + u64(last_ns_) +
                                  map_of(counts_));
  // The checksum is of all before it, the footer's own beginning too.
  const std::string end = u64(begin) + u64(0);
  const std::string footer = record(kFooter, end + u32(0));
  const std::uint32_t crc = crc_of(text + footer.substr(0, footer.size() - sizeof(std::uint32_t)));
  return text + record(kFooter, end + u32(crc));
}

}  // namespace graben::app_export
