// SPDX-License-Identifier: Apache-2.0
/// Reads what the page shows, wherever it comes from: the same code in a worker and, where there
/// can be none, on the page's own thread.

import {Batches} from './batches';
import type {Hear, HearOf, Order} from './orders';

/// To a server; without `say` it only listens.
export interface Connection {
  say?(text: string): void;
  close(): void;
}

export type Connect = (url: string, batches: Batches, hear: Hear) => Connection;

/// So much text is parsed before others get a turn.
const SLICE_BYTES = 256 * 1024;
const BASE64_PIECE = 1 << 20;  ///< A multiple of 4.

export class Intake {
  private readonly batches: Batches;
  private readonly hear: Hear;
  private socket: Connection | null = null;
  private turn = 0;  ///< Of the sources: an older one has nothing to say any more.

  constructor(hear: HearOf, private readonly connect: Connect) {
    this.hear = (told, transfer) => hear(told, transfer, this.turn);
    this.batches = new Batches(this.hear);
  }

  obey(order: Order): void {
    if (order.order === 'send') {
      this.say(order.text);
      return;
    }
    this.socket?.close();
    this.socket = null;
    const turn = ++this.turn;
    if (order.order === 'socket') {
      this.socket = this.connect(order.url, this.batches, this.hear);
      return;
    }
    const stream = order.order === 'file' ? file_text(order.file) : unpacked(order.base64);
    void this.read(stream, turn);
  }

  private say(text: string): void {
    if (this.socket?.say === undefined) {
      const why = 'what is shown is a file: there is nothing to steer';
      this.hear({told: 'message', message: {kind: 'refused', why}}, []);
    } else {
      this.socket.say(text);
    }
  }

  private async read(source: Promise<ReadableStream<Uint8Array>>, turn: number): Promise<void> {
    this.batches.begin(true);
    this.batches.loading = true;
    let why: string | null = null;
    try {
      const reader = (await source).getReader();
      for (let part = await reader.read(); !part.done; part = await reader.read()) {
        await this.feed(part.value, turn);
        if (turn !== this.turn) {
          await reader.cancel();
          return;
        }
      }
    } catch (error) {
      why = `the log could not be read to its end: ${(error as Error).message}`;
    }
    if (turn === this.turn) {
      this.batches.end();
      this.hear({told: 'message', message: {kind: 'end'}}, []);
      if (why !== null) {
        this.hear({told: 'closed', why, again_s: null}, []);
      }
    }
  }

  private async feed(text: Uint8Array, turn: number): Promise<void> {
    for (let from = 0; from < text.length && turn === this.turn; from += SLICE_BYTES) {
      this.batches.feed(text.subarray(from, from + SLICE_BYTES));
      if (text.length > SLICE_BYTES) {
        await breath();
      }
    }
  }
}

/// A turn for whatever else waits, without the pause that timers make.
function breath(): Promise<void> {
  return new Promise((resolve) => {
    const {port1, port2} = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}

/// A file's text; one that gzip has packed is unpacked.
async function file_text(file: Blob): Promise<ReadableStream<Uint8Array>> {
  const [first, second] = new Uint8Array(await file.slice(0, 2).arrayBuffer());
  const stream = file.stream() as ReadableStream<Uint8Array>;
  return first === 0x1f && second === 0x8b ? gunzipped(stream) : stream;
}

async function unpacked(base64: string): Promise<ReadableStream<Uint8Array>> {
  let from = 0;
  return gunzipped(new ReadableStream<Uint8Array>({
    pull(control) {
      if (from >= base64.length) {
        control.close();
        return;
      }
      const binary = atob(base64.slice(from, from + BASE64_PIECE));
      from += BASE64_PIECE;
      control.enqueue(Uint8Array.from(binary, (letter) => letter.charCodeAt(0)));
    },
  }));
}

function gunzipped(stream: ReadableStream<Uint8Array>): ReadableStream<Uint8Array> {
  const gzip = new DecompressionStream('gzip') as unknown as
    ReadableWritablePair<Uint8Array, Uint8Array>;
  return stream.pipeThrough(gzip);
}
