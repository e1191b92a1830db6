// SPDX-License-Identifier: Apache-2.0
/// A hydraulic cylinder between its two pins: barrel with the cap chamber up to the piston and the
/// rod chamber from there on, and the rod.

import {Color, CylinderGeometry, Group, Mesh, Quaternion, SRGBColorSpace, Vector3} from 'three';
import {PartMaterial, type Light} from './light';
import {kOrder} from './materials';
import {pressure_colour} from './theme';
import type {SceneColours} from './theme';

export interface CylinderSize {
  bore_m: number;
  rod_m: number;
  closed_length_m: number;
  stroke_m: number;
}

/// Places along the cylinder from its base pin, m, in the right order for any stroke.
export interface CylinderPlaces {
  cap_m: number;     ///< Where the barrel begins.
  piston_m: number;
  gland_m: number;   ///< Where the barrel ends and the rod comes out.
  eye_m: number;     ///< Rod eye's pin.
}

/// What of the closed length is no barrel (eyes at both ends) goes to cap and rod eye alike; the
/// piston is at the cap when closed and at the gland when fully out.
export function cylinder_places(size: CylinderSize, length_m: number): CylinderPlaces {
  const spare = Math.max(0, size.closed_length_m - size.stroke_m);
  const cap = 0.3 * spare;
  const gland = size.closed_length_m - Math.min(0.3 * spare, 0.2);
  const stroke = Math.min(Math.max(length_m - size.closed_length_m, 0), size.stroke_m);
  const share = size.stroke_m > 0 ? stroke / size.stroke_m : 0;
  return {
    cap_m: cap, piston_m: cap + 0.06 + share * (gland - cap - 0.1), gland_m: gland,
    eye_m: length_m};
}

const kAxis = new Vector3(0, 0, 1);

export class Cylinder {
  readonly node = new Group();
  private readonly cap: Mesh<CylinderGeometry, PartMaterial>;
  private readonly ring: Mesh<CylinderGeometry, PartMaterial>;
  private readonly rod: Mesh<CylinderGeometry, PartMaterial>;
  private stale = new Color();
  private plain = new Color('#b9bfc4');

  constructor(private readonly size: CylinderSize, light: Light) {
    const barrel = 0.5 * size.bore_m + 0.02;
    this.cap = tube(barrel, light);
    this.ring = tube(barrel, light);
    this.rod = tube(0.5 * size.rod_m, light);
    this.node.add(this.cap, this.ring, this.rod);
    this.node.matrixAutoUpdate = false;
  }

  place(base: Vector3, eye: Vector3): void {
    const along = eye.clone().sub(base);
    const places = cylinder_places(this.size, along.length());
    const turn = new Quaternion().setFromUnitVectors(kAxis, along.normalize());
    this.node.matrix.compose(base, turn, new Vector3(1, 1, 1));
    this.node.matrixWorldNeedsUpdate = true;
    stretch(this.cap, places.cap_m, places.piston_m);
    stretch(this.ring, places.piston_m, places.gland_m);
    stretch(this.rod, places.gland_m, places.eye_m);
  }

  /// Base pin and rod eye as they are drawn.
  ends(): {base: Vector3; eye: Vector3} {
    return {
      base: new Vector3().setFromMatrixPosition(this.node.matrixWorld),
      eye: new Vector3(0, 0, 1).applyMatrix4(this.rod.matrixWorld)};
  }

  /// Shares of the relief's pressure; NaN: not known. Null: this cylinder has no sensors.
  show(cap_share: number | null, rod_share: number | null, stale: boolean): void {
    this.paint(this.cap.material, cap_share, stale);
    this.paint(this.ring.material, rod_share, stale);
    this.paint(this.rod.material, rod_share, stale);
  }

  private paint(material: PartMaterial, share: number | null, stale: boolean): void {
    if (share === null) {
      material.tint.copy(stale ? this.stale : this.plain);
    } else if (Number.isNaN(share)) {
      material.tint.copy(this.stale);
    } else {
      material.tint.setRGB(...pressure_colour(share), SRGBColorSpace);
    }
  }

  set_theme(colours: SceneColours): void {
    this.stale.set(colours.stale);
  }

  dispose(): void {
    for (const mesh of [this.cap, this.ring, this.rod]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
}

/// A unit tube along z from 0 to 1.
function tube(radius_m: number, light: Light): Mesh<CylinderGeometry, PartMaterial> {
  const geometry = new CylinderGeometry(radius_m, radius_m, 1, 14);
  geometry.rotateX(Math.PI / 2).translate(0, 0, 0.5);
  const mesh = new Mesh(geometry, new PartMaterial(light));
  mesh.renderOrder = kOrder.machine;
  return mesh;
}

function stretch(mesh: Mesh, from_m: number, to_m: number): void {
  mesh.position.z = from_m;
  mesh.scale.z = Math.max(to_m - from_m, 1e-3);
}
