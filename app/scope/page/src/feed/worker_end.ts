// SPDX-License-Identifier: Apache-2.0
/// The worker's end: an intake that speaks to the page by messages.

import {Intake, type Connect} from './intake';
import type {Order, Posted} from './orders';

export function work(connect: Connect): void {
  const scope = self as unknown as {
    onmessage: ((event: MessageEvent<Order>) => void) | null;
    postMessage(posted: Posted, transfer: Transferable[]): void;
  };
  const intake = new Intake((told, transfer, source) =>
    scope.postMessage({told, source}, transfer), connect);
  scope.onmessage = (event) => intake.obey(event.data);
  scope.postMessage({told: {told: 'ready'}, source: 0}, []);
}
