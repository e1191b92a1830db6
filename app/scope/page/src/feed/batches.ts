// SPDX-License-Identifier: Apache-2.0
/// Text in, blocks of frames out: at once where there are many, else in batches.

import {CandumpParser} from '../model/candump';
import {buffers_of} from '../model/frame_block';
import type {Hear} from './orders';

/// So many frames are a block of some megabytes, handed over without copying.
const BLOCK_FRAMES = 131072;
const LIVE_MS = 40;   ///< 25 times a second is smooth, and few enough messages.
const LOADING_MS = 150;

export class Batches {
  loading = false;  ///< Of a log: what matters is how soon all of it is there.
  private parser = new CandumpParser();
  private text_bytes = 0;
  private restart = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly hear: Hear) {}

  /// Another source: what follows has nothing to do with what came before.
  begin(is_log = false): void {
    this.parser = new CandumpParser(is_log);
    this.text_bytes = 0;
    this.restart = true;
  }

  feed(text: Uint8Array): void {
    this.parser.feed(text);
    this.text_bytes += text.length;
    if (this.parser.frames >= BLOCK_FRAMES) {
      this.flush();
    } else {
      this.timer ??= setTimeout(() => this.flush(), this.loading ? LOADING_MS : LIVE_MS);
    }
  }

  end(): void {
    this.parser.end();
    this.flush();
  }

  /// Counts go on even where no line was a frame.
  flush(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    const taken = this.parser.take();
    const block = {...taken, restart: taken.restart || this.restart};
    this.restart = false;
    this.hear({told: 'block', block, text_bytes: this.text_bytes}, buffers_of(block));
  }
}
