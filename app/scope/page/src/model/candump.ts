// SPDX-License-Identifier: Apache-2.0
/// candump's log format, byte by byte: `(seconds.micros) interface ID#DATA`, as can-utils and this
/// project write it. No line becomes a string or an object: an hour of 20 messages at 100 Hz is
/// seven million lines, to be read in about a second.

import {ERROR, EXTENDED, REMOTE, type FrameBlock, type ParseCount} from './frame_block';
import {
  DECIMAL, HEX, NEW_LINE, RETURN, SPACE, after_blanks, five_digits, four_hex, line_end,
} from './candump_text';
import {ParserColumns} from './parser_columns';
import {Stamp, StampOrder} from './stamps';

const HASH = 35;
const OPEN = 40;
const CLOSE = 41;
const POINT = 46;
const ZERO = 48;
const REMOTE_LETTER = 82;
const COLON = 58;
const DROPPED = 'DROPCOUNT: dropped ';
/// What follows an id on a terminal: length, bytes, and text that says no more.
const TERMINAL = /^\[(\d{1,4})\] *((?:[0-9A-Fa-f]{2}(?: +|(?=\r?$)))*)(.*?)\r?$/;
const XL = /^[0-9A-Fa-f]{2}:[0-9A-Fa-f]{2}:[0-9A-Fa-f]{8}#[0-9A-Fa-f.]*(?: [A-Z ]*)?\r?$/;

/// No line that is one is longer; the rest of a longer one is skipped, not kept.
const MOST_LINE = 1024;
const SHOWN_OF_LINE = 80;

const POWER_OF_TEN = [1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// Takes text in pieces cut anywhere and gives columns of frames.
export class CandumpParser {
  private readonly columns = new ParserColumns();
  private readonly order: StampOrder;
  private readonly data = new Uint8Array(8);
  private rest = new Uint8Array(0);  ///< Of a line whose end has not come.
  private overlong = false;
  private restart = false;
  private lines = 0;
  private malformed = 0;
  private unheard = 0;
  private first_malformed: {line: number; text: string} | null = null;
  private pending = 0;
  private lost = 0;
  private readonly held = {key: 0, length: 0, bytes: new Uint8Array(8)};

  /// A log's time goes on where its clock was set back; a live source begins anew.
  constructor(is_log = false) {
    this.order = new StampOrder(is_log);
  }

  /// Frames that `take` would give.
  get frames(): number { return this.pending; }

  feed(chunk: Uint8Array): void {
    let from = 0;
    if (this.rest.length > 0 || this.overlong) {
      from = chunk.indexOf(NEW_LINE) + 1;
      if (from === 0) {
        this.keep(chunk);
        return;
      }
      this.keep(chunk.subarray(0, from));
      this.end_of_rest();
    }
    const until = chunk.lastIndexOf(NEW_LINE) + 1;
    if (until > from) {
      this.parse(chunk, from, until);
    }
    this.keep(chunk.subarray(Math.max(from, until)));
  }

  /// The text ends: a last line without its end is one too.
  end(): void {
    if (this.rest.length > 0 || this.overlong) {
      this.keep(Uint8Array.of(NEW_LINE));
      this.end_of_rest();
    }
    this.order.end();
  }

  /// A connection was lost in the middle of a line: the next one begins with a whole one.
  forget_rest(): void {
    this.rest = new Uint8Array(0);
    this.overlong = false;
  }

  /// The frames since the last time.
  take(): FrameBlock {
    const block = {columns: this.columns.take(), count: this.count(), restart: this.restart};
    this.restart = false;
    this.pending = 0;
    return block;
  }

  private count(): ParseCount {
    return {
      lines: this.lines, malformed: this.malformed, first_malformed: this.first_malformed,
      backwards: this.order.backwards, unheard: this.unheard + this.order.garbled,
      lost: this.lost, breaks: this.order.breaks, first_break: this.order.first_break,
    };
  }

  private keep(piece: Uint8Array): void {
    if (this.overlong || piece.length === 0) {
      return;
    }
    const joined = new Uint8Array(this.rest.length + piece.length);
    joined.set(this.rest);
    joined.set(piece, this.rest.length);
    this.overlong = joined.length > MOST_LINE;
    this.rest = this.overlong ? joined.slice(0, SHOWN_OF_LINE) : joined;
  }

  private end_of_rest(): void {
    const {rest, overlong} = this;
    this.forget_rest();
    if (overlong) {
      ++this.lines;
      this.note_malformed(rest, 0, rest.length);
    } else {
      this.parse(rest, 0, rest.length);
    }
  }

  /// Whole lines: the byte before `until` ends one, so that no step below can run past it.
  private parse(text: Uint8Array, from: number, until: number): void {
    for (let at = from; at < until;) {
      const first = text[at];
      if (first === NEW_LINE || (first === RETURN && text[at + 1] === NEW_LINE)) {
        at += first === NEW_LINE ? 1 : 2;
        continue;
      }
      ++this.lines;
      const next = this.usual(text, at) || this.line(text, at) || this.dropped(text, at);
      if (next > 0) {
        at = next;
      } else {
        const end = text.indexOf(NEW_LINE, at);
        this.note_malformed(text, at, end);
        at = end + 1;
      }
    }
  }

  /// A line as all but a few are: ten digits and six, an extended id, eight bytes. Where the next
  /// one begins; 0: it may still be another line, and nothing was done.
  private usual(text: Uint8Array, at: number): number {
    if (text[at + 11] !== POINT || text[at + 18] !== CLOSE || text[at] !== OPEN ||
        text[at + 19] !== SPACE) {
      return 0;
    }
    const high = five_digits(text, at + 1);
    const low = five_digits(text, at + 6);
    const micros = five_digits(text, at + 12) * 10 + DECIMAL[text[at + 17]];
    let id_at = at + 20;
    while (text[id_at] > SPACE) {
      ++id_at;
    }
    const data_at = ++id_at + 9;
    const id_high = four_hex(text, id_at);
    const id_low = four_hex(text, id_at + 4);
    if (text[id_at - 1] !== SPACE || id_at === at + 21 || text[data_at - 1] !== HASH ||
        text[data_at + 16] !== NEW_LINE ||
        (high | low | micros | id_high | id_low) < 0 || id_high >= ERROR >>> 16) {
      return 0;
    }
    const {data} = this;
    let wrong = DECIMAL[text[at + 17]];
    for (let i = 0, digit_at = data_at; i < 8; ++i, digit_at += 2) {
      const byte = (HEX[text[digit_at]] << 4) | HEX[text[digit_at + 1]];
      data[i] = byte;
      wrong |= byte;
    }
    if (wrong < 0) {
      return 0;
    }
    const key = ((id_high << 16) | id_low | EXTENDED) >>> 0;
    this.add(key, 8, ((high * 1e5 + low) * 1e6 + micros) / 1e6);
    return data_at + 17;
  }

  /// One line. Where the next one begins; 0 where this one is none.
  private line(text: Uint8Array, from: number): number {
    let at = after_blanks(text, from);
    if (text[at] !== OPEN) {
      return 0;
    }
    let seconds = 0;
    const digits_at = ++at;
    for (let digit = text[at] - ZERO; digit >= 0 && digit <= 9; digit = text[++at] - ZERO) {
      seconds = seconds * 10 + digit;
    }
    if (text[at] !== POINT || at === digits_at || at - digits_at > 12) {
      return 0;
    }
    let fraction = 0;
    const fraction_at = ++at;
    for (let digit = text[at] - ZERO; digit >= 0 && digit <= 9; digit = text[++at] - ZERO) {
      fraction = fraction * 10 + digit;
    }
    const places = at - fraction_at;
    if (text[at] !== CLOSE || places === 0 || places > 9 || text[at + 1] !== SPACE) {
      return 0;
    }
    // Six places and ten digits before them are a whole number that a double has exactly.
    const scale = POWER_OF_TEN[places];
    const time_s = places === 6 ? (seconds * 1e6 + fraction) / 1e6 : seconds + fraction / scale;
    // Names are padded, to stand below each other.
    at = after_blanks(text, at + 1);
    const interface_at = at;
    while (text[at] > SPACE) {
      ++at;
    }
    if (text[at] !== SPACE || at === interface_at) {
      return 0;
    }
    return this.frame(text, after_blanks(text, at), time_s);
  }

  /// What candump says of frames that its socket lost.
  private dropped(text: Uint8Array, from: number): number {
    let at = from;
    for (; at < from + DROPPED.length; ++at) {
      if (text[at] !== DROPPED.charCodeAt(at - from)) {
        return 0;
      }
    }
    const digits_at = at;
    let frames = 0;
    for (let digit = text[at] - ZERO; digit >= 0 && digit <= 9; digit = text[++at] - ZERO) {
      frames = frames * 10 + digit;
    }
    if (at === digits_at || at - digits_at > 9 || text[at] !== SPACE) {
      return 0;
    }
    this.lost += frames;
    return text.indexOf(NEW_LINE, at) + 1;
  }

  private frame(text: Uint8Array, from: number, time_s: number): number {
    let at = from;
    let id = 0;
    for (let digit = HEX[text[at]]; digit >= 0; digit = HEX[text[++at]]) {
      id = (id << 4) | digit;
    }
    id >>>= 0;
    const digits = at - from;
    const is_known = digits === 8 || (digits === 3 && id <= 0x7ff);
    if (text[at] === SPACE && is_known && id < REMOTE) {
      return this.terminal_frame(text, after_blanks(text, at), digits === 8, id, time_s);
    }
    if (text[at] === HASH && digits >= 3 && digits <= 5 && text[at + 3] === COLON) {
      return this.xl_frame(text, at + 1);
    }
    if (text[at] !== HASH || !(digits === 8 || (digits === 3 && id <= 0x7ff))) {
      return 0;
    }
    ++at;
    const error_frame = digits === 8 && id >= ERROR && id < REMOTE;
    if (id >= ERROR && !error_frame) {
      return 0;
    }
    if (text[at] === HASH) {
      return this.fd_frame(text, at + 1);
    }
    let key = digits === 8 ? (id | EXTENDED) >>> 0 : id;
    let length = 0;
    if (text[at] === REMOTE_LETTER) {
      key = (key | REMOTE) >>> 0;
      const said = text[++at] - ZERO;
      if (said >= 0 && said <= 8) {
        length = said;
        ++at;
      }
      this.data.fill(0xff);
    } else {
      length = this.data_bytes(text, at);
      at += 2 * length;
    }
    const next = line_end(text, at, length);
    if (next > 0 && error_frame) {
      ++this.unheard;
    } else if (next > 0) {
      this.add(key, length, time_s);
    }
    return next;
  }

  /// Up to eight pairs of digits into `data`; how many there are.
  private data_bytes(text: Uint8Array, from: number): number {
    const {data} = this;
    let at = from;
    let length = 0;
    for (; length < 8; ++length, at += 2) {
      const byte = (HEX[text[at]] << 4) | HEX[text[at + 1]];
      if (byte < 0) {
        break;
      }
      data[length] = byte;
    }
    for (let i = length; i < 8; ++i) {
      data[i] = 0xff;
    }
    return length;
  }

  /// `[2]  AA BB  '..'` after an id: as candump writes to a terminal.
  private terminal_frame(text: Uint8Array, from: number, extended: boolean, id: number, time_s: number): number {
    const end = text.indexOf(NEW_LINE, from);
    const said = String.fromCharCode(...text.subarray(from, Math.min(end, from + MOST_LINE)));
    const match = TERMINAL.exec(said);
    if (match === null) {
      return 0;
    }
    const bytes = match[2] === '' ? [] : match[2].trim().split(/ +/).map((byte) => parseInt(byte, 16));
    const is_report = extended && id >= ERROR;
    if (bytes.length !== Number(match[1]) && match[3] !== 'remote request') {
      return 0;
    }
    if (!is_report && match[3] !== '' && !/^('|remote request$)/.test(match[3])) {
      return 0;
    }
    if (is_report || match[3] === 'remote request' || bytes.length > 8) {
      ++this.unheard;
      return end + 1;
    }
    this.data.fill(0xff);
    this.data.set(bytes);
    this.add(extended ? (id | EXTENDED) >>> 0 : id, bytes.length, time_s);
    return end + 1;
  }

  /// `81:00:00000000#` and data: a frame of CAN XL.
  private xl_frame(text: Uint8Array, from: number): number {
    const end = text.indexOf(NEW_LINE, from);
    const is_one = XL.test(String.fromCharCode(...text.subarray(from, Math.min(end, from + MOST_LINE))));
    this.unheard += is_one ? 1 : 0;
    return is_one ? end + 1 : 0;
  }

  /// `##` flags and data: whole, it is another bus's; this one's frames are classic.
  private fd_frame(text: Uint8Array, from: number): number {
    let at = from;
    while (HEX[text[at]] >= 0) {
      ++at;
    }
    const next = at > from ? line_end(text, at, 0) : 0;
    this.unheard += next > 0 ? 1 : 0;
    return next;
  }

  private add(key: number, length: number, time_s: number): void {
    const stamp = this.order.judge(time_s, this.lines);
    if (stamp === Stamp.hold) {
      Object.assign(this.held, {key, length, bytes: this.data.slice()});
      return;
    }
    if (stamp === Stamp.restart) {
      this.columns.forget_rows();
      this.pending = 0;
      this.restart = true;
    }
    if (stamp !== Stamp.use) {
      this.put(this.held.key, this.held.length, this.order.held_s, this.held.bytes);
    }
    this.put(key, length, this.order.time_s, this.data);
  }

  private put(key: number, length: number, time_s: number, data: Uint8Array): void {
    const column = this.columns.open(key, length);
    if (column === null) {
      ++this.unheard;
      return;
    }
    const row = column.rows++;
    column.time_s[row] = time_s;
    const {bytes} = column;
    const at = 8 * row;
    for (let i = 0; i < 8; ++i) {
      bytes[at + i] = data[i];
    }
    ++this.pending;
  }

  private note_malformed(text: Uint8Array, from: number, end: number): void {
    ++this.malformed;
    if (this.first_malformed === null) {
      const shown = text.subarray(from, Math.min(end, from + SHOWN_OF_LINE));
      const cut = end - from > SHOWN_OF_LINE || shown.length === SHOWN_OF_LINE ? '...' : '';
      const printed = Array.from(shown, (byte) =>
        byte >= SPACE && byte < 127 ? String.fromCharCode(byte) : '.').join('');
      this.first_malformed = {line: this.lines, text: printed.trimEnd() + cut};
    }
  }
}
