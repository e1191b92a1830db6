// SPDX-License-Identifier: Apache-2.0
/// The reader's eye: turned by mouse, touch and keys about what is looked at.

import {MOUSE, PerspectiveCamera, Sphere, TOUCH, Vector3 as Point} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

const kTurn_rad = 0.09;   ///< One press of an arrow key.
const kNearer = 0.9;      ///< One press of + or -.
const kField_deg = 32;
/// From the machine's right and from ahead, so that x goes to the right as in every plot.
const kFirst = new Point(0.42, -1, 0.34).normalize();
/// Nearer to the ground than this nothing is to be told apart.
const kLowest_rad = 0.49 * Math.PI;

export function make_camera(): PerspectiveCamera {
  const camera = new PerspectiveCamera(kField_deg, 1, 0.1, 400);
  camera.up.set(0, 0, 1);
  return camera;
}

export class ViewCamera {
  private readonly controls: OrbitControls;
  private home = new Sphere(new Point(3, 0, 1), 6);
  private followed = 0;
  private touched = false;
  private aspect = 1;

  constructor(
    private readonly camera: PerspectiveCamera, private readonly element: HTMLElement,
    changed: () => void) {
    this.controls = new OrbitControls(this.camera, element);
    this.controls.maxPolarAngle = kLowest_rad;
    this.controls.minDistance = 2;
    this.controls.maxDistance = 120;
    this.controls.zoomToCursor = true;
    this.controls.rotateSpeed = 0.6;
    this.controls.mouseButtons =
      {LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN};
    this.controls.touches = {ONE: TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN};
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => {
      this.touched = true;
    });
    element.addEventListener('keydown', this.on_key);
  }

  /// What the first view, and Home, has to hold. It is taken at once unless the reader has chosen
  /// a view already.
  set_home(sphere: Sphere): void {
    this.home = sphere.clone();
    if (!this.touched) {
      this.go_home();
    }
  }

  go_home(): void {
    this.touched = false;
    const {center, radius} = this.home;
    const half = 0.5 * kField_deg * Math.PI / 180;
    // What is to be seen lies flat: on a wide screen its width decides, on a tall one too.
    const narrow = Math.min(1, 0.62 * this.aspect);
    const distance = radius / (Math.sin(half) * (this.aspect > 1 ? 1.18 : narrow * 1.6));
    this.controls.target.copy(center).setX(center.x + this.followed);
    this.camera.position.copy(kFirst).multiplyScalar(distance).add(this.controls.target);
    this.controls.update();
  }

  /// Goes along with a machine that has driven so far.
  follow(along_m: number): void {
    const moved = along_m - this.followed;
    if (moved !== 0) {
      this.followed = along_m;
      this.camera.position.x += moved;
      this.controls.target.x += moved;
      this.controls.update();
    }
  }

  resize(width_px: number, height_px: number): void {
    this.aspect = width_px / Math.max(height_px, 1);
    this.camera.aspect = this.aspect;
    this.camera.updateProjectionMatrix();
    if (!this.touched) {
      this.go_home();
    }
  }

  private readonly on_key = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.altKey || event.metaKey) {
      return;
    }
    const act = this.act_of(event.key);
    if (act) {
      this.touched = event.key !== 'Home';
      act();
      this.controls.update();
      event.preventDefault();
      event.stopPropagation();
    }
  };

  private act_of(key: string): (() => void) | null {
    switch (key) {
      case 'ArrowLeft': return () => this.turn(kTurn_rad, 0);
      case 'ArrowRight': return () => this.turn(-kTurn_rad, 0);
      case 'ArrowUp': return () => this.turn(0, -kTurn_rad);
      case 'ArrowDown': return () => this.turn(0, kTurn_rad);
      case '+': case '=': return () => this.near(kNearer);
      case '-': case '_': return () => this.near(1 / kNearer);
      case 'Home': return () => this.go_home();
      default: return null;
    }
  }

  private turn(around_rad: number, down_rad: number): void {
    const off = this.camera.position.clone().sub(this.controls.target);
    const radius = off.length();
    const angle = Math.atan2(off.y, off.x) + around_rad;
    const polar = Math.min(Math.max(Math.acos(off.z / radius) + down_rad, 0.02), kLowest_rad);
    off.set(Math.sin(polar) * Math.cos(angle), Math.sin(polar) * Math.sin(angle),
      Math.cos(polar)).multiplyScalar(radius);
    this.camera.position.copy(this.controls.target).add(off);
  }

  private near(factor: number): void {
    const off = this.camera.position.clone().sub(this.controls.target);
    const radius = Math.min(Math.max(off.length() * factor, this.controls.minDistance),
      this.controls.maxDistance);
    this.camera.position.copy(this.controls.target).add(off.setLength(radius));
  }

  dispose(): void {
    this.element.removeEventListener('keydown', this.on_key);
    this.controls.dispose();
  }
}
