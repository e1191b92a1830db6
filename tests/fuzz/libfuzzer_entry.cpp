#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = graben::test::check_bytes(data, size);
  if (!wrong.empty()) {
    std::fputs((wrong + "\n").c_str(), stderr);
    std::abort();
  }
  return 0;
}
