// SPDX-License-Identifier: Apache-2.0
/// What the page and the worker that reads for it say to each other.

import type {FromServer, Setup} from '../model/api';
import type {FrameBlock} from '../model/frame_block';

export type Order =
  | {order: 'socket'; url: string}
  | {order: 'file'; file: Blob}
  | {order: 'packed'; base64: string}  ///< candump text, gzip, base64.
  | {order: 'send'; text: string};

export type PlainMessage = Exclude<FromServer, {kind: 'setup'}>;

export type Told =
  | {told: 'ready'}
  | {told: 'setup'; setup: Setup}
  | {told: 'block'; block: FrameBlock; text_bytes: number}
  | {told: 'message'; message: PlainMessage}
  | {told: 'opened'}
  /// `again_s` null: it is not tried again.
  | {told: 'closed'; why: string; again_s: number | null};

export type Hear = (told: Told, transfer: ArrayBuffer[]) => void;

/// `source` counts the orders that named one: what an older one still had to say is not heard.
export type HearOf = (told: Told, transfer: ArrayBuffer[], source: number) => void;

/// What a worker posts.
export interface Posted {
  told: Told;
  source: number;
}
