/// A hydraulic cylinder between its two pins: barrel with the cap chamber up to the piston and the
/// rod chamber from there on, and the rod.

import {
  Color, CylinderGeometry, Group, Mesh, MeshLambertMaterial, Quaternion, SRGBColorSpace, Vector3,
} from 'three';
import {type CylinderSize, cylinder_places} from './cylinder_places';
import {kOrder} from './materials';
import {pressure_colour} from './pressure_colour';
import type {SceneColours} from './theme';

const kAxis = new Vector3(0, 0, 1);

export class Cylinder {
  readonly node = new Group();
  private readonly cap: Mesh<CylinderGeometry, MeshLambertMaterial>;
  private readonly ring: Mesh<CylinderGeometry, MeshLambertMaterial>;
  private readonly rod: Mesh<CylinderGeometry, MeshLambertMaterial>;
  private stale = new Color();
  private plain = new Color('#b9bfc4');

  constructor(private readonly size: CylinderSize) {
    const barrel = 0.5 * size.bore_m + 0.02;
    this.cap = tube(barrel);
    this.ring = tube(barrel);
    this.rod = tube(0.5 * size.rod_m);
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

  /// Shares of the relief's pressure; NaN: not known. Null: this cylinder has no sensors.
  show(cap_share: number | null, rod_share: number | null, stale: boolean): void {
    this.paint(this.cap.material, cap_share, stale);
    this.paint(this.ring.material, rod_share, stale);
    this.paint(this.rod.material, rod_share, stale);
  }

  private paint(material: MeshLambertMaterial, share: number | null, stale: boolean): void {
    if (share === null) {
      material.color.copy(stale ? this.stale : this.plain);
    } else if (Number.isNaN(share)) {
      material.color.copy(this.stale);
    } else {
      material.color.setRGB(...pressure_colour(share), SRGBColorSpace);
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
function tube(radius_m: number): Mesh<CylinderGeometry, MeshLambertMaterial> {
  const geometry = new CylinderGeometry(radius_m, radius_m, 1, 14);
  geometry.rotateX(Math.PI / 2).translate(0, 0, 0.5);
  const mesh = new Mesh(geometry, new MeshLambertMaterial());
  mesh.renderOrder = kOrder.machine;
  return mesh;
}

function stretch(mesh: Mesh, from_m: number, to_m: number): void {
  mesh.position.z = from_m;
  mesh.scale.z = Math.max(to_m - from_m, 1e-3);
}
