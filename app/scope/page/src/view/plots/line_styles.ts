// SPDX-License-Identifier: Apache-2.0
/// How the lines of plots look, on the screen and in what is saved.

import type {Line} from './plots';

export const WIDTHS: Readonly<Record<Line['style'], number>> = {wanted: 3, real: 1.8, beside: 1, truth: 1.8};
export const DASHES: Partial<Record<Line['style'], number[]>> = {wanted: [2, 3], truth: [8, 4]};
