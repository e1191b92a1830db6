// SPDX-License-Identifier: Apache-2.0
/// The WebSocket of a page that may ask for something, as a simulation's stop.

import type {Batches} from './batches';
import type {Hear} from './orders';
import {ServerSocket} from './socket';

const STEERS = 'graben-scope';

export class SteeringSocket extends ServerSocket {
  constructor(url: string, batches: Batches, hear: Hear) {
    super(url, batches, hear, STEERS);
  }

  say(text: string): void {
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(text);
    } else {
      const why = 'there is no connection to the server';
      this.hear({told: 'message', message: {kind: 'refused', why}}, []);
    }
  }
}
