// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  // Made before what prints it is registered, it is gone after that.
  static_cast<void>(graben::test::tallies());
  return std::atexit([] {
    for (const auto& [name, count] : graben::test::tallies()) {
      std::fprintf(stderr, "%s: %llu\n", name.c_str(), static_cast<unsigned long long>(count));
    }
  });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = graben::test::check_bytes(data, size);
  if (!wrong.empty()) {
    std::fputs((wrong + "\n").c_str(), stderr);
    std::abort();
  }
  return 0;
}
