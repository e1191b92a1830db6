// SPDX-License-Identifier: Apache-2.0
/// Words as large as there is room for: none of them may be cut off, and none be under something else.

const TRIED_PX = 100;
let pen: CanvasRenderingContext2D | null = null;

/// How wide words are, in the size of their letters.
export function em_of(words: string): number {
  if (pen === null) {
    pen = document.createElement('canvas').getContext('2d')!;
    const {fontFamily, fontWeight} = getComputedStyle(document.body);
    pen.font = `${fontWeight} ${TRIED_PX}px ${fontFamily}`;
  }
  return pen.measureText(words).width / TRIED_PX;
}

/// For a style that makes a line so small that it fits: `--em`, with `more` for what is between words.
export function tell_em(line: HTMLElement, parts: readonly string[], more: number): void {
  const em = parts.reduce((sum, words) => sum + em_of(words), more);
  const told = em.toFixed(2);
  if (line.style.getPropertyValue('--em') !== told) {
    line.style.setProperty('--em', told);
  }
}

/// Smaller letters can't be read from a seat.
const LEAST_PX = 12;
const STEP = 0.94;

/// Makes the letters of a node smaller until it fits, anew when its words or the screen change.
export class Shrinking {
  private fitted = '';

  constructor(private readonly node: HTMLElement, private readonly fits: () => boolean) {}

  update(): void {
    const of = `${innerWidth} ${innerHeight} ${this.node.textContent}`;
    if (of === this.fitted) {
      return;
    }
    this.fitted = of;
    this.node.style.fontSize = '';
    let size_px = parseFloat(getComputedStyle(this.node).fontSize);
    while (!this.fits() && size_px > LEAST_PX) {
      size_px = Math.max(LEAST_PX, STEP * size_px);
      this.node.style.fontSize = `${size_px}px`;
    }
  }
}
