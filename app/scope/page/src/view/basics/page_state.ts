// SPDX-License-Identifier: Apache-2.0
/// What every part of the page is shown, and what it may ask for.

import type {
  FrameStore, Machine, MessageState, Playhead, Setup, SimState, ToServer,
} from '../../model/api';

/// How the frames come.
export interface Link {
  /// 'file': all frames are in the page, nothing is connected.
  state: 'connecting' | 'open' | 'lost' | 'file';
  words: string;
}

export interface PageState {
  setup: Setup | null;
  store: FrameStore;
  playhead: Playhead;
  /// What there is to look at: the frames kept, or the times of a plan.
  readonly extent: {readonly from_s: number; readonly until_s: number};
  machine: Machine | null;
  link: Link;
  readonly is_gone: boolean;  ///< The newest is shown, and nothing newer can come.
  dropped: number;          ///< Frames that the server left out for this page.
  bus: {up: boolean; words: string} | null;
  sim: SimState | null;
  readonly refused: string;          ///< The server's last refusal; '' for none.
  ended: boolean;           ///< All of a log is here.
  loaded_share: number;     ///< Of a log that is being read; 1: all.
  trouble: string;          ///< Of a file that could not be read; '' for none.
  origin_s: number;         ///< What times are counted from: the first frame that ever came.
  /// States of all messages at the playhead.
  messages(): readonly MessageState[];
  send(message: ToServer): void;
}

/// A source that goes on by itself, so that there is a 'now' to go back to.
export function is_live(state: PageState): boolean {
  const mode = state.setup?.source.mode;
  return (mode === 'can' || mode === 'sim') && state.link.state !== 'file';
}

export interface View {
  readonly node: HTMLElement;
  update(state: PageState): void;
}
