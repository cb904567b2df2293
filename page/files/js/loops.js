"use strict";
// Force over displacement of the chosen damper, as it is drawn, with what it is compared with behind it: the damper of
// the vehicle as new, or the model of a target.
{
  const live = (globalThis.live ??= {});
  const { paint, words } = live;

  const HEIGHT_PX = 250;
  // For a target the loop is the main drawing.
  const LARGE_PX = 340;
  const SECONDS = 3;
  const [LEFT, RIGHT, TOP, BOTTOM] = [48, 14, 12, 34];
  const range = { of: null, x: 0, y: 0 };
  const STYLES = {
    damper: { colour: "force", width: 2, dash: [], dot: 4.5 },
    new: { colour: "ghost", width: 1.25, dash: [5, 4], dot: 3 },
    target: { colour: "series-1", width: 2, dash: [], dot: 4.5 },
    model: { colour: "series-2", width: 1.25, dash: [], dot: 3 },
  };

  const nice = size => {
    const power = 10 ** Math.floor(Math.log10(size));
    return [1, 1.5, 2, 3, 4, 6, 8, 10].find(step => step * power >= size * 0.9999) * power;
  };

  // The loops of a damper, the last in front.
  function loops({ slug }) {
    const of = (force, run, style) => ({
      history: live.histories[run],
      x: live.index.get(slug + "_displacement_m"),
      y: live.index.get(slug + force),
      style,
    });
    const all = live.sources.isTarget()
      ? [of("_model_force_n", 0, STYLES.model), of("_force_n", 0, STYLES.target)]
      : [of("_force_n", 1, STYLES.new), of("_force_n", 0, STYLES.damper)];
    return all.filter(({ history, x, y }) => history?.newest && x !== undefined && y !== undefined);
  }

  function draw({ context, width, height }) {
    const damper = live.scene?.dampers[live.view.dampers[0]];
    if (!damper || !live.histories) return;
    if (range.of !== damper) Object.assign(range, { of: damper, x: 0, y: 0 });
    const shown = loops(damper);
    fit(range, shown);
    const [w, h] = [width - LEFT - RIGHT, height - TOP - BOTTOM];
    const px = value => LEFT + 0.5 * w * (1 + value / range.x);
    const py = value => TOP + 0.5 * h * (1 - value / range.y);
    axes(context, px, py, w, h, height);
    for (const one of shown) loop(context, one, px, py);
    if (!live.sources.isRecording() || shown.some(isKnown)) return;
    paint.text(context, "not in the recording", LEFT + w / 2, TOP + h / 2 - 8, { align: "center", size: 13 });
  }

  // Is anything of a loop known?
  const isKnown = ({ history, x, y }) => [x, y].every(signal => Number.isFinite(history.range(signal, SECONDS)[0]));

  // Fits the axes to loops. They grow at once and shrink slowly.
  function fit(range, shown) {
    const largest = axis =>
      shown.reduce((most, loop) => {
        const ends = loop.history.range(loop[axis], SECONDS).map(Math.abs).filter(Number.isFinite);
        return Math.max(most, ...ends);
      }, 0);
    const wanted = [nice(Math.max(2e-4, largest("x"))), nice(Math.max(200, largest("y")))];
    ["x", "y"].forEach((axis, n) => {
      range[axis] = wanted[n] > range[axis] || wanted[n] < 0.45 * range[axis] ? wanted[n] : range[axis];
    });
  }

  function axes(context, px, py, w, h, height) {
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
    paint.text(context, "displacement, mm", LEFT + w / 2, height - 4, { size: 11.5, align: "center" });
    paint.text(context, "force, kN", LEFT + 6, TOP + 12, { size: 11.5 });
  }

  // Older parts fade, in four steps.
  function loop(context, { history, x, y, style }, px, py) {
    const begin = history.after(history.newest.time_s - SECONDS);
    const count = history.end - begin;
    if (count < 1) return;
    const stride = Math.max(1, Math.ceil(count / 600));
    const at = i => [history.last[history.place(x, i)], history.last[history.place(y, i)]];
    context.strokeStyle = context.fillStyle = paint.colours[style.colour];
    context.lineJoin = "round";
    context.lineWidth = style.width;
    context.setLineDash(style.dash);
    for (let part = 0; part < 4; part++) {
      const last = Math.min(history.end - 1, begin + Math.ceil(((part + 1) * count) / 4));
      context.beginPath();
      // What is not known is a gap.
      let isGap = true;
      for (let i = begin + Math.floor((part * count) / 4); i <= last; i += stride) {
        const [displacement, force] = at(i);
        const wasGap = isGap;
        isGap = !Number.isFinite(displacement + force);
        if (isGap) continue;
        if (wasGap) context.moveTo(px(displacement), py(force));
        else context.lineTo(px(displacement), py(force));
      }
      context.globalAlpha = 0.25 + 0.25 * part;
      context.stroke();
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
    const [displacement, force] = at(history.end - 1);
    if (!Number.isFinite(displacement + force)) return;
    context.beginPath();
    context.arc(px(displacement), py(force), style.dot, 0, 7);
    context.fill();
  }

  const height = () => (live.scene && live.sources.isTarget() ? LARGE_PX : HEIGHT_PX);
  Object.assign(live, { loops: { of: loops, fit, loop } });
  live.drawLoops = () => paint.view("loop", { height, draw, period_ms: 64 });
}
