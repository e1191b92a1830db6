// SPDX-License-Identifier: Apache-2.0
/// Where the frames come from: the server that the page is from, the log inside it, or a file that
/// is opened. All of it is read and parsed beside the page (worker.ts).

import type {Setup, ToServer} from '../model/api';
import {file_setup} from './file_setup';
import type {Told} from './orders';
import {pass_on, server_url, type FeedEvents} from './feed_events';
import {make_reader, type AnyWorker} from './reader';
import {SteeringSocket} from './steering_socket';
import FeedWorker from './worker?worker&inline';

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
  const reader = make_reader(() => new FeedWorker() as AnyWorker,
    (url, batches, to) => new SteeringSocket(url, batches, to), (told) => hear(told));
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
    reader.obey({order: 'socket', url: server_url(location.href)});
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
