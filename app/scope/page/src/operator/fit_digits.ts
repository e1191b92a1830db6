// SPDX-License-Identifier: Apache-2.0
/// Digits whose height is a third of the screen's, whatever the font; less only where three of them
/// would be wider than the screen has room for.

const SHARE = 1 / 3;
/// Of the width, in landscape and in portrait: the rest is the lights' and the pictures'.
const WIDE = 0.56;
const TALL = 0.8;
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
    const size_px = Math.min(SHARE * innerHeight / high, room / wide);
    root.style.setProperty('--digits', `${size_px}px`);
    root.style.setProperty('--digits-high', `${size_px * high}px`);
    root.style.setProperty('--digits-wide', `${size_px * wide}px`);
  };
  addEventListener('resize', fit);
  fit();
}
