// Reads a number where none can begin, as an ECU's processor may refuse to.
#include <cstdint>
#include <cstdio>

int main(int count, char**) {
  alignas(std::uint32_t) const unsigned char bytes[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  const auto* word = reinterpret_cast<const std::uint32_t*>(bytes + count);
  std::printf("%u\n", static_cast<unsigned>(*word));
  return 0;
}
