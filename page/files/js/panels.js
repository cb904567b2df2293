"use strict";
// The panels of the curves: which signals they show, their legends, and how mouse and keys move cursor and zoom.
{
  const live = (globalThis.live ??= {});
  const { paint, words, curves } = live;
  const { panels, shown } = curves;

  // Dampers of a target whose curves are shown first, and signals of a recording without those of a wheelset.
  const SLOTS = 3;
  const SIGNALS = 6;
  const WINDOWS_S = [0.5, 1, 2, 5, 10, 20, 40];
  const place = () => document.getElementById("panels");
  const element = (name, properties = {}, ...children) => {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
  };

  // Lines at which a signal is at its limit.
  function limits(name) {
    const { scene } = live;
    if (name.endsWith("_derailment")) return [scene.derailment_limit];
    const set = scene.wheelsets.find(({ slug }) =>
      [slug + "_lateral_force_n", slug + "_filtered_lateral_force_n"].includes(name),
    );
    return set ? [set.lateral_limit_n, -set.lateral_limit_n] : [];
  }

  function add(name) {
    const number = live.index.get(name);
    if (number === undefined || panels.some(panel => panel.traces.some(trace => trace.name === name))) return;
    const signal = live.scene.signals[number];
    // What a target measures and what the model says are beside each other, each damper by itself.
    const damper = live.sources.isTarget() ? name.match(/^(.+?)(?:_model)?_force_n$/)?.[1] : null;
    const isModel = Boolean(damper) && name.endsWith("_model_force_n");
    const kind =
      (damper ?? "") +
      signal.unit +
      (name.match(/_(acceleration|derailment|load_n|contact_m|lateral_force_n|force_n)/)?.[1] ?? "");
    let panel = panels.find(panel => panel.kind === kind && panel.traces.length < curves.LETTERS.length);
    if (!panel) panels.push((panel = make(kind, signal.unit)));
    const taken = panel.traces.map(({ colour }) => colour);
    const usual = [1, 2, 3, 4, 5, 6].map(n => "series-" + n).find(colour => !taken.includes(colour)) ?? "series-1";
    const runs = [0, 1].map(run => new curves.Trace(name, run));
    panel.traces.push({ name, colour: usual, isModel, label: signal.label, runs });
    panel.limits = [...new Set(panel.traces.flatMap(({ name }) => limits(name)))];
    legend(panel);
  }

  function make(kind, unit) {
    const canvas = element("canvas", { id: `curve-${panels.length}-${Date.now() % 1e6}`, tabIndex: 0 });
    canvas.setAttribute("role", "application");
    const panel = {
      kind,
      unit,
      factor: words.unit(unit).factor,
      traces: [],
      limits: [],
      canvas,
      head: element("ul", { className: "legend" }),
    };
    panel.place = element(
      "div",
      { className: "curve-panel" },
      panel.head,
      element("div", { className: "canvas" }, canvas),
    );
    place().append(panel.place);
    panel.view = paint.view(canvas.id, {
      height: () => curves.HEIGHT_PX,
      draw: surface => curves.draw(panel, surface),
      period_ms: 48,
      group: "curves",
    });
    listen(canvas);
    return panel;
  }

  function legend(panel) {
    panel.head.replaceChildren(
      ...panel.traces.map((trace, index) => {
        trace.value = element("span", { className: "reading" });
        const remove = element("button", {
          type: "button",
          className: "remove",
          textContent: "×",
          onclick: () => drop(panel, trace),
        });
        remove.setAttribute("aria-label", `Remove ${trace.label}`);
        const letter = element("b", { className: "letter", textContent: curves.LETTERS[index] });
        letter.style.color = `var(--${trace.colour})`;
        return element("li", {}, letter, ` ${words.capital(trace.label)} `, trace.value, remove);
      }),
    );
    panel.canvas.setAttribute(
      "aria-label",
      `Curves of ${panel.traces.map(({ label }) => label).join("; ")}. Arrow keys move the cursor.`,
    );
    panel.view.isStale = true;
  }

  function drop(panel, trace) {
    panel.traces.splice(panel.traces.indexOf(trace), 1);
    if (panel.traces.length > 0) return legend(panel);
    panels.splice(panels.indexOf(panel), 1);
    paint.views.splice(paint.views.indexOf(panel.view), 1);
    panel.place.remove();
    document.getElementById("add-curve").focus();
  }

  function clear() {
    for (const panel of panels.splice(0)) {
      paint.views.splice(paint.views.indexOf(panel.view), 1);
      panel.place.remove();
    }
  }

  const names = () => panels.flatMap(panel => panel.traces.map(({ name }) => name));

  function show(list) {
    clear();
    list.forEach(add);
  }

  // What a recording lacks is not shown. Before the first frame nobody knows.
  const isKnown = name =>
    !live.sources.isRecording() || !live.frames.has(0) || !Number.isNaN(live.frames.reading(name));

  // Of a target: how the first dampers move, and their forces with those of the model.
  const ofTarget = () =>
    ["_displacement_m", "_force_n", "_model_force_n"].flatMap(name =>
      live.scene.dampers.slice(0, SLOTS).map(({ slug }) => slug + name),
    );

  function usual() {
    if (live.sources.isTarget()) return ofTarget();
    const known = ofVehicle().filter(isKnown);
    if (known.length > 0) return known;
    const measured = live.scene.signals.map(({ name }) => name).filter(name => !/^(time_s|distance_m)$/.test(name));
    return measured.filter(isKnown).slice(0, SIGNALS);
  }

  // What tells a beginner most: how the first wheelset swings, its forces, and the force of the first damper.
  function ofVehicle() {
    const [set, last] = [live.scene.wheelsets[0], live.scene.wheelsets[live.scene.wheelsets.length - 1]];
    const yaw = live.scene.dampers.find(({ direction }) => direction === "longitudinal") ?? live.scene.dampers[0];
    if (!set) return yaw ? [yaw.slug + "_force_n"] : [];
    const list = [
      set.slug + "_lateral_m",
      last.slug + "_lateral_m",
      set.slug + "_left_derailment",
      set.slug + "_right_derailment",
      set.slug + "_left_load_n",
      set.slug + "_right_load_n",
    ];
    return yaw ? [...list, yaw.slug + "_force_n"] : list;
  }

  // Zooms about the cursor or the newest time; a window that ends at the newest time stays live.
  function zoom(way) {
    const index = WINDOWS_S.findIndex(window => window >= shown.window_s);
    const next = WINDOWS_S[Math.max(0, Math.min(WINDOWS_S.length - 1, index + way))];
    if (shown.from !== null || shown.cursor !== null) {
      const part = shown.cursor ?? 0.5;
      shown.from = curves.from() + part * (shown.window_s - next);
    }
    shown.window_s = next;
    paint.refresh();
    tell();
  }

  function hold(from) {
    shown.from = Math.max(curves.start(), Math.min(from, curves.newest() - 0.2 * shown.window_s));
    paint.refresh();
    tell();
  }

  function follow() {
    shown.from = null;
    paint.refresh();
    tell();
  }

  function tell() {
    const isLive = shown.from === null;
    document.getElementById("curves-live").disabled = isLive;
    document.getElementById("curves-live").textContent = live.sources.isRecording() ? "Now" : "Live";
    document.getElementById("curves-hold").disabled = !isLive;
    document.getElementById("window").textContent = `${shown.window_s} s`;
    const now = live.sources.isRecording() ? "up to the time above" : "live";
    document.getElementById("curves-state").textContent = isLive ? now : "held";
  }

  function cursor(part) {
    shown.cursor = part === null ? null : Math.max(0, Math.min(1, part));
    for (const { view } of panels) view.isStale = true;
  }

  function listen(canvas) {
    const part = event => (event.offsetX - curves.LEFT) / (canvas.clientWidth - curves.LEFT - curves.RIGHT);
    let drag = null;
    canvas.addEventListener("pointerdown", event => {
      drag = { x: event.offsetX, from: curves.from() };
      if (event.pointerType === "mouse") canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      cursor(part(event));
      if (drag && Math.abs(event.offsetX - drag.x) > 4)
        hold(
          drag.from - ((event.offsetX - drag.x) / (canvas.clientWidth - curves.LEFT - curves.RIGHT)) * shown.window_s,
        );
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => (drag = null));
    canvas.addEventListener("pointerleave", () => cursor(null));
    canvas.addEventListener("dblclick", follow);
    canvas.addEventListener(
      "wheel",
      event => {
        if (!event.ctrlKey && !event.shiftKey) return;
        event.preventDefault();
        zoom(Math.sign(event.deltaY || event.deltaX));
      },
      { passive: false },
    );
    const keys = {
      ArrowLeft: () => cursor((shown.cursor ?? 1) - 0.01),
      ArrowRight: () => cursor((shown.cursor ?? 1) + 0.01),
      PageUp: () => hold(curves.from() - 0.5 * shown.window_s),
      PageDown: () => hold(curves.from() + 0.5 * shown.window_s),
      Home: () => hold(curves.start()),
      End: () => (cursor(null), follow()),
      "+": () => zoom(-1),
      "-": () => zoom(1),
    };
    canvas.addEventListener("keydown", event => {
      if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  // Values in the legends, a few times a second.
  function write() {
    for (const panel of panels)
      for (const trace of panel.traces) {
        const both = trace.runs.filter(({ run }) => live.frames.has(run)).map(run => curves.read(panel, run));
        const text = both.length > 1 ? `${both[0]} (new ${both[1]})` : (both[0] ?? "–");
        if (trace.value.textContent !== text) trace.value.textContent = text;
      }
  }

  Object.assign(live, { panels: { add, show, names, usual, isKnown, zoom, hold, follow, tell, write, clear } });
}
