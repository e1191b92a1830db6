/// The worker's end: an intake that speaks by messages.

import {Intake} from './intake';
import type {Order, Told} from './orders';

const scope = self as unknown as {
  onmessage: ((event: MessageEvent<Order>) => void) | null;
  postMessage(told: Told, transfer: Transferable[]): void;
};

const intake = new Intake((told, transfer) => scope.postMessage(told, transfer));
scope.onmessage = (event) => intake.obey(event.data);
scope.postMessage({told: 'ready'}, []);
