// SPDX-License-Identifier: Apache-2.0
/// Colours of the machines' parts.

import type {Paint} from './pieces';

/// The same in both themes: each stands off light and dark ground, and all off grey.
export const kPaints: Readonly<Record<Paint, string>> = {
  body: '#d9a63a',
  frame: '#60666c',
  steel: '#b9bfc4',
  glass: '#3c4a55',
  belt: '#4d5257',
  weight: '#73787d',
  soil: '#8f6d45',
};
