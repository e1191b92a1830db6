// SPDX-License-Identifier: Apache-2.0
/// Soft light from the sky and a sun, worked out at the corners of the triangles: that is all that
/// a matt surface needs, and a computer without a graphics unit still draws it fast enough.

import {Color, type IUniform, ShaderMaterial, Vector3} from 'three';
import type {SceneColours} from './theme';

export interface Light {
  uniforms: Record<'sky' | 'soil' | 'sun' | 'sunward', IUniform>;
  set_theme(colours: SceneColours): void;
}

/// From behind the reader's left shoulder, at the first view.
const kSunward = new Vector3(-0.3, -0.52, 0.8).normalize();

export function make_light(): Light {
  const [sky, soil, sun] = [new Color(), new Color(), new Color()];
  return {
    uniforms: {
      sky: {value: sky}, soil: {value: soil}, sun: {value: sun}, sunward: {value: kSunward}},
    set_theme: (colours) => {
      sky.set(colours.sky_light).multiplyScalar(colours.sky_power);
      soil.set(colours.ground_light).multiplyScalar(colours.sky_power);
      sun.set('#ffffff').multiplyScalar(colours.sun_power);
    },
  };
}

/// For vertex shaders: what a surface of a linear colour looks like, as the screen has it.
export const kLit = `
uniform vec3 sky;
uniform vec3 soil;
uniform vec3 sun;
uniform vec3 sunward;
vec3 onScreen(vec3 colour) {
  return mix(colour * 12.92, 1.055 * pow(max(colour, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055,
    step(vec3(0.0031308), colour));
}
vec3 lit(vec3 colour, vec3 normal) {
  return onScreen(colour * (mix(soil, sky, 0.5 + 0.5 * normal.z) +
    sun * max(dot(normal, sunward), 0.0)));
}`;

const kVertex = `${kLit}
uniform vec3 tint;
uniform vec3 grey;
uniform float greyShare;
attribute vec3 color;
varying vec3 vColour;
void main() {
  vec3 own = color * tint;
  // Grey keeps what is light and dark of the part, and nothing of its colour.
  own = mix(own, grey * (0.5 + dot(own, vec3(0.3, 0.5, 0.2))), greyShare);
  vColour = lit(own, normalize(mat3(modelMatrix) * normal));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const kFragment = `
varying vec3 vColour;
void main() {
  gl_FragColor = vec4(vColour, 1.0);
}`;

/// A part of the machine: one of these each, since each may lose its colour alone.
export class PartMaterial extends ShaderMaterial {
  readonly tint = new Color(1, 1, 1);
  private readonly grey = new Color();

  constructor(light: Light) {
    // A little back, so that its outline is not half in it.
    super({
      vertexShader: kVertex, fragmentShader: kFragment,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    this.uniforms = {
      ...light.uniforms, tint: {value: this.tint}, grey: {value: this.grey},
      greyShare: {value: 0}};
  }

  set_stale(stale: boolean): void {
    this.uniforms.greyShare.value = stale ? 1 : 0;
  }

  set_theme(colours: SceneColours): void {
    this.grey.set(colours.stale);
  }
}
