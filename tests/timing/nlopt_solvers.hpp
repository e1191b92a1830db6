#pragma once
/// What the two NLopt peers share: ownership of NLopt's C object. The C interface, for it neither
/// copies vectors nor catches exceptions between solver and problem.

#include <nlopt.h>

#include <memory>
#include <stdexcept>

namespace graben::timing {

struct DestroyNlopt {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};
using NloptOptimiser = std::unique_ptr<nlopt_opt_s, DestroyNlopt>;

/// Throws std::runtime_error: a setting that is refused would silently measure something else.
inline void nlopt_must(nlopt_result result) {
  if (result < 0) {
    throw std::runtime_error(nlopt_result_to_string(result));
  }
}

}  // namespace graben::timing
