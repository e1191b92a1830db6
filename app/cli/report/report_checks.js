'use strict';
// Reading the run's JSON object with suspicion. What is missing or malformed throws a Problem, a
// sentence for the page; `part` keeps it inside its own part of the report.
const reportChecks = (() => {
  class Problem extends Error {}

  function part(compute) {
    try {
      return {ok: true, value: compute()};
    } catch (error) {
      if (error instanceof Problem) return {ok: false, problem: error.message};
      throw error;
    }
  }

  const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);

  function show(value) {
    const text = JSON.stringify(value);
    return text.length > 30 ? `${text.slice(0, 30)}…` : text;
  }

  /// The value at a dotted path; a Problem naming the first missing piece otherwise.
  function need(data, path) {
    let value = data;
    let walked = '';
    for (const key of path.split('.')) {
      walked = walked ? `${walked}.${key}` : key;
      if (!isObject(value) || value[key] === undefined || value[key] === null) {
        throw new Problem(`“${walked}” is missing from the data.`);
      }
      value = value[key];
    }
    return value;
  }

  function needList(data, path) {
    const list = need(data, path);
    if (!Array.isArray(list)) throw new Problem(`“${path}” is not a list.`);
    return list;
  }

  /// null is a gap: the JSON writer turns not-a-number into it.
  function checkNumbers(list, path, count) {
    if (!Array.isArray(list)) throw new Problem(`“${path}” is not a list.`);
    if (count !== undefined && list.length !== count) {
      throw new Problem(`“${path}” has ${list.length} values, “series.time_s” has ${count}.`);
    }
    const bad = list.findIndex((value) => value !== null && typeof value !== 'number');
    if (bad >= 0) {
      throw new Problem(`“${path}”, value ${bad + 1}: ${show(list[bad])} is no number.`);
    }
    return list;
  }

  function checkTuples(list, path, width) {
    const bad = list.findIndex((tuple) => !Array.isArray(tuple) || tuple.length !== width ||
        tuple.some((value) => typeof value !== 'number'));
    if (bad >= 0) {
      throw new Problem(`“${path}”, entry ${bad + 1}: ${show(list[bad])} is not ${width} numbers.`);
    }
    return list;
  }

  function time(data) {
    const list = checkNumbers(needList(data, 'series.time_s'), 'series.time_s');
    if (list.length < 2) throw new Problem('“series.time_s” has fewer than two values.');
    const bad = list.findIndex((value, i) => value === null || (i > 0 && value < list[i - 1]));
    if (bad >= 0) {
      throw new Problem(`“series.time_s”, value ${bad + 1}, does not follow the one before.`);
    }
    return list;
  }

  const scaled = (list, factor) => list.map((value) => (value === null ? null : value * factor));

  function seriesList(data, name, factor = 1) {
    const path = `series.${name}`;
    return scaled(checkNumbers(needList(data, path), path, time(data).length), factor);
  }

  /// One list for each axis or pump.
  function seriesGroup(data, name, counts, factor = 1) {
    const path = `series.${name}`;
    const group = needList(data, path);
    if (group.length < counts[0] || group.length > counts[1]) {
      const wanted = counts[0] === counts[1] ? counts[0] : counts.join(' to ');
      throw new Problem(`“${path}” has ${group.length} lists, not ${wanted}.`);
    }
    const count = time(data).length;
    return group.map((list, i) => scaled(checkNumbers(list, `${path}[${i}]`, count), factor));
  }

  /// Stretches of time with one value; a sample's value holds until the next one.
  function runs(times, values) {
    const list = [];
    for (let i = 0; i < times.length; ++i) {
      const until = times[Math.min(i + 1, times.length - 1)];
      const last = list[list.length - 1];
      if (last && last.value === values[i] && last.until === times[i]) {
        last.until = until;
      } else if (values[i] !== null) {
        list.push({from: times[i], until, value: values[i]});
      }
    }
    return list;
  }

  return {Problem, part, isObject, show, need, needList, checkNumbers, checkTuples, time, runs,
    seriesList, seriesGroup};
})();
