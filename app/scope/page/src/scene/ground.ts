// SPDX-License-Identifier: Apache-2.0
/// What the ground looks like wherever it is: matt, with lines each metre, lost in the background
/// far away. Lines are drawn by the surface itself, so that they follow what is cut.

import {Color, type IUniform, ShaderMaterial, Vector2} from 'three';
import {kLit, type Light} from './light';
import type {SceneColours} from './theme';

const kVertex = `${kLit}
uniform vec3 landColour;
uniform vec3 soilColour;
uniform vec3 cutColour;
attribute float cutDepth;
varying vec3 vColour;
varying vec2 vPlace;
void main() {
  vPlace = position.xy;
  // Soil that lies otherwise than the land is what is to be dug.
  vec3 uncut = mix(landColour, soilColour, step(0.001, abs(position.z + cutDepth)));
  float deep = smoothstep(0.0, 0.04, cutDepth) * (0.7 + 0.3 * clamp(cutDepth, 0.0, 1.0));
  // Heaped up, it is as loose as what was cut, and lighter.
  float piled = smoothstep(0.0, 0.06, -cutDepth);
  vColour = lit(mix(mix(uncut, cutColour, deep), mix(soilColour, cutColour, 0.55), piled), normal);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const kFragment = `
uniform vec3 gridColour;
uniform vec3 farColour;
uniform vec2 centre;
uniform float reach;
varying vec3 vColour;
varying vec2 vPlace;
void main() {
  // The nearest line each way, how many points off it is, and whether it is a fifth one. Lines
  // nearer to each other than some points would only shimmer.
  vec2 width = fwidth(vPlace);
  vec2 line = floor(vPlace + 0.5);
  vec2 fifth = step(abs(line - 5.0 * floor(0.2 * line + 0.5)), vec2(0.5));
  vec2 strength = mix(0.4 - width, 0.75 - 0.4 * width, fifth);
  vec2 shown = clamp(1.2 - abs(vPlace - line) / width, 0.0, 1.0) * max(strength, 0.0);
  vec3 colour = mix(vColour, gridColour, max(shown.x, shown.y));
  vec2 off = (vPlace - centre) / reach;
  gl_FragColor = vec4(mix(colour, farColour, clamp(1.6 * dot(off, off) - 0.2, 0.0, 1.0)), 1.0);
}`;

export class GroundMaterial extends ShaderMaterial {
  constructor(light: Light) {
    super({vertexShader: kVertex, fragmentShader: kFragment});
    const colour = (): IUniform => ({value: new Color()});
    this.uniforms = {
      ...light.uniforms, landColour: colour(), soilColour: colour(), cutColour: colour(),
      gridColour: colour(), farColour: colour(), centre: {value: new Vector2()},
      reach: {value: 20}};
  }

  /// Around where the ground is seen, and how far.
  set_centre(x_m: number, y_m: number, reach_m: number): void {
    this.uniforms.centre.value.set(x_m, y_m);
    this.uniforms.reach.value = reach_m;
  }

  set_theme(colours: SceneColours): void {
    this.uniforms.landColour.value.set(colours.ground);
    this.uniforms.soilColour.value.set(colours.soil);
    this.uniforms.cutColour.value.set(colours.cut);
    // Mixed after the light, in the screen's colours.
    this.uniforms.gridColour.value.set(colours.grid).convertLinearToSRGB();
    this.uniforms.farColour.value.set(colours.background).convertLinearToSRGB();
  }
}
