// SPDX-License-Identifier: Apache-2.0
#pragma once
/// State under a seal: a bit that flips between two cycles is found before anything is read.

#include <array>
#include <cstddef>
#include <cstring>

namespace graben {

/// What a controller keeps from cycle to cycle, with a word that every bit of it has a share in:
/// the exclusive or of all its words. `intact()` as constructed, copied or sealed; not after a
/// change of any one bit of the state or of the seal, nor where all of it became zeros or ones.
/// Padding counts too: whatever it holds, it holds from cycle to cycle.
template <class T>
class Sealed {
 public:
  template <class... Of>
  explicit Sealed(const Of&... of) : kept_(of...), seal_(seal_of(word_of_all())) {}
  // A copy need not take padding along. What is not intact does not become so.
  Sealed(const Sealed& other) : kept_(other.kept_), seal_(sealed_as(other)) {}
  Sealed& operator=(const Sealed& other) {
    kept_ = other.kept_;
    seal_ = sealed_as(other);
    return *this;
  }
  ~Sealed() = default;

  [[nodiscard]] bool intact() const { return seal_ == seal_of(word_of_all()); }
  /// What was written since counts from now on.
  void seal() { seal_ = seal_of(word_of_all()); }

  /// Whether it is intact. If not, nobody knows what it has become: it is made anew of `of`, where
  /// it lies, as on the stack it would be too much. It has to be sealed after that.
  template <class... Of>
  [[nodiscard]] bool unseal(const Of&... of) {
    if (intact()) {
      return true;
    }
    kept_.~Kept();
    new (&kept_) Kept(of...);
    return false;
  }

  [[nodiscard]] T& operator*() { return kept_.state; }
  [[nodiscard]] const T& operator*() const { return kept_.state; }
  [[nodiscard]] T* operator->() { return &kept_.state; }
  [[nodiscard]] const T* operator->() const { return &kept_.state; }

 private:
  struct Kept {
    // T() makes all zero first, padding too.
    template <class... Of>
    explicit Kept(const Of&... of) : state(of...) {}
    static void* operator new(std::size_t, Kept* place) noexcept { return place; }

    T state;
  };
  /// As wide as the machine reads at once.
  using Word = std::size_t;
  static_assert(alignof(T) % sizeof(Word) == 0);  // So is its size.
  /// Neither zeros nor ones have it: wiped memory is no state.
  static constexpr Word kOfNothing = static_cast<Word>(0x5A96'3C69'A55A'C396ULL);

  /// Words that are read side by side: a word at a time costs 2.5 times as many instructions.
  using Row = std::array<Word, 16>;

  [[nodiscard]] Word word_of_all() const {
    const auto* bytes =
        static_cast<const unsigned char*>(__builtin_assume_aligned(&kept_, alignof(Word)));
    // Bytes that whole rows take. [bytes; derived: the state's size, rounded down to rows]
    constexpr std::size_t kInRows = sizeof(T) / sizeof(Row) * sizeof(Row);
    Word even = kOfNothing;
    Word odd = 0;
    for (std::size_t at = 0; at < kInRows; at += sizeof(Row)) {
      Row row;
      std::memcpy(row.data(), bytes + at, sizeof row);
      // Written out, as a loop here is not unrolled.
      even ^= row[0] ^ row[2] ^ row[4] ^ row[6] ^ row[8] ^ row[10] ^ row[12] ^ row[14];
      odd ^= row[1] ^ row[3] ^ row[5] ^ row[7] ^ row[9] ^ row[11] ^ row[13] ^ row[15];
    }
    for (std::size_t at = kInRows; at < sizeof(T); at += sizeof(Word)) {
      Word word = 0;
      std::memcpy(&word, bytes + at, sizeof word);
      even ^= word;
    }
    return even ^ odd;
  }
  /// As often as it has room, so that no byte behind it is unsealed padding.
  using Seal = std::array<Word, alignof(T) / sizeof(Word)>;
  static Seal seal_of(Word word) {
    Seal seal;
    seal.fill(word);
    return seal;
  }
  [[nodiscard]] Seal sealed_as(const Sealed& other) const {
    return seal_of(other.intact() ? word_of_all() : ~word_of_all());
  }

  Kept kept_;
  Seal seal_;
};

}  // namespace graben
