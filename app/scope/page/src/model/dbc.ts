// SPDX-License-Identifier: Apache-2.0
/// The DBC files as a database of messages and signals. Parsed by the library; what it leaves as
/// text, attributes above all, is turned into numbers here.

import {Dbc} from 'candied';
import dozer_text from '@dbc/dozer.dbc?raw';
import excavator_text from '@dbc/excavator.dbc?raw';
import type {Database, Kind, MessageDef, SignalDef} from './api';
import {aligned_byte, compile, type Extract, type Place} from './extract';

const EXTENDED = 0x80000000;

/// What of a 29-bit id says which message it is: PGN and source address; the priority above them is
/// the sender's.
export const identity_of = (id: number): number => id & 0x3ffffff;
const ID_BITS = 0x1fffffff;

type Content = ReturnType<Dbc['load']>;
type Message = Content['messages'] extends Map<string, infer M> ? M : never;
type Signal = Message['signals'] extends Map<string, infer S> ? S : never;

/// A signal with what a loop over columns needs of it.
export interface SignalLayout extends SignalDef {
  readonly place: Place;
  readonly word_at: number;  ///< Byte of an aligned 16-bit value; -1: it is none.
  readonly raw_min: number;  ///< Raw values of [min|max] that say no special value.
  readonly raw_max: number;
}

const known = new Map<Kind, Database>();
const known_before = new Map<Kind, Database>();

/// The shipped database of this kind of machine.
export function loadDatabase(kind: Kind): Database {
  return kept(known, kind, () => parseDatabase(kind, TEXT[kind]));
}

/// Versions that are read, and the first whose LimitKind has five bits: before it EcuStatus alone was
/// another, and later ones only have messages more. As log_version.hpp of identify; a log of each is in
/// tests/old_logs.
const OLDEST: Readonly<Record<Kind, number>> = {excavator: 10, dozer: 7};
const FIVE_BITS: Readonly<Record<Kind, number>> = {excavator: 11, dozer: 8};

export const oldest_version = (kind: Kind): number => OLDEST[kind];
export const is_read = (kind: Kind, version: number): boolean =>
  version >= OLDEST[kind] && version <= loadDatabase(kind).version;

/// That by which frames of a sender of this version are read.
export function databaseOf(kind: Kind, version: number): Database {
  return version >= FIVE_BITS[kind] ? loadDatabase(kind)
    : kept(known_before, kind, () => parseDatabase(kind, before(TEXT[kind])));
}

const TEXT: Readonly<Record<Kind, string>> = {excavator: excavator_text, dozer: dozer_text};

function before(text: string): string {
  return text.replace(' SG_ Mode : 0|3@', ' SG_ Mode : 0|4@')
    .replace(' SG_ LimitKind : 3|5@', ' SG_ LimitKind : 4|4@')
    .replace(/^(BA_ "Sig(Error|NotAvailable)Raw" SG_ \d+ (Mode|LimitKind)) \d+;/gm,
      (_all, signal: string, what: string) => `${signal} ${what === 'Error' ? 14 : 15};`);
}

function kept(from: Map<Kind, Database>, kind: Kind, make: () => Database): Database {
  let database = from.get(kind);
  if (database === undefined) {
    database = make();
    from.set(kind, database);
  }
  return database;
}

/// Throws an Error that names the signal where the text has one that cannot be read.
export function parseDatabase(kind: Kind, text: string): Database {
  const content = new Dbc().load(text);
  const comments = comments_of(text);
  const messages = new Map<string, MessageDef>();
  const by_id = new Map<number, MessageDef>();
  for (const message of content.messages.values()) {
    const def = message_def(message, comments);
    messages.set(def.name, def);
    by_id.set(identity_of(def.id), def);
  }
  const signal = (path: string): SignalDef => {
    const [name, of] = path.split('.');
    const found = messages.get(name)?.signals.get(of);
    if (found === undefined) {
      throw new Error(`${kind}.dbc has no signal ${path}`);
    }
    return found;
  };
  const version = Number(content.attributes.get('DbcVersion')?.value ?? content.version);
  return {kind, version, messages, by_id, signal};
}

function message_def(message: Message, comments: ReadonlyMap<string, string>): MessageDef {
  const number = (name: string): number => attribute(message.attributes, name) ?? 0;
  const signals = new Map<string, SignalDef>();
  const def: MessageDef = {
    name: message.name,
    id: (message.id & ID_BITS) >>> 0,
    sender: message.sendingNode ?? '',
    cycle_ms: number('GenMsgCycleTime'),
    data_id: number('E2EDataId'),
    max_delta: number('E2EMaxDeltaCounter'),
    signals,
  };
  if (message.id < EXTENDED || message.dlc !== 8) {
    throw new Error(`${def.name}: only extended frames of 8 bytes are known`);
  }
  for (const signal of message.signals.values()) {
    const comment = comments.get(`${message.id} ${signal.name}`) ?? '';
    signals.set(signal.name, signal_def(def, signal, comment));
  }
  return def;
}

function signal_def(message: MessageDef, signal: Signal, description: string): SignalLayout {
  const place: Place = {
    start_bit: signal.startBit,
    width: signal.length,
    order: signal.endian === 'Motorola' ? 'Motorola' : 'Intel',
    signed: signal.signed,
  };
  let raw: Extract;
  try {
    raw = compile(place);
  } catch (error) {
    throw new Error(`${message.name}.${signal.name}: ${(error as Error).message}`);
  }
  const bound = (physical: number): number =>
    Math.round((physical - signal.offset) / signal.factor);
  const raw_min = bound(signal.factor > 0 ? signal.min : signal.max);
  const raw_max = bound(signal.factor > 0 ? signal.max : signal.min);
  const says_error = says(attribute(signal.attributes, 'SigErrorRaw'), signal.length);
  const says_none = says(attribute(signal.attributes, 'SigNotAvailableRaw'), signal.length);
  return {
    name: signal.name,
    message,
    unit: signal.unit,
    factor: signal.factor,
    offset: signal.offset,
    min: signal.min,
    max: signal.max,
    states: signal.valueTable ?? new Map<number, string>(),
    description,
    raw,
    state: (value) => {
      if (value >= raw_min && value <= raw_max) {
        return 'valid';
      }
      // Neither in range nor a special value: the sender can't mean it.
      return says_none(value) && !says_error(value) ? 'notAvailable' : 'error';
    },
    place,
    word_at: aligned_byte(place, 16),
    raw_min,
    raw_max,
  };
}

/// J1939 gives a special value of two bytes or more by its top byte alone.
function says(special: number | null, width: number): (raw: number) => boolean {
  if (special === null || special < 0) {
    return () => false;
  }
  const ignored = width < 16 ? 1 : 2 ** (width - 8);
  return (raw) => Math.floor(raw / ignored) === Math.floor(special / ignored);
}

function attribute(
  attributes: ReadonlyMap<string, {value?: unknown}>, name: string): number | null {
  const value = attributes.get(name)?.value;
  return value === undefined || value === null || value === '' ? null : Number(value);
}

/// Signals' comments as they stand: the library loses a semicolon inside one.
function comments_of(text: string): Map<string, string> {
  const comments = new Map<string, string>();
  for (const match of text.matchAll(/^CM_ SG_ (\d+) (\w+) "((?:[^"\\]|\\.)*)";/gm)) {
    comments.set(`${match[1]} ${match[2]}`, match[3]);
  }
  return comments;
}
