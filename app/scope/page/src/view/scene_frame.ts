/// The scene and its layers; in a browser without WebGL the rest of the page goes on without it.

import {createScene} from '../scene/scene';
import type {SceneView} from '../scene/types';
import {el} from './dom';
import {layer_bar, LAYERS, type Layer} from './layers';
import {lower_bound} from './curves';
import {is_live, type PageState} from './page_state';
import type {ThemeSwitch} from './theme';

export class SceneFrame {
  readonly node = el('div', {class: 'scene-host'});
  readonly layers: HTMLElement;
  private readonly view: SceneView | null;
  private readonly shown = Object.fromEntries(
    LAYERS.map((layer) => [layer, true])) as Record<Layer, boolean>;
  private shown_for: unknown = null;
  private sized = false;

  constructor(theme: ThemeSwitch) {
    this.view = this.make();
    this.layers = layer_bar(this.shown, () => this.view?.setLayers(this.shown),
      () => this.view?.resetCamera());
    this.view?.setTheme(theme.dark);
    theme.on_change(() => this.view?.setTheme(theme.dark));
    new ResizeObserver(() => {
      this.sized = false;
    }).observe(this.node);
  }

  frame(state: PageState): void {
    const {setup, machine, store, playhead} = state;
    if (this.view === null || setup === null) {
      return;
    }
    if (!this.sized) {
      this.sized = true;
      this.view.resize();
    }
    const key = `${machine?.hash}`;
    if (this.shown_for !== key) {
      this.shown_for = key;
      this.view.setMachine(setup, machine);
    }
    this.view.update({
      store, now_s: playhead.now_s, live: is_live(state) && playhead.follow,
      drives: planned_drives(state),
    });
  }

  tip(): readonly [number, number, number] | null {
    return this.view?.tip() ?? null;
  }

  private make(): SceneView | null {
    try {
      return createScene(this.node);
    } catch (error) {
      this.node.append(el('p', {class: 'no-scene'},
        `The machine cannot be drawn, the rest works: ${(error as Error).message}`));
      return null;
    }
  }
}

/// Of a run without frames: where its drives are just then, between two of its times.
function planned_drives({setup, store, playhead}: PageState): readonly number[] | undefined {
  const run = setup?.run;
  if (run?.pose === undefined || store.frames > 0 || run.truth.time_s.length === 0) {
    return undefined;
  }
  const times = run.truth.time_s;
  const after = Math.min(times.length - 1, lower_bound(times, playhead.now_s));
  const before = Math.max(0, after - 1);
  const span_s = times[after]! - times[before]!;
  const share = span_s > 0 ? (playhead.now_s - times[before]!) / span_s : 0;
  const from = run.pose.drives[before]!;
  return run.pose.drives[after]!.map((to, k) => from[k]! + share * (to - from[k]!));
}
