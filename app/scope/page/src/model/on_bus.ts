// SPDX-License-Identifier: Apache-2.0
/// Machines that were put on another bus: their frames say a hash of both, profile and bus.

import type {Machine, Setup} from './api';

/// Those that are given, then each excavator on each of the buses.
export function machines_of({machines, buses = []}: Pick<Setup, 'machines' | 'buses'>): Machine[] {
  const on_buses = machines.flatMap((machine) => machine.kind !== 'excavator' ? []
    : buses.map((bus) => ({...machine, bus, hash: (machine.hash ^ bus.hash) >>> 0,
      name: `${machine.name} on ${bus.name}`})));
  return [...machines, ...on_buses];
}
