#pragma once
/// The rows of the table, each with the function that tries it once.

#include <vector>

#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {

struct RowText {
  int number = 0;
  const char* fault = "";
  const char* expected = "";
  bool is_tried = true;  ///< Else `expected` says why not.
};

template <class Kind>
struct Row : RowText {
  Row(int of_number, const char* of_fault, const char* what, void (*how)(Trial<Kind>& trial))
      : RowText{of_number, of_fault, what, how != nullptr}, run(how) {}

  void (*run)(Trial<Kind>& trial);  ///< Null: not tried here.
};

template <class Kind>
using Rows = std::vector<Row<Kind>>;

template <class Kind>
[[nodiscard]] Rows<Kind> silence_rows();  ///< 1 - 4, 6
template <class Kind>
[[nodiscard]] Rows<Kind> message_rows();  ///< 7 - 16
template <class Kind>
[[nodiscard]] Rows<Kind> format_rows();  ///< 17 - 23
template <class Kind>
[[nodiscard]] Rows<Kind> bus_rows();  ///< 24 - 32
template <class Kind>
[[nodiscard]] Rows<Kind> machine_rows();  ///< 33 - 36
template <class Kind>
[[nodiscard]] Rows<Kind> process_rows();  ///< 41 - 48, 50
/// Those that each kind has in its own way, or not at all: 5, 37 - 40, 49.
[[nodiscard]] Rows<Excavator> excavator_rows();
[[nodiscard]] Rows<Dozer> dozer_rows();
/// All of a kind, by their numbers.
template <class Kind>
[[nodiscard]] Rows<Kind> all_rows();

}  // namespace graben::faults
