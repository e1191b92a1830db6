// What the core may do: this archive must be accepted, or the refusals beside it prove nothing.
#include <cmath>
#include <cstring>

namespace {
const char* const kNames[] = {"boom", "arm", "bucket"};
}

struct Port {
  virtual double angle_rad(double x, double y) const = 0;

 protected:
  ~Port() = default;
};

struct Joint final : Port {
  double angle_rad(double x, double y) const override { return std::atan2(y, x); }
};

const char* name_of(unsigned joint) { return kNames[joint]; }

double angle_of(const Joint& joint, double x) { return joint.angle_rad(x, std::sin(x)); }

void copy(unsigned char* to, const unsigned char* from, unsigned size) {
  std::memcpy(to, from, size);
}
