// SPDX-License-Identifier: Apache-2.0
/// What the page knows, and how what the feed says changes it.

import type {FeedEvents} from './feed/feed_events';
import type {Machine, MessageState, Setup, ToServer} from './model/api';
import type {FrameBlock} from './model/frame_block';
import {messageStates} from './model/integrity';
import {machines_of} from './model/on_bus';
import {PagePlayhead} from './model/playhead';
import {LIVE_KEEP_S, PageStore} from './model/store';
import type {Link, PageState} from './view/basics/page_state';

const LIVE_WINDOW_S = 30;
const REFUSED_MS = 8000;
/// The last of a log is its end, which is told.
const MOST_READ = 0.99;

export class State implements PageState, FeedEvents {
  setup: Setup | null = null;
  store = new PageStore();
  readonly playhead: PagePlayhead;
  machine: Machine | null = null;
  link: Link = {state: 'connecting', words: 'Connecting.'};
  dropped = 0;
  bus: PageState['bus'] = null;
  sim: PageState['sim'] = null;
  private refusal = {words: '', until_ms: 0};
  ended = false;
  loaded_share = 1;
  trouble = '';
  origin_s = 0;
  private sender: (message: ToServer) => void = () => undefined;
  private machines: readonly Machine[] = [];
  private machine_known_at = -1;

  /// With a setup in the page nothing is connected. Of a live run, frames are kept so long.
  constructor(embedded: boolean, private readonly live_keep_s = LIVE_KEEP_S) {
    const state = this;
    this.playhead = new PagePlayhead({
      get from_s() { return state.extent.from_s; },
      get until_s() { return state.extent.until_s; },
    }, !embedded);
    if (embedded) {
      this.link = {state: 'file', words: 'The log is in this page.'};
    }
  }

  /// Long enough to be read; the next wish takes it away.
  get refused(): string {
    return performance.now() < this.refusal.until_ms ? this.refusal.words : '';
  }

  send(message: ToServer): void {
    this.refusal.words = '';
    this.sender(message);
  }

  /// By whom wishes reach the server.
  send_by(sender: (message: ToServer) => void): void {
    this.sender = sender;
  }

  get extent(): {from_s: number; until_s: number} {
    const times = this.setup?.run?.truth.time_s;
    if (this.store.frames > 0 || times === undefined || times.length === 0) {
      return this.store;
    }
    return {from_s: times[0]!, until_s: times.at(-1)!};
  }

  messages(): readonly MessageState[] {
    const states = messageStates(this.store, this.playhead.now_s)
      .filter(({message}) => !this.store.is_estimate(message.name));
    return this.is_gone ? states.map((one) => ({...one, stale: true,
      integrity: 'silent' as const})) : states;
  }

  get is_gone(): boolean {
    return this.link.state === 'lost' && this.playhead.follow;
  }

  /// The machine is the one that the frames name; of a plan, which has none, the one that is given.
  know_machine(): void {
    const {setup, store} = this;
    if (setup === null || store.revision === this.machine_known_at) {
      return;
    }
    this.machine_known_at = store.revision;
    const hash = store.health.profile_hash;
    this.machine = setup.source.mode === 'plan' ? setup.machines[0] ?? null
      : this.machines.find((machine) => machine.hash === hash) ?? null;
    this.follow_clock();
  }

  onSetup(setup: Setup): void {
    const {mode} = setup.source;
    const live = mode === 'can' || mode === 'sim';
    this.setup = setup;
    this.machines = machines_of(setup);
    this.store = new PageStore(this.machines);
    this.store.keep_s = live ? this.live_keep_s : Infinity;
    this.machine = null;
    this.machine_known_at = -1;
    this.dropped = 0;
    this.bus = null;
    this.sim = null;
    this.refusal.words = '';
    this.trouble = '';
    this.ended = mode === 'plan' || (mode === 'report' && setup.run?.log === undefined);
    this.loaded_share = live || this.ended ? 1 : 0;
    this.origin_s = this.extent.from_s;
    this.playhead.playing = false;
    this.playhead.follow = live;
    this.playhead.window = live ? [-LIVE_WINDOW_S, 0] : [this.extent.from_s, this.extent.until_s];
    this.playhead.frames_came();
    this.follow_clock();
  }

  onFrames(block: FrameBlock, text_bytes: number): void {
    if (block.restart) {
      this.trouble = '';  // what could not be read is read again
    }
    const anew = block.restart || this.store.frames === 0;
    this.store.append(block);
    if (anew && this.store.frames > 0) {
      this.origin_s = this.store.from_s;
    }
    const bytes = this.setup?.source.bytes ?? 0;
    this.loaded_share = this.ended || bytes === 0 ? this.loaded_share
      : Math.min(MOST_READ, text_bytes / bytes);
    this.playhead.frames_came();
  }

  onMessage(message: Parameters<FeedEvents['onMessage']>[0]): void {
    switch (message.kind) {
      case 'dropped':
        this.dropped = message.frames;
        break;
      case 'bus':
        this.bus = {up: message.up, words: message.words};
        break;
      case 'end':
        this.ended = true;
        this.loaded_share = 1;
        this.playhead.frames_came();
        break;
      case 'sim':
        this.sim = message;
        this.follow_clock();
        break;
      case 'refused':
        this.refusal = {words: message.why, until_ms: performance.now() + REFUSED_MS};
        break;
    }
  }

  onOpened(): void {
    this.link = {state: 'open', words: 'Connected.'};
    this.dropped = 0;  // the server counts by connection
    this.follow_clock();
  }

  onClosed(why: string, again_s: number | null): void {
    if (again_s !== null) {
      this.link = {
        state: 'lost', words: `The connection to the server is lost (${why}): `
          + 'what is shown is what came before.',
      };
    } else if (this.ended && this.link.state !== 'file') {
      this.link = {state: 'file', words: 'All of the log is in this page.'};
    } else {
      this.trouble = `${why.charAt(0).toUpperCase()}${why.slice(1)}.`;
    }
    this.follow_clock();
  }

  /// A log of this computer, instead of what was shown.
  file_opened(): void {
    this.link = {state: 'file', words: 'A file of this computer.'};
  }

  /// Whether there is a picture to draw: all of a log, or as much of it as will come for now.
  get drawn(): boolean {
    return this.loaded_share === 1 || this.link.state === 'lost' || this.trouble !== '';
  }

  /// How fast time goes on where no frames come. Without the server it stands with the last of them,
  /// and everything is old at once.
  private follow_clock(): void {
    const {link, sim, playhead} = this;
    const mode = this.setup?.source.mode;
    const live = (mode === 'can' || mode === 'sim') && link.state !== 'file';
    const gone = link.state === 'connecting' || link.state === 'lost';
    const before = playhead.clock_rate;
    playhead.clock_rate = !live || gone ? 0
      : mode === 'sim' && sim?.running === true ? sim.pace
        : mode === 'can' ? 1 : 0;
    if (live && playhead.clock_rate === 0 && before > 0) {
      playhead.frames_came();  // where time stands, the newest frame is now
    }
  }
}
