// SPDX-License-Identifier: Apache-2.0
/// Numbers and times in words.

const SINCE1970_S = 1e8;  ///< Stamps from 1973 on are taken for seconds since 1970.

/// With a true minus sign and narrow spaces between thousands.
export function fixed(value: number, digits: number): string {
  if (!Number.isFinite(value)) {
    return '–';
  }
  const [whole, part] = Math.abs(value).toFixed(digits).split('.');
  const grouped = whole!.replace(/\B(?=(\d{3})+$)/g, '\u202f');
  const words = part === undefined ? grouped : `${grouped}.${part}`;
  return value < 0 && Number(words.replace(/\u202f/g, '')) !== 0 ? `\u2212${words}` : words;
}

export function count(value: number): string {
  return fixed(value, 0);
}

/// As many digits behind the point as a signal resolves, at most four.
export function digits_of(factor: number): number {
  for (let digits = 0; digits < 4; ++digits) {
    const scaled = Math.abs(factor) * 10 ** digits;
    if (scaled >= 0.999999 && Math.abs(scaled - Math.round(scaled)) < 1e-6) {
      return digits;
    }
  }
  return 4;
}

/// Units as they are read, not as a DBC file can write them.
export function unit_words(unit: string): string {
  return unit === 'per mille' ? '‰' : unit === 'us' ? 'µs'
    : unit.replace('m3', 'm³').replace('s2', 's²');
}

/// Hours only where there are some: 0:12.34, 1:02:03.40.
export function time_words(time_s: number, digits = 2): string {
  if (!Number.isFinite(time_s)) {
    return '–';
  }
  const scale = 10 ** digits;
  const ticks = Math.round(Math.abs(time_s) * scale);
  const seconds = (ticks % (60 * scale)) / scale;
  const minutes = Math.floor(ticks / (60 * scale));
  const padded = seconds.toFixed(digits).padStart(digits > 0 ? digits + 3 : 2, '0');
  const hours = Math.floor(minutes / 60);
  const head = hours > 0
    ? `${hours}:${String(minutes % 60).padStart(2, '0')}`
    : String(minutes);
  return `${time_s < 0 && ticks > 0 ? '\u2212' : ''}${head}:${padded}`;
}

/// Date and time of day of a stamp since 1970, in this computer's time zone; else nothing.
export function date_words(stamp_s: number): string {
  if (!Number.isFinite(stamp_s) || stamp_s < SINCE1970_S) {
    return '';
  }
  const at = new Date(stamp_s * 1000);
  const two = (value: number) => String(value).padStart(2, '0');
  const day = `${at.getFullYear()}-${two(at.getMonth() + 1)}-${two(at.getDate())}`;
  const time = `${two(at.getHours())}:${two(at.getMinutes())}:${two(at.getSeconds())}`;
  return `${day} ${time}.${String(at.getMilliseconds()).padStart(3, '0')}`;
}

export function hash_words(hash: number): string {
  return `0x${(hash >>> 0).toString(16).toUpperCase().padStart(8, '0')}`;
}

/// BoomCapPressure -> Boom cap pressure.
export function name_words(name: string): string {
  const words = name.replace(/([a-z0-9])([A-Z])/g, '$1 $2').toLowerCase();
  return words.charAt(0).toUpperCase() + words.slice(1);
}
