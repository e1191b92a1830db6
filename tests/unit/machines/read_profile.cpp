// SPDX-License-Identifier: Apache-2.0
/// Reads a profile as one of a machine of this kind: read_profile KIND FILE; as a simulated one
/// with the file beside it too. Says what is wrong with it and ends with 1; ends with 0 and in
/// silence else.
/// `hash` prints the hash of its values.

#include <cstdio>
#include <exception>
#include <string>

#include "app/machines/any_machine.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("read_profile [simulated-]excavator|[simulated-]dozer|kind|hash FILE\n", stderr);
    return 2;
  }
  using namespace graben::machines;
  const std::string kind = argv[1];
  try {
    if (kind == "kind") {
      static_cast<void>(profile_kind(argv[2]));
    } else if (kind == "hash") {
      const AnyMachine machine = load_any(argv[2]);
      std::printf("%08x\n", std::visit([](const auto& any) { return any.hash; }, machine));
    } else if (kind == "dozer") {
      static_cast<void>(load_dozer(argv[2]));
    } else if (kind == "excavator") {
      static_cast<void>(load_excavator(argv[2]));
    } else if (kind == "simulated-dozer") {
      static_cast<void>(load_simulated_dozer(argv[2]));
    } else {
      static_cast<void>(load_simulated_excavator(argv[2]));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
