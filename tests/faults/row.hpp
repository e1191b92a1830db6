#pragma once
/// The rows of the table, each with the function that tries it once.

#include <vector>

#include "tests/faults/trial.hpp"

namespace graben::faults {

struct Row {
  int number = 0;
  const char* fault = "";
  const char* expected = "";
  void (*run)(Trial& trial) = nullptr;  ///< Null: not tried here, `expected` says why.
};

using Rows = std::vector<Row>;

[[nodiscard]] Rows silence_rows();  ///< 1 - 6
[[nodiscard]] Rows message_rows();  ///< 7 - 16
[[nodiscard]] Rows format_rows();   ///< 17 - 23
[[nodiscard]] Rows bus_rows();      ///< 24 - 32
[[nodiscard]] Rows machine_rows();  ///< 33 - 40, 49
[[nodiscard]] Rows process_rows();  ///< 41 - 48, 50

}  // namespace graben::faults
