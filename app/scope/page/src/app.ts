// SPDX-License-Identifier: Apache-2.0
/// The page put together: what shows what is known, and the loop that keeps it in step.

import {createFeed, embedded_setup} from './feed/feed';
import {State} from './state';
import {Alarms} from './view/faults/alarms';
import {BehindView} from './view/panels/behind_view';
import {FaultList} from './view/faults/fault_list';
import {FaultLog} from './view/faults/fault_log';
import {FileOpener} from './view/panels/files';
import {is_film, offer_film} from './view/page/film';
import {FirstSight, has_motion} from './view/page/first_sight';
import {FrameRate} from './view/basics/frame_rate';
import {Header} from './view/panels/header';
import {HealthPanel} from './view/panels/health_panel';
import {help_dialog} from './view/basics/help';
import {Histogram} from './view/plots/histogram';
import {listen_to_keys} from './view/page/keys';
import {LimitShares} from './view/limits/limit_shares';
import {lay_out} from './view/basics/layout';
import {NowLine} from './view/panels/now_line';
import {MessageTable} from './view/panels/message_table';
import {Moments} from './view/panels/moments';
import type {View} from './view/basics/page_state';
import {PlotBoard} from './view/plots/plot_board';
import {ReplayBar} from './view/page/replay_bar';
import {RunPanel} from './view/panels/run_panel';
import {SceneFrame} from './view/page/scene_frame';
import {PlotChooser} from './view/plots/signal_drag';
import {SimPanel} from './view/panels/sim_panel';
import {StatePanel} from './view/panels/state_panel';
import {tell_tests} from './view/page/tests_window';
import {create_theme} from './view/basics/theme';
import {Tour} from './view/page/tour';
import {page_words} from './view/basics/words';
import {XyBoard} from './view/plots/xy_board';

/// Ten times a second is as often as words can be read.
const PANEL_MS = 100;

/// `?keep=60`: seconds of a live run that the page keeps, 10 s to a day.
function told_keep_s(search: string): number | undefined {
  const told = Number(new URLSearchParams(search).get('keep') ?? NaN);
  return told >= 10 && told <= 86_400 ? told : undefined;
}

export function start(root: HTMLElement): void {
  const setup = embedded_setup(document);
  const state = new State(setup !== null, told_keep_s(location.search));
  // First: a log is read while the rest is made.
  const feed = createFeed(state, setup);
  state.send_by((message) => feed.send(message));
  const theme = create_theme();
  const words = page_words(state);
  const faults = new FaultLog();
  const tour = new Tour();
  const first_sight = new FirstSight();
  const help = help_dialog(() => tour.start());

  const scene = new SceneFrame(theme);
  const shares = new LimitShares();
  const plots = new PlotBoard(state, theme, words.limit, shares);
  const xy = new XyBoard(theme);
  const histogram = new Histogram(theme);
  const chooser = new PlotChooser({
    plots: () => plots.plots_there(), put: (signal, plot) => plots.put(signal, plot)});
  const moments = new Moments(state);
  const replay = new ReplayBar(state, faults, theme);
  const now_line = new NowLine(words);
  replay.node.prepend(now_line.node);
  const header = new Header(theme, () => help.node.showModal());
  const alarms = new Alarms(words, () => replay.jump_to_current());
  const files = new FileOpener((file) => {
    state.file_opened();
    feed.open_file(file);
  });
  header.node.lastElementChild?.prepend(files.node);

  const panel: View[] = [
    new StatePanel(words),
    new BehindView(theme, {ground: () => scene.ground(), design: () => scene.layers.shown.design}),
    new RunPanel(theme, words, shares), new SimPanel((message) => state.send(message)),
    new FaultList(faults, words, (time_s) => state.playhead.seek(time_s)), moments,
    new MessageTable((signal) => chooser.choose(signal)),
    new HealthPanel(),
  ];
  const views: View[] = [header, alarms, now_line, ...panel, replay, files, tour];
  lay_out(root, {
    header: header.node, alarms: alarms.node, scene: scene.node, layers: scene.layers.node,
    plots: [plots.node, xy.node, histogram.node], panel: panel.map(({node}) => node), replay: replay.node,
  });
  root.append(tour.node);
  listen_to_keys({
    state, replay, mark: () => moments.mark(), theme: () => theme.toggle(), help: () => help.node.showModal(),
  });

  const rate = new FrameRate();
  let panel_ms = -Infinity;
  let last_ms: number | null = null;
  const frame = (now_ms: number): void => {
    requestAnimationFrame(frame);
    state.playhead.tick(last_ms === null ? 0 : (now_ms - last_ms) / 1000);
    last_ms = now_ms;
    state.know_machine();
    if (!moments.opens(state)) {
      first_sight.update(state, has_motion());
    }
    // What a log shows while it is read is passed over at once; reading it is what the processor is
    // for, and without a graphics card a picture takes as long as ten thousand frames.
    if (state.drawn) {
      scene.frame(state);
      shares.update(state, now_ms);
      plots.frame(now_ms);
      xy.frame(now_ms, state);
      histogram.frame(now_ms, state);
    }
    if (now_ms - panel_ms >= PANEL_MS) {
      panel_ms = now_ms;
      for (const view of views) {
        view.update(state);
      }
      help.offer_tour(state.setup?.source.mode === 'sim');
    }
    rate.count(now_ms);
  };
  requestAnimationFrame(frame);
  tell_tests(state, scene, rate);
  if (is_film(location.search)) {
    document.documentElement.classList.add('film');
    offer_film(state, scene, () => {
      panel_ms = -Infinity;
    });
  }
}
