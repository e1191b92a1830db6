// SPDX-License-Identifier: Apache-2.0
/// An intake in a worker; on the page's own thread where the browser makes none, as some do for a
/// page from a file.

import {Intake, type Connect} from './intake';
import type {Hear, HearOf, Order, Posted} from './orders';

/// What a Worker is, as far as it is used here.
export interface AnyWorker {
  onmessage: ((event: MessageEvent<Posted>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  postMessage(order: Order): void;
  terminate(): void;
}

export interface Reader {
  obey(order: Order): void;
}

/// `connect` is what the worker has, too. `make` may throw, or the worker may fail before it says that it is ready: then the orders so far
/// are obeyed here.
export function make_reader(make: () => AnyWorker, connect: Connect, hear: Hear): Reader {
  const orders: Order[] = [];
  let source = 0;  // the intake counts alike
  const hear_now: HearOf = (told, transfer, of) => {
    if (of === source) {
      hear(told, transfer);
    }
  };
  let ready = false;
  let own: Intake | null = null;
  let worker: AnyWorker | null = null;
  const read_here = (): void => {
    worker?.terminate();
    worker = null;
    own = new Intake(hear_now, connect);
    orders.splice(0).forEach((order) => own?.obey(order));
  };
  try {
    worker = make();
    worker.onmessage = ({data}) => {
      ready = true;
      orders.length = 0;
      if (data.told.told !== 'ready') {
        hear_now(data.told, [], data.source);
      }
    };
    worker.onerror = (event) => {
      event.preventDefault();
      if (!ready) {
        read_here();
      } else {
        const why = `the page's reader failed: ${event.message}`;
        hear({told: 'closed', why, again_s: null}, []);
      }
    };
  } catch {
    read_here();
  }
  return {
    obey(order) {
      source += order.order === 'send' ? 0 : 1;
      if (own !== null) {
        own.obey(order);
        return;
      }
      if (!ready) {
        orders.push(order);
      }
      worker?.postMessage(order);
    },
  };
}
