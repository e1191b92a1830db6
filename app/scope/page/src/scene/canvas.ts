// SPDX-License-Identifier: Apache-2.0
/// The drawing itself: how many points, and how smooth. A graphics unit smooths every picture.
/// Where the processor has to draw, that costs twice the picture itself: then pictures in motion
/// are drawn plainly, and one that stands is drawn again with four points for each.

import {type Camera, type Scene, WebGLRenderer} from 'three';

/// More points than this to a CSS pixel cost time and are not seen.
const kMostPixelRatio = 2;
/// Nothing has changed for so long: the picture stands.
const kStill_ms = 200;
/// Where even a plain picture takes longer, it has to do with fewer points while it moves.
const kSlow_ms = 34;
const kFast_ms = 20;
const kCoarse = 0.7;
/// Names of drawing programs that run on the processor.
const kSoftware = /swiftshader|llvmpipe|softpipe|software|basic render/i;

export class Canvas {
  private readonly software = is_software();
  private readonly renderer = new WebGLRenderer({antialias: !this.software});
  private still: ReturnType<typeof setTimeout> | undefined;
  private width = 1;
  private height = 1;
  private drawn_ms = 0;
  private pace_ms = kFast_ms;  ///< From picture to picture, averaged.
  private moving = 1;

  /// Throws where the browser has no WebGL.
  constructor(private readonly scene: Scene, private readonly camera: Camera) {
    Object.assign(this.element.style, {display: 'block', width: '100%', height: '100%'});
  }

  get element(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  resize(width_px: number, height_px: number): void {
    [this.width, this.height] = [width_px, height_px];
    this.size(this.software ? 1 : this.finest());
  }

  draw(): void {
    if (this.software) {
      this.choose();
      this.size(this.moving);
      clearTimeout(this.still);
      this.still = setTimeout(() => {
        this.size(kMostPixelRatio);
        this.renderer.render(this.scene, this.camera);
      }, kStill_ms);
    }
    this.renderer.render(this.scene, this.camera);
  }

  /// Points for pictures in motion, by how fast the last ones came.
  private choose(): void {
    const now_ms = performance.now();
    const since_ms = now_ms - this.drawn_ms;
    this.drawn_ms = now_ms;
    if (since_ms < kStill_ms) {
      this.pace_ms += 0.2 * (since_ms - this.pace_ms);
    }
    if (this.pace_ms > kSlow_ms) {
      this.moving = kCoarse;
    } else if (this.pace_ms < kFast_ms) {
      this.moving = 1;
    }
  }

  private finest(): number {
    return Math.min(devicePixelRatio || 1, kMostPixelRatio);
  }

  private size(ratio: number): void {
    const {element} = this;
    if (element.width !== Math.floor(this.width * ratio) ||
        element.height !== Math.floor(this.height * ratio)) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(this.width, this.height, false);
    }
  }

  dispose(): void {
    clearTimeout(this.still);
    this.renderer.dispose();
  }
}

/// By a context of its own, for smoothness has to be asked for with the first.
function is_software(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? String(context!.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return kSoftware.test(name);
}
