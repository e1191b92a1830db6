namespace {
constexpr int kMost = 10;
constexpr bool kLimits = kMost >= 10;
constexpr bool beyond(int value) { return value >= kMost; }
struct Limit {
  bool holds = true;
  explicit Limit(int value) : small_{value < 5} {}
  [[nodiscard]] int of(int value) const {
    return holds && !small_ && kLimits && beyond(value) ? kMost : value;
  }
  bool small_;
};
template <bool kNeeded>
int checked(int value) {
  static_assert(kNeeded);
  return Limit(value).of(value);
}
}  // namespace
int limited(int value) { return checked<true>(value); }
