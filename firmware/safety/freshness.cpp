#include "firmware/safety/freshness.hpp"

namespace graben {

void read_required(const Required& row, const Freshness& fresh, FaultSet& faults) {
  if (fresh.number(*row.from)) {
    *row.to = row.from->value;
  } else {
    faults.add(row.missing);
  }
  if (row.from->validity == Validity::kError) {
    faults.add(row.wrong);
  }
}

}  // namespace graben
