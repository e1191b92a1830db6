/// The vertical range of a plot: at least what the plot says, rounded to calm numbers, so that it
/// stands still while a live curve breathes.

import uPlot from 'uplot';

const STRIP_SHARE = 0.2;  ///< Below 0, for the coloured strip of limits.

export function stable_range(
  least: readonly [number, number] | undefined, strip: boolean,
): uPlot.Range.Function {
  return (_plot, data_min, data_max) => {
    let min = Number.isFinite(data_min) ? data_min : 0;
    let max = Number.isFinite(data_max) ? data_max : 1;
    if (least !== undefined) {
      min = Math.min(min, least[0]);
      max = Math.max(max, least[1]);
    }
    if (strip) {
      return [-STRIP_SHARE, Math.max(1.04, max)];
    }
    if (min === max) {
      min -= 1;
      max += 1;
    }
    const step = nice_step((max - min) / 5);
    const low = Math.floor(min / step + 1e-9) * step;
    const high = Math.ceil(max / step - 1e-9) * step;
    // A curve along the frame could be taken for the frame; one that is 0 at rest needs no room.
    return [min === low && min !== 0 ? low - step / 2 : low, max === high ? high + step / 4 : high];
  };
}

/// 1, 2 or 5 times a power of ten, not below `step`.
export function nice_step(step: number): number {
  const power = 10 ** Math.floor(Math.log10(step));
  const lead = step / power;
  return power * (lead <= 1.0001 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}
