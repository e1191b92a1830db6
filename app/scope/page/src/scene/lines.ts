// SPDX-License-Identifier: Apache-2.0
/// Lines that are some pixels wide, with a thin copy where soil hides them.

import {Color, GreaterDepth, Group} from 'three';
import {LineMaterial} from 'three/examples/jsm/lines/LineMaterial.js';
import {LineSegments2} from 'three/examples/jsm/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type {Vector3} from '../model/api';
import {kOrder} from './materials';

export interface LineLook {
  width_px: number;
  /// Shown through soil, as a third of its colour.
  seen_through: boolean;
  dashed?: boolean;
}

/// Segments: each two points are one.
export class Lines {
  readonly node = new Group();
  private geometry = new LineSegmentsGeometry();
  private readonly material: LineMaterial;
  private readonly behind: LineMaterial | null;
  private readonly objects: LineSegments2[];

  constructor(look: LineLook, segments: readonly Vector3[] = []) {
    const dash = look.dashed ? {dashed: true, dashSize: 0.12, gapSize: 0.09} : {};
    this.material = new LineMaterial({linewidth: look.width_px, ...dash});
    this.objects = [object(this.geometry, this.material, kOrder.lines)];
    this.behind = look.seen_through ? new LineMaterial({
      linewidth: Math.max(1.2, 0.6 * look.width_px), depthFunc: GreaterDepth, depthWrite: false,
    }) : null;
    if (this.behind) {
      this.objects.push(object(this.geometry, this.behind, kOrder.hidden));
    }
    this.node.add(...this.objects);
    this.set(segments);
  }

  set(segments: readonly Vector3[], shades?: readonly number[]): void {
    this.node.visible = segments.length > 1;
    if (!this.node.visible) {
      return;
    }
    // A geometry keeps the size that it was made with.
    this.geometry.dispose();
    this.geometry = new LineSegmentsGeometry();
    this.geometry.setPositions(new Float32Array(segments.flat()));
    if (shades) {
      this.geometry.setColors(new Float32Array(shades));
      this.material.vertexColors = true;
    }
    for (const line of this.objects) {
      line.geometry = this.geometry;
      if (this.material.dashed) {
        line.computeLineDistances();
      }
    }
  }

  set_colour(colour: string, soil: string): void {
    this.material.color.set(colour);
    this.behind?.color.copy(new Color(colour).lerp(new Color(soil), 0.3));
  }

  /// With shades: they are the colours themselves.
  set_shaded(): void {
    this.material.color.set('#ffffff');
  }

  dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
    this.behind?.dispose();
  }
}

function object(
  geometry: LineSegmentsGeometry, material: LineMaterial, order: number): LineSegments2 {
  const line = new LineSegments2(geometry, material);
  line.renderOrder = order;
  line.frustumCulled = false;
  return line;
}

/// A chain of points as segments.
export function chained(points: readonly Vector3[], closed = false): Vector3[] {
  const segments: Vector3[] = [];
  for (let i = 1; i < points.length; ++i) {
    segments.push(points[i - 1], points[i]);
  }
  if (closed && points.length > 2) {
    segments.push(points[points.length - 1], points[0]);
  }
  return segments;
}
