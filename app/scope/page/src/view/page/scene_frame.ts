// SPDX-License-Identifier: Apache-2.0
/// The scene and its layers. Without WebGL it says so itself, and the rest goes on.

import {createScene} from '../../scene/scene';
import type {HeightField} from '../../scene/height_field';
import type {SceneView} from '../../scene/types';
import {el} from '../basics/dom';
import {LayerBar} from '../basics/layers';
import {lower_bound} from '../basics/curves';
import {is_live, type PageState} from '../basics/page_state';
import type {ThemeSwitch} from '../basics/theme';

export class SceneFrame {
  readonly node = el('div', {class: 'scene-host'});
  readonly layers: LayerBar;
  private readonly view: SceneView;
  private shown_for: readonly unknown[] = [];
  private drives: readonly number[] | undefined;
  private drives_s = NaN;
  private sized = false;

  constructor(theme: ThemeSwitch) {
    this.view = createScene(this.node);
    this.layers = new LayerBar(() => this.view.setLayers(this.layers.shown),
      () => this.view.resetCamera());
    this.view.setTheme(theme.dark);
    theme.on_change(() => this.view.setTheme(theme.dark));
    new ResizeObserver(() => {
      this.sized = false;
    }).observe(this.node);
  }

  frame(state: PageState): void {
    const {setup, machine, store, playhead} = state;
    if (setup === null) {
      return;
    }
    if (!this.sized) {
      this.sized = true;
      this.view.resize();
    }
    if (this.shown_for[0] !== setup || this.shown_for[1] !== machine) {
      this.shown_for = [setup, machine];
      this.drives_s = NaN;
      // A new machine is drawn at once, and not from the frames that the last one had.
      this.view.setMachine(setup, null);
      this.view.update({store, now_s: playhead.now_s, live: false});
      this.view.setMachine(setup, machine);
      this.layers.offer(machine, setup.source.mode === 'plan');
    }
    if (playhead.now_s !== this.drives_s) {
      this.drives_s = playhead.now_s;
      this.drives = planned_drives(state);
    }
    this.view.update({
      store, now_s: playhead.now_s, live: is_live(state) && playhead.follow,
      drives: this.drives,
    });
  }

  tip(): readonly [number, number, number] | null {
    return this.view.tip();
  }

  ground(): HeightField | null {
    return this.view.ground();
  }

  settled(): boolean {
    return this.view.settled();
  }

  tipOnScreen(): readonly [number, number] | null {
    return this.view.tipOnScreen();
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
