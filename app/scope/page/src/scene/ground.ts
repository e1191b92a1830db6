/// What the ground looks like wherever it is: matt, with lines each metre, lost in the background
/// far away. Lines are drawn by the surface itself, so that they follow what is cut.

import {Color, type IUniform, MeshLambertMaterial, Vector2} from 'three';
import type {SceneColours} from './theme';

export interface GroundMaterial {
  surface: MeshLambertMaterial;
  /// Around where the ground is seen, m, and how far.
  set_centre(x_m: number, y_m: number, reach_m: number): void;
  set_theme(colours: SceneColours): void;
}

const kVertex = `
attribute float cutDepth;
varying float vCut;
varying vec2 vPlace;
void main() {
  vCut = cutDepth;
  vPlace = position.xy;`;

const kFragmentHead = `
uniform vec3 gridColour;
uniform vec3 cutColour;
uniform vec3 farColour;
uniform vec2 centre;
uniform float reach;
varying float vCut;
varying vec2 vPlace;
float gridLine(vec2 place, float pixels) {
  vec2 width = fwidth(place);
  vec2 off = abs(fract(place - 0.5) - 0.5) / max(width, vec2(1e-5));
  vec2 lines = clamp(pixels - off, 0.0, 1.0) * clamp(1.0 - width * 2.5, 0.0, 1.0);
  return max(lines.x, lines.y);
}
void main() {`;

const kFragmentColour = `#include <color_fragment>
  diffuseColor.rgb = mix(diffuseColor.rgb, cutColour,
    smoothstep(0.0, 0.03, vCut) * (0.65 + 0.35 * clamp(vCut, 0.0, 1.0)));
  float thin = gridLine(vPlace, 1.0);
  float thick = gridLine(vPlace / 5.0, 1.3);
  diffuseColor.rgb = mix(diffuseColor.rgb, gridColour, max(0.4 * thin, 0.75 * thick));`;

/// After the light: far away there is only the background.
const kFragmentFar = `#include <dithering_fragment>
  gl_FragColor.rgb = mix(gl_FragColor.rgb, farColour,
    smoothstep(0.45, 1.0, distance(vPlace, centre) / reach));`;

export function ground_material(): GroundMaterial {
  const surface = new MeshLambertMaterial();
  const uniforms: Record<string, IUniform> = {
    gridColour: {value: new Color()}, cutColour: {value: new Color()},
    farColour: {value: new Color()}, centre: {value: new Vector2()}, reach: {value: 20}};
  surface.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader.replace('void main() {', kVertex);
    shader.fragmentShader = shader.fragmentShader
      .replace('void main() {', kFragmentHead)
      .replace('#include <color_fragment>', kFragmentColour)
      .replace('#include <dithering_fragment>', kFragmentFar);
  };
  surface.customProgramCacheKey = () => 'ground';
  return {
    surface,
    set_centre: (x, y, reach) => {
      uniforms.centre!.value.set(x, y);
      uniforms.reach!.value = reach;
    },
    set_theme: (colours) => {
      surface.color.set(colours.ground);
      uniforms.gridColour!.value.set(colours.grid);
      uniforms.cutColour!.value.set(colours.cut);
      // Written after the conversion to the screen's colours, so it has to be one of those.
      uniforms.farColour!.value.set(colours.background).convertLinearToSRGB();
    },
  };
}
