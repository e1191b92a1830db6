// SPDX-License-Identifier: Apache-2.0
/// The frames that the page has, by message: everything that it shows is asked of here.

import type {
  Curve, Database, FrameStore, Kind, LogHealth, Machine, MessageDef, Reading, Rows,
} from './api';
import {Broadcasts, is_dm1, is_transport} from './broadcasts';
import {BusEstimate} from './bus_frames';
import {bits_in_second} from './bus_load';
import {EMPTY, make_curve} from './curve';
import {databaseOf, identity_of, loadDatabase, type SignalLayout} from './dbc';
import {ImuEstimate} from './imu_frames';
import {EXTENDED, REMOTE, type FrameBlock, type ParseCount} from './frame_block';
import {Series} from './series';

/// Messages that only one kind of machine has.
const OWN_MESSAGE: readonly (readonly [Kind, string])[] =
  [['excavator', 'BoomStroke'], ['dozer', 'BladeStroke']];
/// What IMUs or a bus of the machine's own may stand in for.
const STROKES = ['BoomStroke', 'ArmStroke', 'BucketStroke'];
/// What a live bus is remembered of unless told.
export const LIVE_KEEP_S = 600;
/// Trimmed so rarely that it costs nothing.
const TRIM_EVERY_S = 5;
/// An hour of a fault that comes and goes ten times a second.
const MOST_FAULTS = 40_000;
const MOST_CURVES = 256;

const NOTHING: ParseCount =
  {lines: 0, malformed: 0, first_malformed: null, backwards: 0, unheard: 0,
    lost: 0, breaks: 0, first_break: null};
const NEVER: Reading = {value: NaN, raw: 0, state: 'never', age_s: Infinity};

/// Frames as all messages of ours are: 29 bits, 8 bytes, no remote ones.
const is_data = ({key, length}: Series): boolean =>
  key >= EXTENDED && key < EXTENDED + REMOTE && length === 8;

/// Columns are taken over, not copied. Stamps never go back within a store: the parser sees to it
/// (stamps.ts) and says with a block's `restart` that what came before is of another time; then
/// the store begins anew.
export class PageStore implements FrameStore {
  /// Infinity: everything, as of a log. Frames older than the newest by more than this go.
  keep_s = Infinity;

  private readonly series = new Map<number, Series>();
  private readonly signals = new Map<string, {def: SignalLayout; series: Series | null}>();
  private readonly curves = new Map<string, {key: string; curve: Curve}>();
  private estimate: ImuEstimate | BusEstimate | null = null;
  private readonly estimated = new Map<string, Series>();
  private readonly broadcasts = new Broadcasts();
  private found_faults: {time_s: number; code: number}[] = [];
  private faults_read = 0;  ///< Of the frames ever seen of EcuStatus.
  private last_fault = 0;
  private first_ready_s = Infinity;
  private known: Database | null = null;
  private count: ParseCount = NOTHING;
  private oldest_s = Infinity;
  private newest_s = -Infinity;
  private changes = 0;
  private seen = 0;

  /// The machines, where they are known, tell the kind by their hash too.
  constructor(private readonly machines: readonly Machine[] = []) {}

  get database(): Database | null { return this.known; }
  get from_s(): number { return this.seen > 0 ? this.oldest_s : 0; }
  get until_s(): number { return this.seen > 0 ? this.newest_s : 0; }
  get frames(): number { return this.seen; }
  get revision(): number { return this.changes; }

  append(block: FrameBlock): void {
    if (block.restart) {
      this.clear();
    }
    this.count = block.count;
    ++this.changes;
    for (const {key, length, time_s, bytes} of block.columns) {
      const rows = time_s.length;
      if (rows === 0) {
        continue;
      }
      this.seen += rows;
      this.series_at(key, length).append(time_s, bytes);
      this.oldest_s = Math.min(this.oldest_s, time_s[0]);
      this.newest_s = Math.max(this.newest_s, time_s[rows - 1]);
    }
    const had_any = this.broadcasts.any;
    this.broadcasts.take(block.columns);
    if (this.broadcasts.any !== had_any) {
      this.signals.clear();
    }
    this.known ??= this.tell_database();
    this.heed_version();
    this.estimate_strokes();
    this.read_faults();
    if (this.newest_s - this.oldest_s > this.keep_s + TRIM_EVERY_S) {
      this.trim(this.keep_s);
    }
  }

  /// All is forgotten but how the source was so far.
  clear(): void {
    this.series.clear();
    this.signals.clear();
    this.curves.clear();
    this.estimate = null;
    this.estimated.clear();
    this.broadcasts.clear();
    this.found_faults = [];
    this.faults_read = 0;
    this.last_fault = 0;
    this.first_ready_s = Infinity;
    this.known = null;
    this.oldest_s = Infinity;
    this.newest_s = -Infinity;
    this.seen = 0;
    ++this.changes;
  }

  /// Forgets what is older than the newest frame by more than this, in whole pieces.
  trim(keep_s: number): void {
    const before_s = this.newest_s - keep_s;
    if (!(before_s > this.oldest_s)) {
      return;
    }
    for (const series of [...this.series.values(), ...this.estimated.values(), this.broadcasts.all]) {
      series.drop_before(before_s);
    }
    this.oldest_s = before_s;
    ++this.changes;
  }

  is_estimate(message: string): boolean { return this.estimated.has(message); }

  rows(message: string): Rows {
    const def = this.known?.messages.get(message);
    return (def && this.series_of(def)) ?? NO_ROWS;
  }

  reading(signal: string, time_s: number): Reading {
    const found = this.signal(signal);
    const row = found?.series?.at(time_s) ?? -1;
    if (found === null || found.series === null || row < 0) {
      return NEVER;
    }
    const {buffer, at} = found.series.bytes(row);
    const raw = found.def.raw(buffer, at);
    const state = found.def.state(raw);
    const value = state === 'valid' ? raw * found.def.factor + found.def.offset : NaN;
    return {value, raw, state, age_s: time_s - found.series.time(row)};
  }

  curve(signal: string, from_s: number, until_s: number, buckets: number): Curve {
    const found = this.signal(signal);
    if (found === null || found.series === null) {
      return EMPTY;
    }
    const slot = `${signal} ${buckets}`;
    const key = `${this.changes} ${from_s} ${until_s}`;
    const kept = this.curves.get(slot);
    if (kept?.key === key) {
      return kept.curve;
    }
    if (this.curves.size >= MOST_CURVES) {
      this.curves.clear();
    }
    const curve = make_curve(found.series, found.def, from_s, until_s, buckets);
    this.curves.set(slot, {key, curve});
    return curve;
  }

  bus_load(time_s: number, bitrate: number): number {
    return bitrate > 0 ? bits_in_second(this.series.values(), time_s) / bitrate : NaN;
  }

  faults(): readonly {time_s: number; code: number}[] { return this.found_faults; }

  get ready_s(): number { return this.first_ready_s; }

  get health(): LogHealth {
    let foreign = this.count.unheard;
    for (const series of this.series.values()) {
      const is_known = this.def_of(series) !== null || is_transport(series.key);
      foreign += this.known !== null && !is_known ? series.seen : 0;
    }
    const {lines, malformed, first_malformed, backwards, lost, breaks, first_break} = this.count;
    return {
      lines, malformed, first_malformed, foreign, backwards, lost, breaks, first_break,
      profile_hash: this.identity('ProfileHash'), dbc_version: this.identity('DbcVersion'),
    };
  }

  /// What the controller, or else the machine, last said of itself.
  private identity(signal: string): number | null {
    for (const message of ['EcuIdentity', 'MachineIdentity']) {
      const reading = this.reading(`${message}.${signal}`, this.until_s);
      if (reading.state === 'valid') {
        return reading.value;
      }
    }
    return null;
  }

  private series_at(key: number, length: number): Series {
    const place = 16 * key + length;
    let series = this.series.get(place);
    if (series === undefined) {
      series = new Series(key, length);
      this.series.set(place, series);
      this.signals.clear();
    }
    return series;
  }

  private series_of(message: MessageDef): Series | null {
    if (this.broadcasts.any && is_dm1(message.id)) {
      return this.broadcasts.all;
    }
    return this.series.get(16 * (message.id + EXTENDED) + 8) ?? this.at_other_priority(message)
      ?? this.estimated.get(message.name) ?? null;
  }

  private at_other_priority(message: MessageDef): Series | undefined {
    return [...this.series.values()].find((series) =>
      is_data(series) && identity_of(series.key) === identity_of(message.id));
  }

  private def_of(series: Series): MessageDef | null {
    return (is_data(series) && this.known?.by_id.get(identity_of(series.key))) || null;
  }

  /// Null where the database, if there is one, has no such signal.
  private signal(path: string): {def: SignalLayout; series: Series | null} | null {
    let found = this.signals.get(path);
    if (found === undefined && this.known !== null) {
      const [message, name] = path.split('.');
      const def = this.known.messages.get(message)?.signals.get(name) as SignalLayout | undefined;
      if (def === undefined) {
        return null;
      }
      found = {def, series: this.series_of(def.message)};
      this.signals.set(path, found);
    }
    return found ?? null;
  }

  /// Of a machine that the frames name, and that has sent no stroke.
  private estimate_strokes(): void {
    if (this.known?.kind !== 'excavator') {
      return;
    }
    const {messages} = this.known;
    const defs = STROKES.map((name) => messages.get(name)!);
    if (this.estimate === null) {
      const hash = this.identity('ProfileHash');
      const machine = this.machines.find((one) => one.hash === hash);
      if (machine?.kind !== 'excavator' || defs.some((def) => this.series_of(def) !== null)) {
        return;
      }
      const has_links = (machine.bus?.messages.length ?? 0) > 0;
      this.estimate = has_links ? new BusEstimate(machine) : new ImuEstimate(machine);
    }
    const into = STROKES.map((name, k) => this.estimated.get(name)
      ?? new Series(defs[k].id + EXTENDED, 8));
    this.estimate.go_on(this.series.values(), defs, into);
    if (this.estimated.size === 0 && into[0].count > 0) {
      STROKES.forEach((name, k) => this.estimated.set(name, into[k]));
      this.signals.clear();
    }
  }

  private tell_database(): Database | null {
    for (const [kind, message] of OWN_MESSAGE) {
      const database = loadDatabase(kind);
      const def = database.messages.get(message);
      if (def !== undefined && this.series_of(def) !== null) {
        return database;
      }
    }
    return this.tell_by_hash();
  }

  /// Frames are kept as they came: once the sender has said its version, all are read by it. What
  /// faults are read from is the same in all that are read.
  private heed_version(): void {
    const version = this.known === null ? null : this.identity('DbcVersion');
    const database = version === null ? this.known : databaseOf(this.known!.kind, version);
    if (database !== this.known) {
      this.known = database;
      this.signals.clear();
    }
  }

  /// Both kinds say who they are by the same frames.
  private tell_by_hash(): Database | null {
    this.known = loadDatabase('excavator');
    const hash = this.identity('ProfileHash');
    this.known = null;
    this.signals.clear();
    const machine = this.machines.find((one) => one.hash === hash);
    return machine === undefined ? null : loadDatabase(machine.kind);
  }

  /// From the frames that came since the last time: a fault begins where the number changes. What a
  /// controller that has never been ready still waits for, is none.
  private read_faults(): void {
    const found = this.signal('EcuStatus.Fault');
    const mode = this.signal('EcuStatus.Mode');
    if (found === null || found.series === null || mode === null) {
      return;
    }
    const {def, series} = found;
    const dropped = series.seen - series.count;
    for (let row = Math.max(0, this.faults_read - dropped); row < series.count; ++row) {
      const {buffer, at} = series.bytes(row);
      const code = def.raw(buffer, at);
      if (this.first_ready_s === Infinity) {
        const raw = mode.def.raw(buffer, at);
        if (raw === 0 || mode.def.state(raw) !== 'valid') {
          continue;
        }
        this.first_ready_s = series.time(row);
      }
      if (def.state(code) !== 'valid' || code === this.last_fault) {
        continue;
      }
      this.last_fault = code;
      if (code !== 0) {
        this.found_faults.push({time_s: series.time(row), code});
      }
    }
    this.faults_read = series.seen;
    this.found_faults.splice(0, this.found_faults.length - MOST_FAULTS);
  }
}

const NO_ROWS: Rows = {
  count: 0,
  time: (index) => { throw new RangeError(`row ${index} of 0`); },
  at: () => -1,
  bytes: (index) => { throw new RangeError(`row ${index} of 0`); },
};
