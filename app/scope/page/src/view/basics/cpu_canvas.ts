// SPDX-License-Identifier: Apache-2.0
/// Canvases that the processor draws.

type GetContext = typeof HTMLCanvasElement.prototype.getContext;

/// What `make` makes draws its canvases on the processor. Many thin, overlapping segments are what
/// a graphics driver is slow at: a live page took 68 instead of 84 ms of processor time a frame
/// where the driver is software (SwiftShader, 1280 x 800, 2026-11-22). uPlot asks for its context
/// itself and has no option for this.
export function on_processor<T>(make: () => T): T {
  const prototype = HTMLCanvasElement.prototype;
  const own: GetContext = prototype.getContext;
  prototype.getContext = function get(this: HTMLCanvasElement, kind: string, options?: object) {
    return (own as (kind: string, options?: object) => RenderingContext | null).call(
      this, kind, kind === '2d' ? {...options, willReadFrequently: true} : options);
  } as GetContext;
  try {
    return make();
  } finally {
    prototype.getContext = own;
  }
}
