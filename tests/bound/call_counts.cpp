// SPDX-License-Identifier: Apache-2.0
/// How often functions are called in one call of others, at most, for the facts of `facts.toml`.
/// The compiler calls in here wherever the core's functions begin and end (GRABEN_COUNT_CALLS).
///
/// GRABEN_FACTS names a file of `N within ADDRESS` and `N calls ADDRESS`, addresses in hex; at the
/// end a line `N TIMES IN` for each N goes to the file that GRABEN_FACT_COUNTS names: the most
/// calls in one call of `within`, and how many calls of it there were. held_facts.py writes and
/// reads both.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <unordered_map>
#include <vector>

namespace {

#define GRABEN_NOT_COUNTED __attribute__((no_instrument_function))

constexpr std::size_t kMostFacts = 64;

struct Fact {
  std::uint64_t now = 0;
  std::uint64_t most = 0;
  std::uint64_t in = 0;
  int depth = 0;  ///< Of `within`; counts begin anew with the outermost.
};

struct Roles {
  std::uint64_t within = 0;  ///< A bit of each fact.
  std::uint64_t calls = 0;
};

struct Counts {
  std::array<Fact, kMostFacts> fact;
  std::unordered_map<void*, Roles> roles;
  std::size_t facts = 0;

  GRABEN_NOT_COUNTED Counts() {
    const char* file = std::getenv("GRABEN_FACTS");
    std::ifstream stream(file == nullptr ? "" : file);
    std::size_t number = 0;
    std::string role;
    std::uint64_t address = 0;
    while (stream >> std::dec >> number >> role >> std::hex >> address) {
      if (number >= kMostFacts) {
        std::cerr << "call_counts: at most " << kMostFacts << " facts\n";
        std::exit(2);
      }
      facts = number + 1 > facts ? number + 1 : facts;
      Roles& at = roles[reinterpret_cast<void*>(address)];  // NOLINT: an address of this program
      (role == "within" ? at.within : at.calls) |= std::uint64_t{1} << number;
    }
  }
  GRABEN_NOT_COUNTED ~Counts() {
    const char* file = std::getenv("GRABEN_FACT_COUNTS");
    std::ofstream stream(file == nullptr ? "" : file);
    for (std::size_t n = 0; n < facts; ++n) {
      stream << n << ' ' << fact[n].most << ' ' << fact[n].in << '\n';
    }
  }
};

GRABEN_NOT_COUNTED Counts& counts() {
  static Counts all;
  return all;
}

template <class Act>
GRABEN_NOT_COUNTED void each(std::uint64_t bits, const Act& act) {
  for (std::size_t n = 0; bits != 0; ++n, bits >>= 1) {
    if ((bits & 1) != 0) {
      act(counts().fact[n]);
    }
  }
}

}  // namespace

extern "C" {
GRABEN_NOT_COUNTED void __cyg_profile_func_enter(void* function, void* /*from*/) {
  const auto found = counts().roles.find(function);
  if (found == counts().roles.end()) {
    return;
  }
  each(found->second.within, [](Fact& fact) {
    if (fact.depth++ == 0) {
      fact.now = 0;
      ++fact.in;
    }
  });
  each(found->second.calls, [](Fact& fact) {
    fact.now += fact.depth > 0 ? 1 : 0;
    fact.most = fact.now > fact.most ? fact.now : fact.most;
  });
}
GRABEN_NOT_COUNTED void __cyg_profile_func_exit(void* function, void* /*from*/) {
  const auto found = counts().roles.find(function);
  if (found != counts().roles.end()) {
    each(found->second.within, [](Fact& fact) { --fact.depth; });
  }
}
}
