// SPDX-License-Identifier: Apache-2.0
/// Digits whose height is a third of the screen's, whatever the font. Where three of them would be
/// wider than there is room for they are made narrower, and lower only where that is not enough.

const SHARE = 1 / 3;
/// Of the width, in landscape and in portrait: the rest is the lights' and the pictures'.
const WIDE = 0.56;
const TALL = 0.8;
/// Narrower than this share of its width a digit is harder to read than a lower one.
const NARROWEST = 0.7;
const TRIED_PX = 200;

export function fit_digits(root: HTMLElement, digits: HTMLElement): void {
  const fit = (): void => {
    const pen = document.createElement('canvas').getContext('2d')!;
    const {fontFamily, fontWeight} = getComputedStyle(digits);
    pen.font = `${fontWeight} ${TRIED_PX}px ${fontFamily}`;
    const {actualBoundingBoxAscent: up, actualBoundingBoxDescent: down, width} = pen.measureText('888');
    const high = (up + down) / TRIED_PX;
    const wide = width / TRIED_PX;
    const room = (innerWidth > innerHeight ? WIDE : TALL) * innerWidth;
    const size_px = Math.min(SHARE * innerHeight / high, room / (NARROWEST * wide));
    const narrow = Math.min(1, room / (size_px * wide));
    root.style.setProperty('--digits', `${size_px}px`);
    root.style.setProperty('--digits-high', `${size_px * high}px`);
    root.style.setProperty('--digits-wide', `${narrow * size_px * wide}px`);
    root.style.setProperty('--narrow', String(narrow));
  };
  addEventListener('resize', fit);
  fit();
}
