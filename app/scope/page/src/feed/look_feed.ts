// SPDX-License-Identifier: Apache-2.0
/// Frames of the server that the page came from, for a page that only looks: nothing here, nor in
/// its worker, can say anything to it.

import {pass_on, server_url, type FeedEvents} from './feed_events';
import LookWorker from './look_worker?worker&inline';
import {make_reader, type AnyWorker} from './reader';
import {ServerSocket} from './socket';

export function look(events: FeedEvents): void {
  make_reader(() => new LookWorker() as AnyWorker,
    (url, batches, hear) => new ServerSocket(url, batches, hear), (told) => pass_on(told, events))
    .obey({order: 'socket', url: server_url(location.href)});
}
