/// A fuzz target on a series of inputs that is the same everywhere:
///   fuzz_... [INPUTS [SEED]]    sound inputs with some of their fields changed
///   fuzz_... --seeds FOLDER     writes the sound inputs as files: a corpus to start libFuzzer from

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string_view>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

using graben::test::Bytes;

constexpr long kInputs = 50000;

std::uint64_t below(std::mt19937_64& random, std::uint64_t bound) { return random() % bound; }

/// Numbers at which code tends to break, and plain ones of any size.
double telling_number(std::mt19937_64& random) {
  using Limits = std::numeric_limits<double>;
  static constexpr std::array kNumbers{0.0,
                                       -0.0,
                                       1.0,
                                       -1.0,
                                       Limits::denorm_min(),
                                       Limits::min(),
                                       Limits::max(),
                                       -Limits::max(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::quiet_NaN(),
                                       1e-160,
                                       1e160,
                                       Limits::epsilon()};
  if (below(random, 2) == 0) {
    return kNumbers[below(random, kNumbers.size())];
  }
  const double sign = below(random, 4) == 0 ? -1.0 : 1.0;
  return sign * std::ldexp(1.0 + static_cast<double>(below(random, 1000)) / 1000.0,
                           static_cast<int>(below(random, 121)) - 60);
}

void change_number(Bytes& bytes, std::mt19937_64& random) {
  if (bytes.size() < sizeof(double)) {
    return;
  }
  const std::size_t at = 8 * below(random, bytes.size() / sizeof(double));
  double value = 0.0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  switch (below(random, 4)) {
    case 0:
      value *= std::ldexp(1.0, static_cast<int>(below(random, 9)) - 4);
      break;
    case 1: {
      // Next to another number of the same input: ties are corners too.
      const std::size_t from = 8 * below(random, bytes.size() / sizeof(double));
      std::memcpy(&value, bytes.data() + from, sizeof(value));
      break;
    }
    default:
      value = telling_number(random);
  }
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

void change(Bytes& bytes, std::mt19937_64& random) {
  switch (below(random, 16)) {
    case 0:
      bytes[below(random, bytes.size())] = static_cast<std::uint8_t>(random());
      break;
    case 1:
      bytes.resize(1 + below(random, bytes.size()));
      break;
    default:
      change_number(bytes, random);
  }
}

int write_seeds(const std::string& folder) {
  int number = 0;
  for (const Bytes& bytes : graben::test::seed_inputs()) {
    std::ofstream file(fmt::format("{}/seed_{}", folder, number++), std::ios::binary);
    for (const std::uint8_t byte : bytes) {
      file.put(static_cast<char>(byte));
    }
    if (!file) {
      fmt::print(stderr, "cannot write to '{}'\n", folder);
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--seeds") {
    return write_seeds(argv[2]);
  }
  const long inputs = argc > 1 ? std::strtol(argv[1], nullptr, 10) : kInputs;
  std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  const std::vector<Bytes> seeds = graben::test::seed_inputs();
  for (long n = 0; n < inputs; ++n) {
    Bytes bytes = seeds[below(random, seeds.size())];
    for (std::uint64_t changes = below(random, 5); changes > 0; --changes) {
      change(bytes, random);
    }
    const std::string wrong = graben::test::check_bytes(bytes.data(), bytes.size());
    if (!wrong.empty()) {
      fmt::print("input {}: {}\n", n, wrong);
      return EXIT_FAILURE;
    }
  }
  fmt::print("{} inputs, all safe\n", inputs);
  return inputs > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
