#pragma once
/// The way to what the controller stores, for flipping a bit of it.

#include <array>
#include <cstring>
#include <type_traits>

#include "app/ecu/excavator_ecu.hpp"

namespace graben {

struct ControllerMemoryAccess {
  /// A bit of one of the guarded setpoints: mode, lambda, the openings that the gate let through.
  /// `bit` counts over the value and its complement.
  static void flip(ecu::ExcavatorEcu& ecu, unsigned setpoint, unsigned bit) {
    auto& memory = ecu.controller_.memory_;
    switch (setpoint) {
      case 0:
        flip_bit(memory.mode, bit);
        break;
      case 1:
        flip_bit(memory.lambda, bit);
        break;
      default:
        flip_bit(memory.gate.opening[setpoint % kAxisCount], bit);
        break;
    }
  }

 private:
  template <class T>
  static void flip_bit(T& object, unsigned bit) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::array<unsigned char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &object, sizeof(T));
    bit %= 8U * sizeof(T);
    bytes[bit / 8U] = static_cast<unsigned char>(bytes[bit / 8U] ^ (1U << (bit % 8U)));
    std::memcpy(static_cast<void*>(&object), bytes.data(), sizeof(T));
  }
};

}  // namespace graben
