/// What a pressure looks like: pale without, dark at the relief's pressure; grey where not known.
/// A scale that neither the machine's ochre nor path, design and fences use.

const kStops: readonly (readonly [number, number, number])[] = [
  [253, 236, 241], [250, 190, 205], [243, 121, 167], [205, 45, 140], [138, 8, 118], [66, 4, 92]];

/// sRGB, 0 .. 1, of a share of the relief's pressure; shares outside 0 .. 1 are taken for its ends.
export function pressure_colour(share: number): readonly [number, number, number] {
  const place = Math.min(Math.max(share, 0), 1) * (kStops.length - 1);
  const below = Math.min(Math.floor(place), kStops.length - 2);
  const part = place - below;
  const mixed = (i: 0 | 1 | 2): number =>
    (kStops[below]![i] * (1 - part) + kStops[below + 1]![i] * part) / 255;
  return [mixed(0), mixed(1), mixed(2)];
}

/// The whole scale from left to right.
export const pressure_gradient = (): string =>
  `linear-gradient(to right, ${kStops.map((stop) => `rgb(${stop.join(' ')})`).join(', ')})`;
