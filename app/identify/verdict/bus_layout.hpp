// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How the frames of a bus are read as named numbers, whoever says it: our own DBCs, a DBC file or
/// a bus profile.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/identify/verdict/meaning.hpp"
#include "can_dbc/codec.hpp"

namespace graben::identify {

struct LayoutSignal {
  std::string name;  ///< "Message.Signal".
  Meaning meaning;
  double least = 0.0;  ///< Allowed; both 0: not said.
  double most = 0.0;
};

struct MessageLayout {
  std::string name;
  std::uint32_t id = 0;
  bool extended = true;
  int length = 8;
  bool is_protected = false;  ///< By a CRC of ours, with this data id.
  std::uint16_t data_id = 0;
  std::vector<LayoutSignal> signal;
  /// Puts a number for each signal; NaN where the frame has none.
  std::function<void(const dbc::Payload&, std::vector<double>&)> decode;
};

struct BusLayout {
  std::string name;  ///< In words: "our excavator bus", a file's name.
  std::vector<MessageLayout> message;
  std::vector<std::string> left_out = {};  ///< Signals of drives that can't be read, each with why.
};

/// Our DBC of the excavator and of the dozer: what says something of a drive.
[[nodiscard]] BusLayout own_excavator_layout();
[[nodiscard]] BusLayout own_dozer_layout();

/// Of a DBC file, by its signals' names, or of a bus profile, by its table. Throws
/// std::runtime_error where it can't be read.
[[nodiscard]] BusLayout layout_of(const std::string& dbc);

}  // namespace graben::identify
