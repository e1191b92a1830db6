// SPDX-License-Identifier: Apache-2.0
/// What a page hears of its frames, from whichever end reads them.

import type {Setup} from '../model/api';
import type {FrameBlock} from '../model/frame_block';
import type {PlainMessage, Told} from './orders';

export interface FeedEvents {
  /// Again after a reconnect, if the server shows something else then, and for each opened file:
  /// frames that follow begin with a block that says `restart`.
  onSetup(setup: Setup): void;
  /// `text_bytes`: of the source so far, to be compared with `source.bytes`.
  onFrames(block: FrameBlock, text_bytes: number): void;
  onMessage(message: PlainMessage): void;
  /// The connection stands, again perhaps. Not of logs in the page or in files.
  onOpened(): void;
  /// With `again_s` null it is not tried again.
  onClosed(why: string, again_s: number | null): void;
}

/// Where the frames are of the server that a page came from.
export function server_url(page: string): string {
  const url = new URL('frames', page);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  return url.href;
}

export function pass_on(told: Told, events: FeedEvents): void {
  switch (told.told) {
    case 'setup': return events.onSetup(told.setup);
    case 'block': return events.onFrames(told.block, told.text_bytes);
    case 'message': return events.onMessage(told.message);
    case 'opened': return events.onOpened();
    case 'closed': return events.onClosed(told.why, told.again_s);
    case 'ready': return undefined;
  }
}
