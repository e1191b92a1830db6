// SPDX-License-Identifier: Apache-2.0
/// A fuzz target on a series of inputs that is the same everywhere:
///   fuzz_... [INPUTS [SEED]]    sound inputs with some of their fields changed
///   fuzz_... --seeds FOLDER     writes the sound inputs as files: a corpus to start libFuzzer from
///   fuzz_... --corpus FOLDER    every file of the folder as an input

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <set>
#include <string_view>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

using graben::test::Bytes;

constexpr long kInputs = 50000;
constexpr std::uint64_t kNumberChanges = 5;
constexpr std::uint64_t kScriptChanges = 12;
constexpr std::size_t kLongestPiece = 24;

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

/// A script: bytes that go, come, stand twice or change.
void change_script(Bytes& bytes, std::mt19937_64& random) {
  const auto place = [&] { return static_cast<std::ptrdiff_t>(below(random, bytes.size())); };
  if (bytes.empty()) {
    bytes.push_back(0);
  }
  const auto at = bytes.begin() + place();
  const std::size_t left = static_cast<std::size_t>(bytes.end() - at);
  const std::size_t length = 1 + below(random, std::min<std::size_t>(left, kLongestPiece));
  const Bytes piece(at, at + static_cast<std::ptrdiff_t>(length));
  switch (below(random, 6)) {
    case 0:
      bytes.erase(at, at + static_cast<std::ptrdiff_t>(length));
      break;
    case 1:
      bytes.insert(bytes.begin() + place(), piece.begin(), piece.end());
      break;
    case 2:
      bytes.insert(at, static_cast<std::uint8_t>(random()));
      break;
    case 3:
      *at = static_cast<std::uint8_t>(*at ^ (1U << below(random, 8)));
      break;
    default:
      *at = static_cast<std::uint8_t>(random());
  }
}

void change(Bytes& bytes, std::mt19937_64& random) {
  if (!graben::test::inputs_are_numbers()) {
    change_script(bytes, random);
    return;
  }
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

/// What every mode but writing ends with.
int report(long inputs) {
  fmt::print("{} inputs, all safe\n", inputs);
  for (const auto& [name, count] : graben::test::tallies()) {
    fmt::print("{}: {}\n", name, count);
  }
  return inputs > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

int check_corpus(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.insert(entry.path());
  }
  for (const std::filesystem::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    const Bytes bytes(std::istreambuf_iterator<char>(file), {});
    const std::string wrong = graben::test::check_bytes(bytes.data(), bytes.size());
    if (!wrong.empty()) {
      fmt::print("{}: {}\n", path.filename().string(), wrong);
      return EXIT_FAILURE;
    }
  }
  return report(static_cast<long>(files.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--seeds") {
    return write_seeds(argv[2]);
  }
  if (argc == 3 && std::string_view(argv[1]) == "--corpus") {
    return check_corpus(argv[2]);
  }
  const long inputs = argc > 1 ? std::strtol(argv[1], nullptr, 10) : kInputs;
  std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  const std::vector<Bytes> seeds = graben::test::seed_inputs();
  for (long n = 0; n < inputs; ++n) {
    Bytes bytes = seeds[below(random, seeds.size())];
    const std::uint64_t most = graben::test::inputs_are_numbers() ? kNumberChanges : kScriptChanges;
    for (std::uint64_t changes = below(random, most); changes > 0; --changes) {
      change(bytes, random);
    }
    const std::string wrong = graben::test::check_bytes(bytes.data(), bytes.size());
    if (!wrong.empty()) {
      fmt::print("input {}: {}\n", n, wrong);
      return EXIT_FAILURE;
    }
  }
  return report(inputs);
}
