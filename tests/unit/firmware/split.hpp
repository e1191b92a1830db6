// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A motion of the shipped excavator whose feasible set splits: the boom comes down under its load
/// while the bucket curls. Slowly the boom's rod side takes the pump's flow and leaves the bucket
/// too little pressure; fast its regeneration feeds the bucket.

#include "firmware/mcv/mcv_machine.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

inline McvMachine kim() { return mcv_machine(excavator().profile); }

/// By the bucket's cap pressure: under about 1.6 MPa everything up to lambda = 1 is feasible; up to
/// about 3.1 MPa [0, 0.2] and an interval that ends at 1; beyond only [0, 0.17].
inline McvInput split_input(double bucket_cap_pa) {
  McvInput input;
  input.velocity_mps = {-0.3, 0.0, 0.1};
  input.cap_pressure_pa = {12e6, 4e6, bucket_cap_pa};
  input.rod_pressure_pa = {1e6, 4e6, 0.5e6};
  input.pump_flow_m3ps = {1.5e-3, 1.5e-3};
  return input;
}

}  // namespace graben::test
