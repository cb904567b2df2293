"use strict";
// Decodes frames and keeps the history of every signal: last, least and greatest of each frame.
{
  const live = (globalThis.live ??= {});

  const HEADER = 48;
  // Frames that are kept: 40 s at 200 frames a second.
  const ROWS = 8192;
  // Rows of a signal that lie together. So many rows of all signals fit into the cache of a processor: frames are
  // written fast, which matters in a burst, and a signal is read fast.
  const BLOCK = 16;
  const FLAGS = { ended: 1, invalid: 2, stopped: 4, slow: 8 };

  function decode(buffer) {
    const view = new DataView(buffer);
    const count = view.getUint32(4, true);
    const part = number => new Float32Array(buffer, HEADER + 4 * number * count, count);
    const [last, least, greatest] = [part(0), part(1), part(2)];
    const ticks = view.getUint32(40, true);
    return {
      run: view.getUint32(0, true),
      time_s: view.getFloat64(8, true),
      distance_m: view.getFloat64(16, true),
      work_us: view.getFloat32(32, true),
      greatest_us: view.getFloat32(36, true),
      ticks,
      flags: view.getUint32(44, true),
      last,
      // A frame without ticks has no least and greatest.
      least: ticks > 0 ? least : last,
      greatest: ticks > 0 ? greatest : last,
    };
  }

  // Numbers of each signal in rows, of which the newest overwrite the oldest.
  class History {
    constructor(signals) {
      this.signals = signals;
      this.times = new Float64Array(ROWS);
      this.distances = new Float64Array(ROWS);
      for (const name of ["last", "least", "greatest"]) this[name] = new Float32Array(signals * ROWS);
      this.clear();
    }

    clear() {
      this.end = 0;
      this.newest = null;
    }

    // A frame that is older than the newest begins a new history.
    push(frame) {
      if (frame.last.length !== this.signals) return false;
      const isBack = this.newest !== null && frame.time_s < this.newest.time_s - 1e-9;
      if (isBack) this.clear();
      this.newest = frame;
      if (frame.ticks === 0) return isBack;
      const row = this.end++ % ROWS;
      this.times[row] = frame.time_s;
      this.distances[row] = frame.distance_m;
      for (let signal = 0, at = this.place(0, row); signal < this.signals; signal++, at += BLOCK) {
        this.last[at] = frame.last[signal];
        this.least[at] = frame.least[signal];
        this.greatest[at] = frame.greatest[signal];
      }
      return isBack;
    }

    // Where a row of a signal is in `last`, `least` and `greatest`.
    place(signal, row) {
      const at = row % ROWS;
      return (Math.floor(at / BLOCK) * this.signals + signal) * BLOCK + (at % BLOCK);
    }

    get start() {
      return Math.max(0, this.end - ROWS);
    }

    // The first frame after a time.
    after(time_s) {
      let [from, to] = [this.start, this.end];
      while (from < to) {
        const middle = (from + to) >> 1;
        if (this.times[middle % ROWS] < time_s) from = middle + 1;
        else to = middle;
      }
      return from;
    }

    // Least and greatest of a signal in the last seconds; NaN if it is not known.
    range(signal, seconds) {
      let [least, greatest] = [Infinity, -Infinity];
      if (signal === undefined || !this.newest) return [NaN, NaN];
      for (let i = this.after(this.newest.time_s - seconds); i < this.end; i++) {
        const at = this.place(signal, i);
        // A comparison with NaN is false, so values that are not known do not count.
        if (this.least[at] < least) least = this.least[at];
        if (this.greatest[at] > greatest) greatest = this.greatest[at];
      }
      return least <= greatest ? [least, greatest] : [NaN, NaN];
    }
  }

  // Value of a signal by name in the newest frame of a run; NaN if it is not known.
  function reading(name, run = 0) {
    const at = live.index?.get(name);
    const frame = live.histories?.[run]?.newest;
    return at === undefined || !frame ? NaN : frame.last[at];
  }

  // The same for drawings of the vehicle: what is not known is at rest.
  function value(name, run = 0) {
    const found = reading(name, run);
    return Number.isFinite(found) ? found : 0;
  }

  const has = run => Boolean(live.histories?.[run]?.newest);

  Object.assign(live, { frames: { decode, History, reading, value, has, ROWS, FLAGS } });
}
