// SPDX-License-Identifier: Apache-2.0
/// The WebSocket to the server, for as long as the page lives: lost, it is tried again. It only
/// listens; steering_socket.ts is the one that speaks.

import type {FromServer, Setup} from '../model/api';
import type {Batches} from './batches';
import type {Hear, PlainMessage} from './orders';

/// To the server a page of this subprotocol may say nothing.
const LOOKS = 'graben-look';
const FIRST_WAIT_S = 1;
const MOST_WAIT_S = 5;
const KINDS: ReadonlySet<string> =
  new Set<PlainMessage['kind']>(['dropped', 'bus', 'end', 'sim', 'refused']);

export class ServerSocket {
  protected socket: WebSocket | null = null;
  private wait_s = FIRST_WAIT_S;
  private setup_text = '';
  private mode: Setup['source']['mode'] | null = null;
  private all_there = false;
  private given_up = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private fetching: AbortController | null = null;

  constructor(private readonly url: string, private readonly batches: Batches,
              protected readonly hear: Hear, private readonly protocol = LOOKS) {
    this.open();
  }

  close(): void {
    this.given_up = true;
    this.fetching?.abort();
    clearTimeout(this.timer);
    this.socket?.close();
  }

  private open(): void {
    const socket = new WebSocket(this.url, this.protocol);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait_s = FIRST_WAIT_S;
      this.hear({told: 'opened'}, []);
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (this.given_up) {
        return;
      }
      if (typeof event.data === 'string') {
        this.text(event.data);
      } else {
        this.batches.feed(new Uint8Array(event.data));
      }
    };
    socket.onclose = (event) => this.closed(event.reason);
    this.socket = socket;
  }

  private text(text: string): void {
    let message: FromServer;
    try {
      message = JSON.parse(text) as FromServer;
    } catch {
      message = {kind: 'refused', why: 'a message of the server that is no JSON'};
    }
    if (message.kind === 'setup') {
      this.begin(text, message);
    } else if (KINDS.has(message.kind)) {
      this.hear({told: 'message', message}, []);
    }
  }

  /// The first message of every connection. A log is sent from its beginning again, a live run from
  /// the oldest that the server has kept of it.
  private begin(text: string, setup: Setup & {kind: 'setup'}): void {
    this.fetching?.abort();
    this.mode = setup.source.mode;
    this.all_there = false;
    this.batches.loading = this.mode === 'log';
    const same = text === this.setup_text;
    this.setup_text = text;
    this.batches.begin();
    if (!same) {
      const {kind: _, ...said} = setup;
      this.hear({told: 'setup', setup: said}, []);
    }
    if (setup.source.get !== undefined) {
      this.fetching = new AbortController();
      void this.fetch_log(setup.source.get, this.fetching.signal);
    }
  }

  /// A log is a file of the server's.
  private async fetch_log(path: string, signal: AbortSignal): Promise<void> {
    const url = new URL(path, this.url);
    url.protocol = url.protocol === 'wss:' ? 'https:' : 'http:';
    try {
      const answer = await fetch(url, {signal});
      if (!answer.ok || answer.body === null) {
        throw new Error(`the server answers ${answer.status}`);
      }
      const reader = answer.body.getReader();
      for (let part = await reader.read(); !part.done; part = await reader.read()) {
        if (signal.aborted) {
          return;  // the log has begun anew
        }
        this.batches.feed(part.value);
      }
      this.batches.end();
      this.all_there = true;
      this.hear({told: 'message', message: {kind: 'end'}}, []);
    } catch (error) {
      if (!signal.aborted) {
        const why = `the log could not be read to its end: ${(error as Error).message}`;
        this.hear({told: 'closed', why, again_s: null}, []);
      }
    }
  }

  private closed(reason: string): void {
    this.socket = null;
    if (this.given_up) {
      return;
    }
    const again_s = this.all_there ? null : this.wait_s;
    const why = reason !== '' ? reason : 'the server does not answer';
    this.hear({told: 'closed', why, again_s}, []);
    if (again_s !== null) {
      this.timer = setTimeout(() => this.open(), 1000 * again_s);
      this.wait_s = Math.min(MOST_WAIT_S, 2 * this.wait_s);
    }
  }
}
