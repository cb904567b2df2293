"use strict";
// Live curves in panels that share time, cursor and zoom. Columns hold least and greatest, so that no peak is lost.
{
  const live = (globalThis.live ??= {});
  const { paint, words, frames } = live;

  const COLUMNS = 500;
  const HEIGHT_PX = 116;
  const [LEFT, RIGHT, TOP, BOTTOM] = [46, 20, 8, 20];
  const LETTERS = "ABCDEF";

  const panels = [];
  // Shown time: the newest `window_s`, or from `from` if it is held. The cursor is a fraction of the width, or null.
  const shown = { window_s: 10, from: null, cursor: null };

  const newest = () => live.histories?.[0]?.newest?.time_s ?? 0;
  const start = () => live.scene?.recording?.start_s ?? live.scene?.start_s ?? 0;
  const from = () => shown.from ?? Math.max(start(), newest() - shown.window_s);

  // Least and greatest of a signal in columns of time. Column n covers [n, n + 1) times the width of a column.
  class Trace {
    constructor(name, run) {
      Object.assign(this, {
        name,
        signal: live.index.get(name),
        run,
        least: new Float32Array(COLUMNS + 2),
        greatest: new Float32Array(COLUMNS + 2),
        keys: new Int32Array(COLUMNS + 2),
      });
      this.reset();
    }

    reset() {
      this.keys.fill(-2147483648);
      this.read = -1;
    }

    // Takes the frames since the last call; all of them again after a zoom.
    update(begin, width_s) {
      const history = live.histories?.[this.run];
      if (!history || this.signal === undefined) return;
      if (this.width_s !== width_s || this.begin > begin || history.end < this.read) this.reset();
      Object.assign(this, { width_s, begin });
      const size = this.keys.length;
      let row = this.read >= history.start ? this.read : history.after(begin);
      const end = begin + width_s * COLUMNS;
      for (; row < history.end; row++) {
        const at = row % frames.ROWS;
        const time = history.times[at];
        if (time > end) break;
        const key = Math.floor(time / width_s);
        const slot = ((key % size) + size) % size;
        const place = history.place(this.signal, row);
        const [low, high] = [history.least[place], history.greatest[place]];
        // A value that is not known is NaN. A column with NaN only is a gap in the curve.
        if (this.keys[slot] === key && this.least[slot] <= this.greatest[slot]) {
          if (low < this.least[slot]) this.least[slot] = low;
          if (high > this.greatest[slot]) this.greatest[slot] = high;
        } else {
          this.keys[slot] = key;
          this.least[slot] = low;
          this.greatest[slot] = high;
        }
      }
      this.read = row;
    }

    column(key) {
      const size = this.keys.length;
      const slot = ((key % size) + size) % size;
      return this.keys[slot] === key ? slot : -1;
    }
  }

  // Rounds the range outwards to numbers that are easy to read and do not change all the time.
  function nice(size) {
    const power = 10 ** Math.floor(Math.log10(size));
    return [1, 1.5, 2, 3, 4, 6, 8, 10].find(step => step * power >= size * 0.9999) * power;
  }

  function fit(panel, first, last) {
    let [low, high] = [Infinity, -Infinity];
    for (const trace of panel.traces.flatMap(({ runs }) => runs)) {
      for (let key = first; key <= last; key++) {
        const slot = trace.column(key);
        if (slot < 0) continue;
        if (trace.least[slot] < low) low = trace.least[slot];
        if (trace.greatest[slot] > high) high = trace.greatest[slot];
      }
    }
    if (!(low <= high)) return [-1 / panel.factor, 1 / panel.factor];
    // A signal at rest is a line, not its rounding errors.
    const smallest = 10 ** (1 - words.unit(panel.unit).digits) / panel.factor;
    const wanted = [low < 0 ? -nice(Math.max(smallest, -low)) : 0, high > 0 ? nice(Math.max(smallest, high)) : 0];
    if (wanted[0] === wanted[1]) wanted[1] = smallest;
    // Grows at once, shrinks only if much of the panel is empty.
    const old = panel.range;
    const isRoomy = old && wanted[1] - wanted[0] > 0.6 * (old[1] - old[0]);
    panel.range = isRoomy ? [Math.min(old[0], wanted[0]), Math.max(old[1], wanted[1])] : wanted;
    return panel.range;
  }

  function axes(context, panel, width, [low, high], begin, span) {
    const height = HEIGHT_PX - TOP - BOTTOM;
    const y = value => TOP + ((high - value) / (high - low)) * height;
    const step = nice((high - low) * panel.factor * 0.28);
    // As many decimals as the step needs.
    const digits =
      [0, 1, 2, 3, 4, 5].find(digits => Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) < 1e-6) ?? 6;
    for (let n = Math.ceil((low * panel.factor) / step - 1e-9); n * step <= high * panel.factor + 1e-9; n++) {
      const at = y((n * step) / panel.factor);
      paint.line(context, LEFT, at, width - RIGHT, at, n === 0 ? "soft" : "line");
      paint.text(context, words.fixed(n * step, digits), LEFT - 6, at + 4, { size: 11.5, align: "right" });
    }
    const seconds = nice(span / 6);
    for (let n = Math.ceil(begin / seconds); n * seconds <= begin + span; n++) {
      const x = LEFT + ((n * seconds - begin) / span) * (width - LEFT - RIGHT);
      paint.line(context, x, TOP, x, TOP + height, "line");
      if (x > LEFT + 12 && x < width - RIGHT - 16)
        paint.text(context, `${words.fixed(n * seconds, seconds < 1 ? 2 : seconds % 1 ? 1 : 0)} s`, x, HEIGHT_PX - 5, {
          size: 11.5,
          align: "center",
        });
    }
    for (const limit of panel.limits) {
      if (limit < low || limit > high) continue;
      paint.line(context, LEFT, y(limit), width - RIGHT, y(limit), "over", 1.5, [8, 4]);
    }
    return y;
  }

  function draw(panel, { context, width }) {
    if (!live.scene || panel.traces.length === 0) return;
    const begin = from();
    const width_s = shown.window_s / COLUMNS;
    const [first, last] = [Math.floor(begin / width_s), Math.floor(begin / width_s) + COLUMNS];
    for (const { runs } of panel.traces) runs.forEach(trace => trace.update(begin, width_s));
    const [low, high] = fit(panel, first, last);
    const y = axes(context, panel, width, [low, high], begin, shown.window_s);
    const unit = words.unit(panel.unit).text;
    if (unit) paint.text(context, unit, LEFT + 5, TOP + 11, { size: 11.5 });
    const pixels = (width - LEFT - RIGHT) / COLUMNS;
    context.save();
    context.beginPath();
    context.rect(LEFT, 0, width - LEFT - RIGHT + 1, HEIGHT_PX);
    context.clip();
    context.lineJoin = "bevel";
    // What is compared with lies behind.
    const models = panel.traces.filter(({ isModel }) => isModel);
    for (const { runs, colour, isModel } of new Set([...models, ...panel.traces])) {
      for (const trace of [...runs].reverse()) {
        if (trace.run === 1 && !frames.has(1)) continue;
        context.beginPath();
        let [before, isGap] = [NaN, true];
        for (let key = first; key <= last; key++) {
          const slot = trace.column(key);
          if (slot < 0) continue;
          if (!(trace.least[slot] <= trace.greatest[slot])) {
            isGap = true;
            continue;
          }
          const x = LEFT + (key - first) * pixels;
          const [top, bottom] = [y(trace.greatest[slot]), y(trace.least[slot])];
          const isUp = Math.abs(before - top) > Math.abs(before - bottom);
          if (isGap) context.moveTo(x, isUp ? bottom : top);
          else context.lineTo(x, isUp ? bottom : top);
          isGap = false;
          if (bottom - top > 0.6) context.lineTo(x, isUp ? top : bottom);
          before = isUp ? top : bottom;
        }
        context.strokeStyle = paint.colours[colour];
        context.lineWidth = trace.run === 1 || isModel ? 1.25 : 1.75;
        context.setLineDash(trace.run === 1 ? [5, 4] : []);
        context.stroke();
      }
    }
    context.setLineDash([]);
    context.restore();
    letters(context, panel, width, y, last);
    if (shown.cursor !== null) {
      const x = LEFT + shown.cursor * (width - LEFT - RIGHT);
      paint.line(context, x, TOP, x, HEIGHT_PX - BOTTOM, "soft", 1, [3, 3]);
    }
  }

  // Letters at the ends of the curves, moved apart where they would overlap.
  function letters(context, panel, width, y, last) {
    const ends = panel.traces.flatMap(({ runs: [trace], colour }, index) => {
      const slot = endSlot(trace, last);
      return slot < 0 ? [] : [{ at: y(trace.greatest[slot]) + 4, colour, letter: LETTERS[index] }];
    });
    let free = TOP + 8;
    const room = HEIGHT_PX - BOTTOM - 12 * (ends.length - 1);
    for (const [index, { at, colour, letter }] of ends.sort((a, b) => a.at - b.at).entries()) {
      const place = Math.max(free, Math.min(at, room + 12 * index));
      free = place + 12;
      paint.text(context, letter, width - RIGHT + 5, place, { colour, size: 11.5, weight: 700 });
    }
  }

  function endSlot(trace, last) {
    for (let key = last; key > last - COLUMNS; key--) {
      const slot = trace.column(key);
      if (slot >= 0) return trace.least[slot] <= trace.greatest[slot] ? slot : -1;
    }
    return -1;
  }

  // Values at the cursor, least to greatest of the column, or the newest value.
  function read(panel, trace) {
    const width_s = shown.window_s / COLUMNS;
    const first = Math.floor(from() / width_s);
    const key = first + Math.round((shown.cursor ?? 1) * COLUMNS);
    let slot = shown.cursor === null ? endSlot(trace, key) : -1;
    for (let near = 0; slot < 0 && near < 4; near++)
      slot = Math.max(trace.column(key - near), trace.column(key + near));
    if (slot < 0) return "–";
    const digits = words.unit(panel.unit).digits;
    if (shown.cursor === null && shown.from === null)
      return words.fixed(live.frames.reading(trace.name, trace.run) * panel.factor, digits);
    const [low, high] = [trace.least[slot], trace.greatest[slot]].map(value =>
      words.fixed(value * panel.factor, digits),
    );
    return low === high ? low : `${low} to ${high}`;
  }

  function reset() {
    for (const { runs } of panels.flatMap(({ traces }) => traces)) runs.forEach(trace => trace.reset());
    shown.from = null;
  }

  Object.assign(live, {
    curves: { panels, shown, Trace, draw, read, reset, start, from, newest, LETTERS, HEIGHT_PX, LEFT, RIGHT, COLUMNS },
  });
}
