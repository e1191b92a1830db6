// SPDX-License-Identifier: Apache-2.0
/// Colours of the scene in the light and the dark theme, and of pressures. The machine's own are in solid.ts.

export interface SceneColours {
  background: string;
  ground: string;
  soil: string;       ///< That lies higher or lower than the land, uncut.
  cut: string;        ///< Soil that was under the start surface.
  grid: string;
  edge: string;       ///< Outlines of the machine.
  hidden: string;     ///< The same behind soil.
  stale: string;
  text: string;
  halo: string;       ///< Behind text.
  path: string;       ///< Path, field and trail.
  trail: string;
  design: string;
  over: string;       ///< Ground over its design, to be cut; under it, to be filled.
  under: string;
  fence: string;
  ghost: string;
  sky_light: string;
  ground_light: string;
  sky_power: number;
  sun_power: number;
}

export const scene_colours = (dark: boolean): SceneColours => dark ? kDark : kLight;

const kLight: SceneColours = {
  background: '#eef0f1', ground: '#e2e0da', soil: '#d3c5ad', cut: '#b08f68', grid: '#8b8880',
  edge: '#2a2c2e', hidden: '#6f5d45', stale: '#a3a7aa', text: '#26292c', halo: '#f6f7f7',
  path: '#1760c4', trail: '#0b3f8a', design: '#1c8a45', over: '#c2561b', under: '#2b62c4',
  fence: '#c62f2f', ghost: '#1f4e8c',
  sky_light: '#ffffff', ground_light: '#c9c2b6', sky_power: 0.6, sun_power: 0.56,
};

const kDark: SceneColours = {
  background: '#14171a', ground: '#33383b', soil: '#5a4c3b', cut: '#86684a', grid: '#50575c',
  edge: '#0b0c0d', hidden: '#a98a63', stale: '#6d7276', text: '#e3e6e8', halo: '#14171a',
  path: '#5aa2ff', trail: '#9cc8ff', design: '#46c878', over: '#f08a4b', under: '#6aa3ff',
  fence: '#ff6b63', ghost: '#cfe2ff',
  sky_light: '#e9eef2', ground_light: '#4a4641', sky_power: 0.55, sun_power: 0.55,
};

const kStops: readonly (readonly [number, number, number])[] = [
  [253, 236, 241], [250, 190, 205], [243, 121, 167], [205, 45, 140], [138, 8, 118], [66, 4, 92]];

/// sRGB, 0 .. 1, of a share of the relief's pressure; shares outside 0 .. 1 are taken for its ends.
export function pressure_colour(share: number): readonly [number, number, number] {
  const place = Math.min(Math.max(share, 0), 1) * (kStops.length - 1);
  const below = Math.min(Math.floor(place), kStops.length - 2);
  const part = place - below;
  const mixed = (i: 0 | 1 | 2): number =>
    (kStops[below][i] * (1 - part) + kStops[below + 1][i] * part) / 255;
  return [mixed(0), mixed(1), mixed(2)];
}

/// The whole scale from left to right.
export const pressure_gradient = (): string =>
  `linear-gradient(to right, ${kStops.map((stop) => `rgb(${stop.join(' ')})`).join(', ')})`;
