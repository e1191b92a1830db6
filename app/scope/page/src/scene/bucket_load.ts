// SPDX-License-Identifier: Apache-2.0
/// What an excavator's bucket carries, frame by frame: what its edge has cut while the ground held
/// against it, corrected by the payload as soon as the controller tells that, and poured where the
/// bucket is opened. Loose soil, m3. Without EcuTipLoad nothing is known to be in it; what was never
/// weighed is drawn in the bucket and falls nowhere.

import type {BucketSigns} from './height_field';

export interface LoadSigns extends BucketSigns {
  tilt_rad: number;  ///< Of the bucket's mouth against level.
  free: boolean;     ///< The edge is clear of the soil, so that nothing keeps the fill in.
}

/// Of the soils that machines dig, loose: within a tenth.
export const kLoose_kgpm3 = 1450;
/// Volume of what was cut, loose, over that in the ground.
const kSwell = 1.2;
/// A bucket holds what it has up to this tilt of its mouth, and nothing at the second one.
const kHolds_rad = 0.45;
const kEmpty_rad = 1.75;
const kPours_s = 0.4;
/// Less is not told from nothing.
const kLeast_m3 = 0.02;
/// Who has cut so much and weighs nothing cuts what is only drawn.
const kNothing_m3 = 0.1;
/// Frames farther apart than this do not tell how long it poured.
const kLongest_s = 0.3;
/// Of the list of fills; the older half goes when it is full.
const kMost = 1 << 15;

export class BucketLoad {
  private fill_m3 = 0;
  private last_s = NaN;
  private weighed = false;  ///< The fill is what was weighed last.
  private is_real = false;  ///< What is cut is found in the bucket.
  private cut_m3 = 0;       ///< Since it was weighed.
  private time: number[] = [];
  private fill: number[] = [];

  constructor(readonly capacity_m3: number) {}

  get now_m3(): number {
    return this.fill_m3;
  }

  /// Takes a frame in whose way so much undisturbed soil was cut; returns the loose soil that has
  /// left the bucket: by its tilt, or because there is less in it than there was when it was
  /// weighed before.
  step(time_s: number, signs: LoadSigns, cut_m3: number): {poured_m3: number; missed_m3: number} {
    const since_s = Math.min(Math.max(time_s - this.last_s, 0) || 0, kLongest_s);
    this.last_s = time_s;
    let [poured, missed] = [0, 0];
    if (Number.isFinite(signs.payload_kg)) {
      missed = this.weigh(signs);
    } else if ((signs.resists || this.is_real) && cut_m3 > 0) {
      this.cut_m3 += cut_m3;
      this.fill_m3 = Math.min(this.capacity_m3, this.fill_m3 + kSwell * cut_m3);
      this.weighed = false;
    } else if (signs.free) {
      const too_much = this.fill_m3 - this.capacity_m3 * held_share(signs.tilt_rad);
      poured = Math.max(too_much, 0) * Math.min(since_s / kPours_s, 1);
      // The last of it falls at once.
      poured = this.fill_m3 - poured < kLeast_m3 && poured > 0 ? this.fill_m3 : poured;
      this.fill_m3 -= poured;
    }
    this.keep(time_s);
    return {poured_m3: this.is_real ? poured : 0, missed_m3: missed};
  }

  private weigh({payload_kg, deviation_kg}: LoadSigns): number {
    const doubt_m3 = 2 * Math.max(deviation_kg || 0, 0) / kLoose_kgpm3 + kLeast_m3;
    const told = Math.min(Math.max(payload_kg / kLoose_kgpm3, 0), 1.3 * this.capacity_m3);
    const fill = told < doubt_m3 ? 0 : told;
    const gone = this.fill_m3 - fill;
    const missed = this.weighed && gone > doubt_m3 ? gone : 0;
    // A fill that wanders within what is in doubt stays.
    if (fill === 0 || !this.weighed || Math.abs(gone) > 0.25 * doubt_m3) {
      this.fill_m3 = fill;
    }
    this.weighed = true;
    this.is_real = fill > 0 || (this.is_real && this.cut_m3 < kNothing_m3);
    this.cut_m3 = 0;
    return missed;
  }

  /// A machine that begins anew, at this time.
  empty(time_s: number): void {
    this.fill_m3 = 0;
    this.cut_m3 = 0;
    this.weighed = false;
    this.last_s = NaN;
    this.keep(time_s);
  }

  private keep(time_s: number): void {
    const before = this.fill.length > 0 ? this.fill[this.fill.length - 1]! : 0;
    const gone = this.fill_m3 === 0 && before !== 0;
    if (!gone && Math.abs(this.fill_m3 - before) < 0.01 * this.capacity_m3) {
      return;
    }
    if (this.time.length >= kMost) {
      this.time = this.time.slice(kMost / 2);
      this.fill = this.fill.slice(kMost / 2);
    }
    this.time.push(time_s);
    this.fill.push(this.fill_m3);
  }

  /// What was in it at a time that was taken in.
  at(time_s: number): number {
    let [low, high] = [0, this.time.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time[middle]! <= time_s) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low > 0 ? this.fill[low - 1]! : 0;
  }
}

/// Of the capacity, what a bucket holds at this tilt.
export function held_share(tilt_rad: number): number {
  const tilt = Math.abs(tilt_rad - 2 * Math.PI * Math.round(tilt_rad / (2 * Math.PI)));
  return Math.min(Math.max((kEmpty_rad - tilt) / (kEmpty_rad - kHolds_rad), 0), 1);
}
