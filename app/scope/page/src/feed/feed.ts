// SPDX-License-Identifier: Apache-2.0
/// Where the frames come from: the server that the page is from, the log inside it, or a file that
/// is opened. All of it is read and parsed beside the page (worker.ts).

import type {Setup, ToServer} from '../model/api';
import type {FrameBlock} from '../model/frame_block';
import {file_setup} from './file_setup';
import type {PlainMessage, Told} from './orders';
import {make_reader, type AnyWorker} from './reader';
import FeedWorker from './worker?worker&inline';

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

export interface Feed {
  /// What cannot be sent comes back as a message of the kind 'refused'.
  send(wish: ToServer): void;
  /// Shows a candump log instead of what was shown; gzip is unpacked.
  open_file(file: File): void;
}

/// With a setup in the page its own log is shown, or, of a plan, no frames at all; else the server
/// that the page came from is asked. A page from a file without a setup waits for a file.
export function createFeed(events: FeedEvents, setup: Setup | null): Feed {
  let last = setup;
  const reader = make_reader(() => new FeedWorker() as AnyWorker, (told) => hear(told));
  const hear = (told: Told): void => {
    if (told.told === 'setup') {
      last = told.setup;
    }
    pass_on(told, events);
  };
  if (setup !== null) {
    queueMicrotask(() => events.onSetup(setup));
    if (setup.run?.log !== undefined) {
      reader.obey({order: 'packed', base64: setup.run.log});
    }
  } else if (location.protocol.startsWith('http')) {
    const url = new URL('frames', location.href);
    url.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
    reader.obey({order: 'socket', url: url.href});
  }
  return {
    send: (wish) => reader.obey({order: 'send', text: JSON.stringify(wish)}),
    open_file(file) {
      last = file_setup(last, file);
      events.onSetup(last);
      reader.obey({order: 'file', file});
    },
  };
}

/// The setup in the page's `graben-setup`, null if it is empty; throws where it is no JSON.
export function embedded_setup(page: Document): Setup | null {
  const text = page.getElementById('graben-setup')?.textContent?.trim() ?? '';
  return text === '' ? null : JSON.parse(text) as Setup;
}

function pass_on(told: Told, events: FeedEvents): void {
  switch (told.told) {
    case 'setup': return events.onSetup(told.setup);
    case 'block': return events.onFrames(told.block, told.text_bytes);
    case 'message': return events.onMessage(told.message);
    case 'opened': return events.onOpened();
    case 'closed': return events.onClosed(told.why, told.again_s);
    case 'ready': return undefined;
  }
}
