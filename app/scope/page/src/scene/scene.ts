// SPDX-License-Identifier: Apache-2.0
/// The machine in three dimensions, as its frames have it.

import {Color, type PerspectiveCamera, Scene, Vector3 as Point} from 'three';
import type {FrameStore, Kind, Machine, Setup, Vector2, Vector3} from '../model/api';
import {Canvas} from './canvas';
import {Corner} from './corner';
import {DozerStage} from './dozer_stage';
import {ExcavatorStage} from './excavator_stage';
import type {HeightField} from './height_field';
import {Labels} from './labels';
import {SharedMaterials} from './materials';
import {without_webgl} from './no_webgl';
import type {Stage} from './types';
import {scene_colours} from './theme';
import type {SceneLayers, SceneUpdate, SceneView} from './types';
import {make_camera, ViewCamera} from './view_camera';

export type {SceneView} from './types';

const kAll: SceneLayers =
  {ghost: true, path: true, field: true, design: true, fences: true, terrain: true};

/// Fills the host, which has to have a size and to be positioned. Without WebGL it says so there,
/// and everything else does nothing.
export function createScene(host: HTMLElement): SceneView {
  const scene = new Scene();
  const camera = make_camera();
  try {
    return new DrawnScene(host, scene, camera, new Canvas(scene, camera));
  } catch (error) {
    return without_webgl(host, (error as Error).message);
  }
}

class DrawnScene implements SceneView {
  private readonly shared = new SharedMaterials();
  private readonly labels = new Labels();
  private readonly corner = new Corner();
  private readonly note = document.createElement('div');
  private readonly eye: ViewCamera;
  private stage: Stage | null = null;
  private kind: Kind | null = null;
  private layers = kAll;
  private dark = false;
  private view: SceneUpdate | null = null;
  private shown = {now_s: NaN, revision: -1, until_s: -Infinity, drives: null as unknown};
  private request = 0;
  private behind_s = 0;
  private width = 1;
  private height = 1;

  constructor(
    private readonly host: HTMLElement, private readonly scene: Scene,
    private readonly camera: PerspectiveCamera, private readonly canvas: Canvas) {
    const {element} = canvas;
    element.tabIndex = 0;
    element.setAttribute('role', 'img');
    element.setAttribute('aria-label', 'The machine as its frames have it. Arrow keys turn the ' +
      'view, plus and minus bring it nearer or farther, Home is the first view.');
    Object.assign(this.note.style, {
      position: 'absolute', left: '12px', top: '10px', font: '13px system-ui, sans-serif',
      pointerEvents: 'none'});
    if (getComputedStyle(host).position === 'static') {
      host.style.position = 'relative';
    }
    host.append(element, this.labels.node, this.corner.node, this.note);
    new ResizeObserver(() => this.resize()).observe(element);
    this.eye = new ViewCamera(camera, element, () => this.draw_soon());
    element.addEventListener('webglcontextrestored', this.draw_soon);
    this.setTheme(false);
    this.resize();
  }

  setMachine(setup: Setup, machine: Machine | null): void {
    if (this.stage) {
      this.scene.remove(this.stage.node);
      this.stage.dispose();
      this.stage = null;
    }
    for (const group of ['path', 'design', 'fences', 'scale'] as const) {
      this.labels.clear(group);
    }
    this.kind = machine?.kind ?? null;
    if (machine !== null) {
      this.stage = machine.kind === 'excavator' ?
        new ExcavatorStage(machine, setup, this.shared, this.labels) :
        new DozerStage(machine, this.shared, this.labels);
      this.scene.add(this.stage.node);
      this.stage.set_layers(this.layers);
      this.eye.set_home(this.stage.home);
    }
    this.corner.show(this.stage);
    this.setTheme(this.dark);
  }

  update(view: SceneUpdate): void {
    const {now_s, store, drives} = view;
    // What comes later than what is shown changes nothing of it: a paused picture stands.
    const settled = store.revision === this.shown.revision || this.shown.until_s > now_s;
    const same = now_s === this.shown.now_s && settled &&
      drives === this.shown.drives && store === this.view?.store;
    this.view = view;
    if (same || this.stage === null || !this.fits(store)) {
      return;
    }
    this.shown = {now_s, revision: store.revision, until_s: store.until_s, drives};
    this.stage.update(view);
    this.corner.show_key(this.stage);
    this.eye.follow(this.stage.along_m);
    this.draw_soon();
  }

  /// Frames of another kind of machine than the one that is shown say nothing of it.
  private fits(store: FrameStore): boolean {
    return store.database === null || store.database.kind === this.kind;
  }

  resize(): void {
    // On a narrow page the corner has a place of its own below the picture.
    const {element} = this.canvas;
    this.width = Math.max(element.clientWidth, 1);
    this.height = Math.max(element.clientHeight, 1);
    Object.assign(this.labels.node.style, {bottom: 'auto', height: `${this.height}px`});
    this.canvas.resize(this.width, this.height);
    this.eye.resize(this.width, this.height);
    this.draw_soon();
  }

  setTheme(dark: boolean): void {
    this.dark = dark;
    const colours = scene_colours(dark);
    this.scene.background = new Color(colours.background);
    this.note.style.color = colours.text;
    for (const part of [this.shared, this.labels, this.corner, this.stage]) {
      part?.set_theme(colours);
    }
    // Cylinders take their grey when they are shown next.
    this.show_again();
  }

  private show_again(): void {
    this.shown.now_s = NaN;
    if (this.view) {
      this.update(this.view);
    }
    this.draw_soon();
  }

  setLayers(layers: Partial<SceneLayers>): void {
    this.layers = {...this.layers, ...layers};
    for (const group of ['path', 'design', 'fences'] as const) {
      this.labels.show(group, this.layers[group]);
    }
    this.stage?.set_layers(this.layers);
    this.corner.show_key(this.stage);
    this.show_again();
  }

  resetCamera(): void {
    this.eye.go_home();
    this.draw_soon();
  }

  tip(): Vector3 | null {
    if (!this.stage?.placed) {
      return null;
    }
    const at = this.stage.tip.getWorldPosition(new Point());
    return [at.x, at.y, at.z];
  }

  tipOnScreen(): Vector2 | null {
    const tip = this.tip();
    if (tip === null) {
      return null;
    }
    this.camera.updateMatrixWorld();
    const at = new Point(...tip).project(this.camera);
    return [(0.5 + 0.5 * at.x) * this.width, (0.5 - 0.5 * at.y) * this.height];
  }

  ground(): HeightField | null {
    return this.stage?.ground.shown ?? null;
  }

  settled(): boolean {
    return this.request === 0 && this.behind_s === 0;
  }

  private readonly draw_soon = (): void => {
    this.request ||= requestAnimationFrame(() => {
      this.request = 0;
      this.draw();
    });
  };

  private draw(): void {
    this.behind_s = 0;
    if (this.stage && this.view && this.fits(this.view.store)) {
      const {behind_s} = this.stage.ground.update(this.view.store, this.view.now_s);
      this.behind_s = behind_s;
      this.note.textContent =
        behind_s > 1 ? `Soil: ${Math.ceil(behind_s)} s of frames still to be worked in` : '';
      if (behind_s > 0) {
        this.draw_soon();
      }
    }
    this.stage?.face(this.camera.position.y);
    this.canvas.draw();
    this.labels.update(this.camera, this.width, this.height);
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    this.stage?.dispose();
    this.shared.dispose();
    this.eye.dispose();
    this.canvas.dispose();
    this.host.replaceChildren();
  }
}
