// SPDX-License-Identifier: Apache-2.0
#pragma once
/// MCAP (mcap.dev/spec), a container of stamped messages that Foxglove and PlotJuggler open: with
/// chunks, not compressed, each with its index, and a summary.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graben::app_export {

class McapWriter {
 public:
  /// Begins a file. Throws std::runtime_error, naming it, where it cannot be written; so do all
  /// others.
  McapWriter(std::filesystem::path file, std::string_view library);

  /// A stream of JSON messages; `schema` is a JSON schema, `schema_name` its name. Returns the
  /// channel's id.
  std::uint16_t add_channel(std::string_view topic, std::string_view schema_name,
                            std::string_view schema);

  /// Stamps must not go back: that is the caller's to see to.
  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);

  /// Writes summary and end. Nothing may be added afterwards.
  void finish();

  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  /// (time, offset in the chunk) of each message of a channel.
  using Index = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  struct ChunkPlace {
    std::uint64_t first_ns;
    std::uint64_t last_ns;
    std::uint64_t begin;
    std::uint64_t length;
    std::map<std::uint16_t, std::uint64_t> index_at;
    std::uint64_t index_length;
    std::uint64_t size;
  };

  void put(std::string_view bytes);
  void close_chunk();
  [[nodiscard]] std::string summary(std::uint64_t begin) const;

  std::filesystem::path file_;
  std::ofstream stream_;
  std::uint64_t at_ = 0;
  std::string definitions_;  ///< Records of all schemas and channels, for the summary.
  std::uint16_t channels_ = 0;
  std::string chunk_;
  std::map<std::uint16_t, Index> chunk_index_;
  std::vector<ChunkPlace> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t messages_ = 0;
  std::uint64_t first_ns_ = 0;
  std::uint64_t last_ns_ = 0;
  std::uint64_t chunk_first_ns_ = 0;
};

}  // namespace graben::app_export
