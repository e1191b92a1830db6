'use strict';
// What the bucket met, from the run's JSON object: the ground, an obstacle, when the obstacle held.
// Pure, like report_data.js.
const reportScene = (() => {
  const {Problem, isObject, show, need, needList, checkNumbers, checkTuples, time} = reportChecks;
  const LATER = ['tip_force_n', 'tip_velocity_mps', 'obstruction'];
  const [FREE, HOLDS, GONE] = [0, 1, 2];

  const given = (value) => value !== undefined && value !== null;
  const has = (data, group, key) =>
    isObject(data) && isObject(data[group]) && given(data[group][key]);

  /// Reports from before these were recorded have none of them, and miss nothing; where one is
  /// there, the others belong to it.
  function isRecorded(data) {
    return has(data, 'geometry', 'obstacle') ||
        (isObject(data) && isObject(data.series) && LATER.some((key) => key in data.series));
  }

  /// null without soil.
  function groundY(data) {
    if (!has(data, 'geometry', 'ground_y_m')) return null;
    const y = data.geometry.ground_y_m;
    if (typeof y !== 'number') throw new Problem(`“geometry.ground_y_m”: ${show(y)} is no number.`);
    return y;
  }

  /// For each sample whether the obstacle is untouched, holds or is gone; null in an old report.
  function obstruction(data) {
    if (!isRecorded(data)) return null;
    const path = 'series.obstruction';
    const list = checkNumbers(needList(data, path), path, time(data).length);
    const bad = list.findIndex((state) => ![FREE, HOLDS, GONE].includes(state));
    if (bad >= 0) {
      throw new Problem(`“${path}”, value ${bad + 1}: ${show(list[bad])} is not 0, 1 or 2.`);
    }
    return list;
  }

  /// Stretches of time during which the obstacle holds.
  function holds(data) {
    const list = obstruction(data);
    if (list === null) return [];
    return reportChecks.runs(time(data), list).filter((run) => run.value === HOLDS);
  }

  /// Its outline: the face with the point in its middle, towards the bucket, and as deep as each
  /// half of the face is long. null without an obstacle.
  function obstacle(data) {
    if (!has(data, 'geometry', 'obstacle')) {
      // What held and let go must have been somewhere.
      if (isRecorded(data) && obstruction(data).some((state) => state !== FREE)) {
        need(data, 'geometry.obstacle');
      }
      return null;
    }
    const [[x, y], [nx, ny]] = ['point', 'normal'].map((key) => {
      const path = `geometry.obstacle.${key}`;
      return checkTuples([need(data, path)], path, 2)[0];
    });
    const size = need(data, 'geometry.obstacle.size_m');
    if (!(typeof size === 'number' && size > 0)) {
      throw new Problem(`“geometry.obstacle.size_m”: ${show(size)} is no size.`);
    }
    const length = Math.hypot(nx, ny);
    if (!(length > 0)) throw new Problem('“geometry.obstacle.normal” has no direction.');
    const [outX, outY] = [nx / length * size, ny / length * size];
    const corner = (along, out) =>
      [x - along * outY + out * outX, y + along * outX + out * outY];
    return {outline: [corner(-1, 0), corner(1, 0), corner(1, -1), corner(-1, -1)]};
  }

  /// Where the true tip was, and when, as the obstacle began to hold and as it let go.
  function changes(data) {
    const list = obstruction(data);
    if (list === null || list.every((state) => state === FREE)) return [];
    const times = time(data);
    const tip = checkTuples(needList(data, 'geometry.tip_true'), 'geometry.tip_true', 2);
    if (tip.length !== times.length) {
      throw new Problem(`“geometry.tip_true” has ${tip.length} points, “series.time_s” has ${
        times.length} values.`);
    }
    return list.flatMap((state, i) => {
      const before = i > 0 ? list[i - 1] : FREE;
      if (state === before || (state === FREE && before === GONE)) return [];
      return [{x: tip[i][0], y: tip[i][1], time_s: times[i], holds: state === HOLDS}];
    });
  }

  return {isRecorded, groundY, holds, obstacle, changes};
})();
