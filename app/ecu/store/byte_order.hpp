// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers in the bytes of a record, little endian whatever the processor. Neither class allocates;
/// beyond the room nothing is written, or 0 is read, and good() is false from then on.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace graben::ecu {

class ByteWriter {
 public:
  ByteWriter(std::uint8_t* to, std::size_t room) : to_(to), room_(room) {}

  void u8(std::uint8_t value) { put(value, 1); }
  void u16(std::uint16_t value) { put(value, 2); }
  void u32(std::uint32_t value) { put(value, 4); }
  void u64(std::uint64_t value) { put(value, 8); }
  void f32(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    u32(bits);
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool good() const { return good_; }

 private:
  void put(std::uint64_t value, std::size_t bytes) {
    good_ = good_ && room_ - count_ >= bytes;
    for (std::size_t i = 0; good_ && i < bytes; ++i) {
      to_[count_++] = static_cast<std::uint8_t>(value >> (8U * i));
    }
  }

  std::uint8_t* to_;
  std::size_t room_;
  std::size_t count_ = 0;
  bool good_ = true;
};

class ByteReader {
 public:
  ByteReader(const std::uint8_t* from, std::size_t count) : from_(from), left_(count) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(take(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(take(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(take(4)); }
  std::uint64_t u64() { return take(8); }
  float f32() {
    const std::uint32_t bits = u32();
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  [[nodiscard]] bool good() const { return good_; }
  /// Bytes that were not read yet.
  [[nodiscard]] std::size_t left() const { return left_; }

 private:
  std::uint64_t take(std::size_t bytes) {
    good_ = good_ && left_ >= bytes;
    std::uint64_t value = 0;
    for (std::size_t i = 0; good_ && i < bytes; ++i) {
      value |= std::uint64_t{*from_++} << (8U * i);
      --left_;
    }
    return value;
  }

  const std::uint8_t* from_;
  std::size_t left_;
  bool good_ = true;
};

}  // namespace graben::ecu
