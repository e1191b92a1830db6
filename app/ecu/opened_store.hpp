// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The store of the deployed process as its command line asks for it, and what is kept there.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "app/ecu/ecu_process.hpp"
#include "app/ecu/ground/edge_finder.hpp"
#include "app/ecu/store/cycle_sample.hpp"
#include "app/ecu/store/process_store.hpp"

namespace graben::ecu {

/// Nothing where neither the options nor the service manager have a folder.
template <class Kind>
std::unique_ptr<ProcessStore> open_store(const EcuOptions& options, std::uint32_t profile_hash) {
  const std::string folder = store_folder(options.store, std::getenv("STATE_DIRECTORY"));
  constexpr const typename Kind::Inputs* kKind = nullptr;
  return folder.empty() ? nullptr
                        : std::make_unique<ProcessStore>(
                              folder, profile_hash, sample_kind_of(kKind), options.keeps_ground);
}

/// Where the edge has been, to the store's thread; of an edge whose width nobody says, no ground is
/// known.
template <class Setup>
ground::EdgeRing* edges_of(const Setup& setup, ProcessStore* store) {
  ground::EdgeRing* const edges = store == nullptr ? nullptr : store->edges();
  if (edges != nullptr && !(ground::edge_width_m(setup) > 0.0)) {
    std::fputs(
        "graben-ecu: --keep-ground: the profile does not say how wide the edge is; no ground is "
        "kept\n",
        stderr);
    return nullptr;
  }
  return edges;
}

}  // namespace graben::ecu
