"use strict";
// Force over displacement of the chosen damper, as it is drawn, with the damper of the vehicle as new beside it.
{
  const live = (globalThis.live ??= {});
  const { paint, words, frames } = live;

  const HEIGHT_PX = 250;
  const SECONDS = 3;
  const [LEFT, RIGHT, TOP, BOTTOM] = [48, 14, 12, 34];
  const range = { of: null, x: 0, y: 0 };

  const nice = size => {
    const power = 10 ** Math.floor(Math.log10(size));
    return [1, 1.5, 2, 3, 4, 6, 8, 10].find(step => step * power >= size * 0.9999) * power;
  };

  function draw({ context, width }) {
    const damper = live.scene?.dampers[live.view.dampers[0]];
    if (!damper) return;
    const [x, y] = [damper.slug + "_displacement_m", damper.slug + "_force_n"].map(name => live.index.get(name));
    if (x === undefined || y === undefined) return;
    if (range.of !== damper) Object.assign(range, { of: damper, x: 0, y: 0 });
    const runs = [1, 0].filter(run => frames.has(run));
    const largest = signal =>
      Math.max(...runs.map(run => Math.max(...live.histories[run].range(signal, SECONDS).map(Math.abs))));
    // The axes grow at once and shrink slowly.
    const wanted = [nice(Math.max(2e-4, largest(x) || 0)), nice(Math.max(200, largest(y) || 0))];
    ["x", "y"].forEach((axis, n) => {
      range[axis] = wanted[n] > range[axis] || wanted[n] < 0.45 * range[axis] ? wanted[n] : range[axis];
    });
    const [w, h] = [width - LEFT - RIGHT, HEIGHT_PX - TOP - BOTTOM];
    const px = value => LEFT + 0.5 * w * (1 + value / range.x);
    const py = value => TOP + 0.5 * h * (1 - value / range.y);
    axes(context, width, px, py, w, h);
    for (const run of runs) loop(context, live.histories[run], x, y, px, py, run);
  }

  function axes(context, width, px, py, w, h) {
    for (const part of [-1, -0.5, 0, 0.5, 1]) {
      const [at, up] = [px(part * range.x), py(part * range.y)];
      paint.line(context, at, TOP, at, TOP + h, part === 0 ? "soft" : "line");
      paint.line(context, LEFT, up, LEFT + w, up, part === 0 ? "soft" : "line");
      const digits = size => (size >= 10 ? 0 : size >= 1 ? 1 : 2);
      paint.text(context, words.fixed(part * range.x * 1e3, digits(range.x * 1e3)), at, TOP + h + 14, {
        size: 11.5,
        align: "center",
      });
      paint.text(context, words.fixed(part * range.y * 1e-3, digits(range.y * 1e-3)), LEFT - 6, up + 4, {
        size: 11.5,
        align: "right",
      });
    }
    paint.text(context, "displacement, mm", LEFT + w / 2, HEIGHT_PX - 4, { size: 11.5, align: "center" });
    paint.text(context, "force, kN", LEFT + 6, TOP + 12, { size: 11.5 });
  }

  // Older parts fade, in four steps.
  function loop(context, history, x, y, px, py, run) {
    const { ROWS } = frames;
    const begin = history.after(history.newest.time_s - SECONDS);
    const count = history.end - begin;
    const stride = Math.max(1, Math.ceil(count / 600));
    context.strokeStyle = run === 1 ? paint.colours.ghost : paint.colours.force;
    context.lineJoin = "round";
    context.setLineDash(run === 1 ? [5, 4] : []);
    for (let part = 0; part < 4; part++) {
      context.beginPath();
      for (
        let i = begin + Math.floor((part * count) / 4);
        i <= Math.min(history.end - 1, begin + Math.ceil(((part + 1) * count) / 4));
        i += stride
      )
        context.lineTo(px(history.last[x * ROWS + (i % ROWS)]), py(history.last[y * ROWS + (i % ROWS)]));
      context.globalAlpha = 0.25 + 0.25 * part;
      context.lineWidth = run === 1 ? 1.25 : 2;
      context.stroke();
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
    const last = (history.end - 1) % ROWS;
    if (count < 1) return;
    context.beginPath();
    context.arc(px(history.last[x * ROWS + last]), py(history.last[y * ROWS + last]), run === 1 ? 3 : 4.5, 0, 7);
    context.fillStyle = context.strokeStyle;
    context.fill();
  }

  live.drawLoops = () => paint.view("loop", { height: () => HEIGHT_PX, draw, period_ms: 64 });
}
