// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/site_mark.hpp"

#include <array>
#include <cstring>

#include "app/ecu/store/byte_order.hpp"
#include "app/ecu/store/record_format.hpp"

namespace graben::ecu {
namespace {

class Mark {
 public:
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    std::array<std::uint8_t, sizeof bits> bytes{};
    ByteWriter(bytes.data(), bytes.size()).u64(bits);
    sum_ = crc32(bytes.data(), bytes.size(), sum_);
  }
  void add(const Eigen::Vector3d& place_m) {
    for (int i = 0; i < 3; ++i) {
      add(place_m[i]);
    }
  }
  void add(const DesignSurface& surface) {
    add(Eigen::Vector3d(surface.step_m, surface.base_m, surface.cosine));
    add(Eigen::Vector3d(surface.machine_m.x(), surface.machine_m.y(), surface.sine));
    const int cells = surface.columns * surface.rows;
    for (int i = 0; i < cells; ++i) {
      const auto height = static_cast<std::uint16_t>(surface.height[i]);
      const std::array<std::uint8_t, 2> bytes = {static_cast<std::uint8_t>(height),
                                                 static_cast<std::uint8_t>(height >> 8U)};
      sum_ = crc32(bytes.data(), bytes.size(), sum_);
    }
  }
  /// 0 says that there is none.
  [[nodiscard]] std::uint32_t sum() const { return sum_ != 0 ? sum_ : 1; }

 private:
  std::uint32_t sum_ = 0;
};

}  // namespace

std::uint32_t site_mark(const TaskBook& book) {
  Mark mark;
  if (book.site.can_touch) {
    mark.add(book.site.benchmark_m);
    mark.add(book.site.second_m);
    return mark.sum();
  }
  for (int i = 0; i < book.count; ++i) {
    const FenceSet& fences = book.program[static_cast<unsigned>(i)].fences;
    if (!has_design(fences)) {
      continue;
    }
    const Fence& design = fences.fence[static_cast<unsigned>(fences.count - 1)];
    mark.add(design.normal);
    mark.add(design.offset_m);
    if (design.is_surface()) {
      mark.add(*design.surface);
    }
  }
  return mark.sum();
}

}  // namespace graben::ecu
