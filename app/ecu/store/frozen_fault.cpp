// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/frozen_fault.hpp"

namespace graben::ecu {
namespace {
// As hal/j1939/frozen_sample.hpp has them.
constexpr double kFine = 0.0001;
constexpr double kFrom = -3.2;
constexpr double kKilopascal = 1000.0;
}  // namespace

j1939::FrozenSample frozen_of(const FaultSample& from) {
  static_assert(kSampleStrokes + kSamplePressures + kSampleDuties + 1 == j1939::kSampleWords);
  const CycleSample& sample = from.sample;
  const auto is_known = [&](std::size_t bit) { return (sample.known >> bit & 1U) != 0; };
  j1939::FrozenSample frozen;
  frozen.fault = from.fault;
  frozen.mode = static_cast<std::uint8_t>(sample.mode);
  frozen.word.fill(j1939::kNoWord);
  auto* word = frozen.word.begin();
  for (std::size_t i = 0; i < kSampleStrokes; ++i, ++word) {
    *word = is_known(i) ? j1939::sample_word(sample.stroke[i], kFine, kFrom) : j1939::kNoWord;
  }
  for (std::size_t i = 0; i < kSamplePressures; ++i, ++word) {
    *word = is_known(kSampleStrokes + i)
                ? j1939::sample_word(sample.pressure_pa[i], kKilopascal, 0.0)
                : j1939::kNoWord;
  }
  for (const float duty : sample.duty_ratio) {
    *word++ = j1939::sample_word(duty, kFine, kFrom);
  }
  *word = j1939::sample_word(sample.lambda, kFine, kFrom);
  return frozen;
}

}  // namespace graben::ecu
